#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/report/drawing/fixture_look.hpp"
#include "shelfbeam/report/drawing/part_drawing.hpp"
#include "shelfbeam/report/drawing/store_layer.hpp"
#include "shelfbeam/report/drawing/text_space.hpp"
#include "shelfbeam/report/drawing/zone_names.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

// The extent of a fixture along and across its own direction.
struct Extent {
  Point centre;
  double along = 0, across = 0, angle_deg = 0;
  bool is_slanted = false;
};

// The square in a concave fixture about the point that is farthest from its border.
Extent extent_within(const PlanView& view, const Polygon& polygon) {
  constexpr int steps = 24;
  Span x, y;
  for (const Vec2& corner : polygon) {
    x.add(corner[0]);
    y.add(corner[1]);
  }
  Vec2 best = polygon.front();
  double most = 0;
  for (int i = 1; i < steps; ++i)
    for (int j = 1; j < steps; ++j) {
      const Vec2 p{x.low + x.size() * i / steps, y.low + y.size() * j / steps};
      const double distance = contains(polygon, p) ? distance_to_border(polygon, p) : 0;
      if (distance > most + 1e-9) {
        most = distance;
        best = p;
      }
    }
  return {view.at(best[0], best[1]), 2 * most * view.scale(), 2 * most * view.scale()};
}

Extent extent_of(const PlanView& view, const FixtureOutline& fixture) {
  if (!is_convex(fixture.footprint)) return extent_within(view, fixture.footprint);
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
  e.is_slanted = std::abs(std::remainder(e.angle_deg, 90)) > 1;
  return e;
}

// Areas that an id must not cover: fixtures, label marks, ids beside their fixtures. Ids may lie within
// the outline of a lowered ceiling.
std::vector<Obstacle> obstacles_of(const PlanView& view, const Scene& scene, const std::vector<Look>& looks) {
  std::vector<Obstacle> result;
  for (std::size_t k = 0; k < scene.fixtures.size(); ++k)
    if (looks[k] == Look::solid) result.emplace_back(view.outline(scene.fixtures[k].footprint));
  std::vector<Vec3> positions;
  for (const Label& label : scene.labels) positions.push_back(label.position);
  const double r = label_mark_radius(view, positions);
  for (const Label& label : scene.labels) {
    const Point p = label_mark_positions(view, {&label.position, 1}, {&label.normal, 1}, r).front();
    result.emplace_back(Rectangle{p.x - r, p.y - r, p.x + r, p.y + r});
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

// Beside the long sides of a slanted fixture, from its middle to its ends, then beyond its ends.
std::vector<IdPosition> positions_beside(const Extent& e, double width, double size) {
  constexpr double near = 5, far = 40;
  const double radians = e.angle_deg * std::numbers::pi / 180;
  const Point along{std::cos(radians), std::sin(radians)}, across{-along.y, along.x};
  std::vector<IdPosition> positions;
  const auto add = [&](const Point& from, const Point& way, double off, bool is_far) {
    const double away = off + (std::abs(way.x) * width + std::abs(way.y) * size) / 2;
    const Point centre{from.x + away * way.x, from.y + away * way.y};
    positions.push_back(
        {{centre.x - width / 2, centre.y - size / 2, centre.x + width / 2, centre.y + size / 2}, is_far});
  };
  for (const double off : {near, far})
    for (const double share : {0.0, 0.25, -0.25, 0.4, -0.4})
      for (const double side : {1.0, -1.0})
        add({e.centre.x + share * e.along * along.x, e.centre.y + share * e.along * along.y},
            {side * across.x, side * across.y}, e.across / 2 + off, off == far);
  for (const double side : {1.0, -1.0})
    add(e.centre, {side * along.x, side * along.y}, e.along / 2 + near, false);
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
IdPosition free_position(const std::vector<IdPosition>& positions, const std::vector<Obstacle>& obstacles,
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

std::vector<Point> turned_rectangle(const Point& centre, double width, double height, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  std::vector<Point> corners;
  for (const auto& [x, y] : {Point{-1, -1}, Point{1, -1}, Point{1, 1}, Point{-1, 1}})
    corners.push_back(
        {centre.x + (x * width * c - y * height * s) / 2, centre.y + (x * width * s + y * height * c) / 2});
  return corners;
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
                      std::span<const Point> marks, const std::set<std::string>& referenced,
                      std::vector<Obstacle>* texts) {
  const Words words = words_of(scene);
  constexpr double largest = 24, referenced_size = 20;  // drawing units
  const double smallest = 9 * view.mark_share(), outside = 11 * view.mark_share();
  const std::vector<Look> looks = looks_of(scene);
  std::vector<Obstacle> obstacles = obstacles_of(view, scene, looks);
  for (const Point& mark : marks)
    obstacles.emplace_back(
        Rectangle{mark.x - mark_radius, mark.y - mark_radius, mark.x + mark_radius, mark.y + mark_radius});
  const auto others = static_cast<std::ptrdiff_t>(obstacles.size());
  if (scene.room) draw_zone_names(words, canvas, view, *scene.room, obstacles);
  if (texts != nullptr) texts->insert(texts->end(), obstacles.begin() + others, obstacles.end());
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
      if (texts != nullptr) texts->emplace_back(turned_rectangle(centre, width, room, radians));
    } else {
      const Rectangle own = Rectangle::around(view.outline(fixture.footprint));
      const IdPosition place = free_position(e.is_slanted && (is_solid || fixture.footprint.size() == 2)
                                                 ? positions_beside(e, width, room)
                                             : !is_solid ? positions_along_edges(own, width, room)
                                                         : positions_around(own, width, room),
                                             obstacles, view);
      if (place.is_far) draw_leader(canvas, place.text, own);
      const Point middle = place.text.centre();
      canvas.text({middle.x, middle.y + 0.35 * room}, fixture.id, css_class);
      obstacles.emplace_back(place.text);
      if (texts != nullptr) texts->emplace_back(place.text);
    }
    canvas.raw("</g>");
  };
  for (const bool is_referenced : {false, true})
    for (std::size_t k = 0; k < scene.fixtures.size(); ++k) {
      const FixtureOutline& fixture = scene.fixtures[k];
      if (has_plan(fixture) && referenced.contains(fixture.id) == is_referenced)
        draw(fixture, looks[k], is_referenced);
    }
}

}  // namespace shelfbeam
