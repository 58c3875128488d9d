#include "shelfbeam/scene/room/plan_effort.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "shelfbeam/base/fields/problems.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/polygon_edges.hpp"
#include "shelfbeam/scene/room/plan_lines.hpp"

namespace shelfbeam {

namespace {

// Whether all corners of one are on the outer side of an edge of the other, or on it.
bool is_beyond_an_edge(const Polygon& one, const Polygon& other) {
  const double turn = signed_area(one) > 0 ? 1 : -1;
  bool is_beyond = false;
  each_edge(one, [&](const Vec2& a, const Vec2& b) {
    is_beyond = is_beyond || std::all_of(other.begin(), other.end(), [&](const Vec2& p) {
                  return turn * ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) <= 0;
                });
  });
  return is_beyond;
}

bool has_a_turn(const Polygon& polygon) {
  if (signed_area(polygon) > 0) return !is_convex(polygon);
  return !is_convex(Polygon(polygon.rbegin(), polygon.rend()));
}

// Adds to a sum that must not exceed `most`: only its first excess is reported.
template <class Fail>
void add(std::size_t& sum, std::size_t count, std::size_t most, const Fail& fail) {
  if (sum > most) throw Consequence{};
  sum += count;
  if (sum > most) fail();
}

}  // namespace

void PlanEffort::divide(const RoomShape& shape, const Polygon& polygon, const JsonCursor& json) {
  constexpr std::size_t most = 12'000;
  const PlanBounds bounds = bounds_of(polygon);
  std::size_t near = 0;
  const auto count = [&](const Polygon& border) {
    each_edge(border, [&](const Vec2& a, const Vec2& b) {
      near += bounds_of(std::array{a, b}).meets(bounds) ? 1 : 0;
    });
  };
  count(shape.outline);
  for (const Polygon& hole : shape.holes) count(hole);
  for (const CeilingZone& zone : shape.zones) count(zone.polygon);
  add(divided_, near, most, [&] {
    json.fail(
        fmt::format("is one of too many: zones and openings together are near more than {} edges of the "
                    "plan",
                    grouped(most)),
        "use fewer or smaller zones and openings");
  });
}

double PlanEffort::shared_area(const Polygon& a, const Polygon& b, const JsonCursor& json) {
  constexpr std::size_t most = 1'000'000;
  if (!bounds_of(a).meets(bounds_of(b)) || (!has_a_turn(a) && is_beyond_an_edge(a, b)) ||
      (!has_a_turn(b) && is_beyond_an_edge(b, a)))
    return 0;
  add(compared_, a.size() + b.size(), most, [&] {
    json.fail("is one of too many parts of the plan that lie within the bounds of others",
              "use fewer holes, zones and inner walls");
  });
  return shelfbeam::shared_area(a, b);
}

void PlanEffort::add_corners(const Polygon& polygon, const JsonCursor& json) {
  add(corners_, polygon.size(), PlanLines::max_count, [&] {
    json.fail(fmt::format("is one of too many: outline, holes and zones together have {} corners", corners_),
              fmt::format("at most {} are allowed", PlanLines::max_count));
  });
}

}  // namespace shelfbeam
