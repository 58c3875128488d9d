#include "shelfbeam/report/store_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include <fmt/format.h>

#include "shelfbeam/report/text_format.hpp"

namespace shelfbeam {

namespace {

// A fixture's extent along and across its own direction.
struct Extent {
  Point centre;
  double along = 0, across = 0, angle_deg = 0;
};

Extent extent_of(const PlanView& view, const FixtureOutline& fixture) {
  const double turn = fixture.rotation_deg * std::numbers::pi / 180;
  const double c = std::cos(turn), s = std::sin(turn);
  double low_u = std::numeric_limits<double>::max(), high_u = -low_u, low_v = low_u, high_v = -low_u;
  for (const auto& [x, y] : fixture.footprint) {
    low_u = std::min(low_u, c * x + s * y);
    high_u = std::max(high_u, c * x + s * y);
    low_v = std::min(low_v, c * y - s * x);
    high_v = std::max(high_v, c * y - s * x);
  }
  const double u = (low_u + high_u) / 2, v = (low_v + high_v) / 2;
  Extent e{view.at(c * u - s * v, s * u + c * v), (high_u - low_u) * view.scale(),
           (high_v - low_v) * view.scale(), -fixture.rotation_deg};
  if (e.across > 1.001 * e.along) {
    std::swap(e.along, e.across);
    e.angle_deg -= 90;
  }
  // Upright: readable from below or from the right.
  e.angle_deg = std::remainder(e.angle_deg, 180);
  if (e.angle_deg > 89) e.angle_deg -= 180;
  return e;
}

const char* fixture_class(const FixtureOutline& fixture) {
  if (fixture.type == "gondola") return "fx fx-g";
  if (fixture.type == "freezer") return "fx fx-f";
  if (fixture.type == "box") return "fx fx-b";
  return "fx fx-m";
}

double text_width(const std::string& text, double size) {
  constexpr double glyph = 0.62;  // of a bold sans-serif, as a share of its size
  return glyph * size * static_cast<double>(text.size());
}

struct Rectangle {
  double left = 0, top = 0, right = 0, bottom = 0;
  bool meets(const Rectangle& o) const {
    return left < o.right && o.left < right && top < o.bottom && o.top < bottom;
  }
};

Rectangle bounds(const std::vector<Point>& points) {
  if (points.empty()) return {};
  Rectangle r{points[0].x, points[0].y, points[0].x, points[0].y};
  for (const Point& p : points)
    r = {std::min(r.left, p.x), std::min(r.top, p.y), std::max(r.right, p.x), std::max(r.bottom, p.y)};
  return r;
}

// Middle of the base line of a text beside fixture k, on the first side where it meets no other one; far
// enough off to leave room for the marks of labels.
Point free_place(const std::vector<Rectangle>& fixtures, std::size_t k, const PlanView& view, double width,
                 double size) {
  constexpr double off = 17;
  const Rectangle& own = fixtures[k];
  const double x = (own.left + own.right) / 2, y = (own.top + own.bottom) / 2 + 0.35 * size;
  const std::array<Point, 4> places{{{own.right + off + width / 2, y},
                                     {own.left - off - width / 2, y},
                                     {x, own.top - off},
                                     {x, own.bottom + off + 0.7 * size}}};
  for (const Point& p : places) {
    const Rectangle text{p.x - width / 2, p.y - size, p.x + width / 2, p.y};
    const bool on_paper = text.left > 0 && text.right < view.width() && text.top > 0;
    if (on_paper &&
        std::none_of(fixtures.begin(), fixtures.end(), [&](const auto& f) { return f.meets(text); }))
      return p;
  }
  return places[0];
}

}  // namespace

void draw_fixtures(SvgCanvas& canvas, const PlanView& view, const Scene& scene) {
  for (const FixtureOutline& fixture : scene.fixtures)
    if (fixture.footprint.size() > 2)
      canvas.polygon(view.outline(fixture.footprint), fixture_class(fixture),
                     fmt::format("{} ({}, {} m high)", fixture.id, fixture.type, fixed(fixture.height, 2)));
}

void draw_fixture_ids(SvgCanvas& canvas, const PlanView& view, const Scene& scene) {
  constexpr double largest = 24, smallest = 9, outside = 11;  // units
  std::vector<Rectangle> fixtures;
  for (const FixtureOutline& fixture : scene.fixtures)
    fixtures.push_back(bounds(view.outline(fixture.footprint)));
  for (std::size_t k = 0; k < scene.fixtures.size(); ++k) {
    const FixtureOutline& fixture = scene.fixtures[k];
    if (fixture.footprint.size() < 3) continue;
    const Extent e = extent_of(view, fixture);
    const double fits = std::min(0.66 * e.across, 0.92 * e.along / text_width(fixture.id, 1));
    const bool inside = fits >= smallest;
    const double size = inside ? std::min(fits, largest) : outside;
    canvas.raw(fmt::format("<g style=\"font-size:min(var(--fid,14px),{}px)\">", coordinate(size)));
    if (inside) {
      const double down = 0.35 * size, radians = e.angle_deg * std::numbers::pi / 180;
      canvas.text({e.centre.x - down * std::sin(radians), e.centre.y + down * std::cos(radians)}, fixture.id,
                  "fid mid", e.angle_deg);
    } else {
      canvas.text(free_place(fixtures, k, view, text_width(fixture.id, size), size), fixture.id, "fid mid");
    }
    canvas.close_group();
  }
}

void draw_crosses(SvgCanvas& canvas, const PlanView& view, std::span<const Vec3> positions, double arm,
                  std::string_view css_class) {
  std::string data;
  const std::string d = coordinate(arm), d2 = coordinate(2 * arm);
  for (const Vec3& position : positions) {
    const Point p = view.at(position.x, position.y);
    data += fmt::format("M{} {}h{}m-{} -{}v{}", coordinate(p.x - arm), coordinate(p.y), d2, d, d, d2);
  }
  if (!data.empty()) canvas.path(data, css_class);
}

double label_mark_radius(const PlanView& view, std::span<const Vec3> positions) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < positions.size(); ++k) {
    const Vec3 step = positions[k] - positions[k - 1];
    if (std::abs(step.z) < 1e-6 && length(step) > 1e-6) steps.push_back(length(step));
  }
  double usual = 0.5;
  if (!steps.empty()) {
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    usual = *middle;
  }
  return std::clamp(0.4 * usual * view.scale(), 2.0, 6.0);
}

std::vector<Point> label_mark_places(const PlanView& view, std::span<const Vec3> positions,
                                     std::span<const Vec3> normals, double radius) {
  std::map<std::tuple<long, long, long, long>, int> standing;
  std::vector<Point> places;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const Vec3& p = positions[k];
    const Vec3 outward{normals[k].x, normals[k].y, 0};
    const double flat = length(outward);
    const double nx = flat > 1e-6 ? outward.x / flat : 0, ny = flat > 1e-6 ? outward.y / flat : -1;
    const auto key =
        std::tuple{std::lround(p.x * 50), std::lround(p.y * 50), std::lround(nx * 10), std::lround(ny * 10)};
    const double out = radius * (1.15 + 2.3 * standing[key]++);
    const Point at = view.at(p.x, p.y);
    places.push_back({at.x + out * nx, at.y - out * ny});
  }
  return places;
}

}  // namespace shelfbeam
