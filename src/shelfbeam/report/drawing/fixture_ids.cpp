#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/report/drawing/fixture_look.hpp"
#include "shelfbeam/report/drawing/part_drawing.hpp"
#include "shelfbeam/report/drawing/store_layer.hpp"

namespace shelfbeam {

namespace {

// The extent of a fixture along and across its own direction.
struct Extent {
  Point centre;
  double along = 0, across = 0, angle_deg = 0;
};

Extent extent_of(const PlanView& view, const FixtureOutline& fixture) {
  const Directions d(fixture.rotation_deg);
  const Outline outline(d, fixture);
  const double u = (outline.u.low + outline.u.high) / 2, v = (outline.v.low + outline.v.high) / 2;
  Extent e{view.at(d.c * u - d.s * v, d.s * u + d.c * v), outline.u.size() * view.scale(),
           outline.v.size() * view.scale(), -fixture.rotation_deg};
  if (e.across > 1.001 * e.along) {
    std::swap(e.along, e.across);
    e.angle_deg -= 90;
  }
  // Upright: readable from below or from the right.
  e.angle_deg = std::remainder(e.angle_deg, 180);
  if (e.angle_deg > 89) e.angle_deg -= 180;
  return e;
}

double text_width(const std::string& text, double size) {
  constexpr double glyph = 0.62;  // width of a bold sans-serif letter over the font size
  return glyph * size * static_cast<double>(text.size());
}

struct Rectangle {
  double left = 0, top = 0, right = 0, bottom = 0;
  bool meets(const Rectangle& o) const {
    return left < o.right && o.left < right && top < o.bottom && o.top < bottom;
  }
  Point centre() const { return {(left + right) / 2, (top + bottom) / 2}; }
};

Rectangle bounds(const std::vector<Point>& points) {
  if (points.empty()) return {};
  Rectangle r{points[0].x, points[0].y, points[0].x, points[0].y};
  for (const Point& p : points)
    r = {std::min(r.left, p.x), std::min(r.top, p.y), std::max(r.right, p.x), std::max(r.bottom, p.y)};
  return r;
}

// Rectangles that an id must not cover: fixtures, label marks, ids beside their fixtures. Ids may lie within
// the outline of a lowered ceiling.
std::vector<Rectangle> obstacles_of(const PlanView& view, const Scene& scene,
                                    const std::vector<Look>& looks) {
  std::vector<Rectangle> result;
  for (std::size_t k = 0; k < scene.fixtures.size(); ++k)
    if (looks[k] == Look::solid) result.push_back(bounds(view.outline(scene.fixtures[k].footprint)));
  std::vector<Vec3> positions;
  for (const Label& label : scene.labels) positions.push_back(label.position);
  const double r = label_mark_radius(view, positions);
  for (const Label& label : scene.labels) {
    const Point p = label_mark_positions(view, {&label.position, 1}, {&label.normal, 1}, r).front();
    result.push_back({p.x - r, p.y - r, p.x + r, p.y + r});
  }
  return result;
}

constexpr double mark_radius = 21;  // of a unit, in print

struct IdPosition {
  Rectangle text;
  bool is_far = false;
};

// In the order of preference: beside the middle, beside a corner, above, below, then farther away.
std::vector<IdPosition> positions_around(const Rectangle& own, double width, double size) {
  constexpr double near = 5, clear_of_marks = 17, far = 40;
  const Point middle = own.centre();
  std::vector<IdPosition> positions;
  const auto add = [&](double left, double top, bool is_far = false) {
    positions.push_back({{left, top, left + width, top + size}, is_far});
  };
  for (const double off : {near, clear_of_marks})
    for (const double left : {own.right + off, own.left - off - width}) add(left, middle.y - size / 2);
  for (const double left : {own.right + near, own.left - near - width})
    for (const double top : {own.bottom - size, own.top}) add(left, top);
  for (const double off : {near, clear_of_marks})
    for (const double top : {own.top - off - size, own.bottom + off}) add(middle.x - width / 2, top);
  for (const double left : {own.right + far, own.left - far - width})
    for (const double top : {own.top - far - size, own.bottom + far}) add(left, top, true);
  return positions;
}

// Inside the corners and the middles of the edges, then outside.
std::vector<IdPosition> positions_along_edges(const Rectangle& own, double width, double size) {
  constexpr double gap = 6;
  std::vector<IdPosition> positions;
  for (const double top : {own.top + gap, own.bottom - gap - size, own.top - gap - size, own.bottom + gap})
    for (const double left : {own.left + gap, own.right - gap - width, own.centre().x - width / 2})
      positions.push_back({{left, top, left + width, top + size}});
  return positions;
}

// The first position without obstacles.
IdPosition free_position(const std::vector<IdPosition>& positions, const std::vector<Rectangle>& obstacles,
                         const PlanView& view) {
  const auto found = std::find_if(positions.begin(), positions.end(), [&](const IdPosition& place) {
    const Rectangle& text = place.text;
    return text.left > 0 && text.right < view.width() && text.top > 0 && text.bottom < view.height() &&
           std::none_of(obstacles.begin(), obstacles.end(), [&](const auto& o) { return o.meets(text); });
  });
  return found == positions.end() ? positions.front() : *found;
}

// The place for an id on its fixture, nearest to the middle, that no mark covers.
Point clear_centre(const Extent& e, double width, double size, std::span<const Point> marks) {
  constexpr int steps = 20;
  const double radians = e.angle_deg * std::numbers::pi / 180;
  const Point along{std::cos(radians), std::sin(radians)};
  const double room = std::max(0.0, (e.along - width) / 2);
  for (int k = 0; k <= steps; ++k)
    for (const double sign : {1.0, -1.0}) {
      const double shift = sign * room * k / steps;
      const Point at{e.centre.x + shift * along.x, e.centre.y + shift * along.y};
      const auto covers = [&](const Point& mark) {
        const double u = (mark.x - at.x) * along.x + (mark.y - at.y) * along.y;
        const double v = (mark.y - at.y) * along.x - (mark.x - at.x) * along.y;
        return std::abs(u) < width / 2 + mark_radius && std::abs(v) < size / 2 + mark_radius;
      };
      if (std::none_of(marks.begin(), marks.end(), covers)) return at;
    }
  return e.centre;
}

void draw_leader(SvgCanvas& canvas, const Rectangle& text, const Rectangle& own) {
  const Point from = own.centre();
  canvas.line(
      {std::clamp(from.x, text.left, text.right), std::clamp(from.y, text.top, text.bottom)},
      {std::clamp(text.centre().x, own.left, own.right), std::clamp(text.centre().y, own.top, own.bottom)},
      "tick");
}

}  // namespace

void draw_fixture_ids(SvgCanvas& canvas, const PlanView& view, const Scene& scene,
                      std::span<const Point> marks, const std::set<std::string>& referenced) {
  constexpr double largest = 24, referenced_size = 20;  // drawing units
  const double smallest = 9 * view.mark_share(), outside = 11 * view.mark_share();
  const std::vector<Look> looks = looks_of(scene);
  std::vector<Rectangle> obstacles = obstacles_of(view, scene, looks);
  for (const Point& mark : marks)
    obstacles.push_back(
        {mark.x - mark_radius, mark.y - mark_radius, mark.x + mark_radius, mark.y + mark_radius});
  const auto draw = [&](const FixtureOutline& fixture, Look look, bool is_referenced) {
    const Extent e = extent_of(view, fixture);
    const double fits = std::min(0.66 * e.across, 0.92 * e.along / text_width(fixture.id, 1));
    const bool is_solid = look == Look::solid, inside = is_solid && fits >= smallest;
    const double size = inside ? std::min(fits, largest) : is_solid ? outside : largest;
    const double room = is_referenced ? std::max(size, referenced_size) : size;
    const double width = text_width(fixture.id, room);
    const char* const css_class = is_referenced ? "fid mid ref" : "fid mid";
    const std::string fitting = fmt::format("min(var(--fid,14px),{}px)", coordinate(size));
    canvas.raw(fmt::format("<g style=\"font-size:{}\">",
                           is_referenced ? fmt::format("max({},var(--ref,0px))", fitting) : fitting));
    if (inside) {
      const double down = 0.35 * size, radians = e.angle_deg * std::numbers::pi / 180;
      const Point centre = clear_centre(e, width, room, marks);
      canvas.text({centre.x - down * std::sin(radians), centre.y + down * std::cos(radians)}, fixture.id,
                  css_class, e.angle_deg);
    } else {
      const Rectangle own = bounds(view.outline(fixture.footprint));
      const IdPosition place = free_position(
          is_solid ? positions_around(own, width, room) : positions_along_edges(own, width, room), obstacles,
          view);
      if (place.is_far) draw_leader(canvas, place.text, own);
      const Point middle = place.text.centre();
      canvas.text({middle.x, middle.y + 0.35 * room}, fixture.id, css_class);
      obstacles.push_back(place.text);
    }
    canvas.raw("</g>");
  };
  for (const bool is_referenced : {false, true})
    for (std::size_t k = 0; k < scene.fixtures.size(); ++k) {
      const FixtureOutline& fixture = scene.fixtures[k];
      if (fixture.footprint.size() > 2 && referenced.contains(fixture.id) == is_referenced)
        draw(fixture, looks[k], is_referenced);
    }
}

}  // namespace shelfbeam
