#include "shelfbeam/scene/room/plan_effort.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "shelfbeam/base/fields/problems.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/polygon_edges.hpp"

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

}  // namespace

void PlanEffort::expect(bool is_within, const JsonCursor& json, const std::string& problem,
                        const std::string& remedy) {
  if (is_exceeded_) throw Consequence{};
  if (is_within) return;
  is_exceeded_ = true;
  json.fail(problem, remedy);
}

void PlanEffort::divide(const RoomShape& shape, const Polygon& polygon, const JsonCursor& json) {
  constexpr std::size_t most = 12'000;
  const PlanBounds bounds = bounds_of(polygon);
  const auto count = [&](const Polygon& border) {
    each_edge(border, [&](const Vec2& a, const Vec2& b) {
      divided_ += bounds_of(std::array{a, b}).meets(bounds) ? 1 : 0;
    });
  };
  count(shape.outline);
  for (const Polygon& hole : shape.holes) count(hole);
  for (const CeilingZone& zone : shape.zones) count(zone.polygon);
  expect(
      divided_ <= most, json,
      fmt::format("is one of too many: zones and openings together are near more than {} edges of the plan",
                  grouped(most)),
      "use fewer or smaller zones and openings");
}

double PlanEffort::shared_area(const Polygon& a, const Polygon& b, const JsonCursor& json) {
  constexpr std::size_t most = 1'000'000;
  if (!bounds_of(a).meets(bounds_of(b)) || (!has_a_turn(a) && is_beyond_an_edge(a, b)) ||
      (!has_a_turn(b) && is_beyond_an_edge(b, a)))
    return 0;
  compared_ += a.size() + b.size();
  expect(compared_ <= most, json, "is one of too many parts of the plan that lie within the bounds of others",
         "use fewer holes, zones and inner walls");
  return shelfbeam::shared_area(a, b);
}

}  // namespace shelfbeam
