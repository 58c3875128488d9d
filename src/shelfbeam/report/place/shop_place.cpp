#include "shelfbeam/report/place/shop_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "shelfbeam/math/polygon_edges.hpp"
#include "shelfbeam/report/place/look.hpp"

namespace shelfbeam {

namespace {

constexpr double face_distance = 0.1;     // m, between a unit and the face that it is mounted on
constexpr double plan_slack = 1e-6;       // m
constexpr double opposite_cosine = -0.8;  // of the directions to both sides of a way

// In plan: z is 0.
Bounds plan_box(std::span<const Vec2> polygon) {
  Bounds box;
  for (const auto& [x, y] : polygon) box.include(Vec3{x, y, 0});
  return box;
}

Vec2 nearest_on_outline(std::span<const Vec2> polygon, const Vec2& p) {
  Vec2 nearest = polygon.front();
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 at = nearest_point(polygon[k], polygon[(k + 1) % polygon.size()], p);
    if (const double away = distance(at, p); away < least) {
      least = away;
      nearest = at;
    }
  }
  return nearest;
}

double side_of(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

bool do_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0;
}

bool crosses(std::span<const Vec2> polygon, const Vec2& from, const Vec2& to) {
  for (std::size_t k = 0; k < polygon.size(); ++k)
    if (do_cross(polygon[k], polygon[(k + 1) % polygon.size()], from, to)) return true;
  return false;
}

std::vector<std::size_t> standing_fixtures(const Scene& scene) {
  const std::vector<Look> looks = looks_of(scene);
  std::vector<std::size_t> standing;
  for (std::size_t f = 0; f < scene.fixtures.size(); ++f)
    if (looks[f] == Look::solid && !scene.fixtures[f].is_wall() && !scene.fixtures[f].footprint.empty())
      standing.push_back(f);
  return standing;
}

}  // namespace

/// A fixture, or a wall of the room, near a position.
struct ShopPlaces::Near {
  const FixtureOutline* fixture = nullptr;  // null: a wall
  Vec2 way{};                               // to its nearest point
  double distance = 0;                      // 0 within its plan
};

ShopPlaces::ShopPlaces(const Scene& scene)
    : scene_(scene),
      inner_walls_(std::span(scene.fixtures).last(scene.inner_walls())),
      standing_(standing_fixtures(scene)),
      index_(
          BoxIndex::over(standing_, [&](std::size_t f) { return plan_box(scene.fixtures[f].footprint); })) {}

bool ShopPlaces::is_hidden(const Vec2& from, const Vec2& to) const {
  if (!scene_.room) return false;
  const auto is_between = [&](const Polygon& polygon) { return crosses(polygon, from, to); };
  return is_between(scene_.room->outline) ||
         std::any_of(scene_.room->holes.begin(), scene_.room->holes.end(), is_between) ||
         std::any_of(inner_walls_.begin(), inner_walls_.end(),
                     [&](const FixtureOutline& wall) { return is_between(wall.footprint); });
}

// Nearest first; ties in the order of the store.
std::vector<ShopPlaces::Near> ShopPlaces::near(const Vec3& position) const {
  const Vec2 from{position.x, position.y};
  const Vec3 in_plan{position.x, position.y, 0};
  std::vector<std::uint32_t> found;
  index_.any(Bounds{in_plan, in_plan}.wider_by(max_aisle), [&](std::uint32_t k) {
    found.push_back(k);
    return false;
  });
  std::sort(found.begin(), found.end());
  std::vector<Near> all;
  for (const std::uint32_t k : found) {
    const FixtureOutline& fixture = scene_.fixtures[standing_[k]];
    const Vec2 to = nearest_on_outline(fixture.footprint, from);
    const Vec2 way{to[0] - from[0], to[1] - from[1]};
    const bool is_within = fixture.footprint.size() > 2 && contains(fixture.footprint, from);
    const double distance = is_within ? 0 : std::hypot(way[0], way[1]);
    if (distance <= max_aisle && (is_within || !is_hidden(from, to)))
      all.push_back({&fixture, way, distance});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Near& a, const Near& b) { return a.distance < b.distance; });
  return all;
}

std::vector<ShopPlaces::Near> ShopPlaces::walls_near(const Vec2& from) const {
  std::vector<Near> walls;
  if (!scene_.room) return walls;
  const Polygon& outline = scene_.room->outline;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 to = nearest_point(outline[k], outline[(k + 1) % outline.size()], from);
    const Vec2 way{to[0] - from[0], to[1] - from[1]};
    const double distance = std::hypot(way[0], way[1]);
    if (distance > plan_slack && distance <= max_aisle) walls.push_back({nullptr, way, distance});
  }
  std::stable_sort(walls.begin(), walls.end(),
                   [](const Near& a, const Near& b) { return a.distance < b.distance; });
  return walls;
}

ShopPlace ShopPlaces::of(const Vec3& position) const {
  using Kind = ShopPlace::Kind;
  const Vec2 plan{position.x, position.y};
  const std::vector<Near> found = near(position);
  // Of several fixtures on one another, the highest below the unit.
  const FixtureOutline* below = nullptr;
  for (const Near& one : found) {
    const bool is_on_face = one.distance <= face_distance && position.z < one.fixture->height - plan_slack;
    if (is_on_face) return {Kind::at, one.fixture->id};
    if (one.distance <= plan_slack && (below == nullptr || one.fixture->height > below->height))
      below = one.fixture;
  }
  if (below != nullptr) return {Kind::above, below->id};
  if (!found.empty() && found.front().distance <= near_distance) {
    const Near& first = found.front();
    const auto is_across = [&](const Near& other) {
      const double cosine = (first.way[0] * other.way[0] + first.way[1] * other.way[1]) /
                            (std::hypot(first.way[0], first.way[1]) * std::hypot(other.way[0], other.way[1]));
      return cosine <= opposite_cosine && first.distance + other.distance <= max_aisle;
    };
    const std::vector<Near> walls = walls_near(plan);
    const auto second = std::find_if(found.begin() + 1, found.end(), is_across);
    const auto wall = std::find_if(walls.begin(), walls.end(), is_across);
    const bool has_second = second != found.end();
    if (has_second || wall != walls.end()) {
      const double top = std::max(first.fixture->height, has_second ? second->fixture->height : 0.0);
      const Kind kind = position.z > std::min(top, head_height) ? Kind::aisle : Kind::between;
      if (!has_second) return {kind, first.fixture->id};
      const bool is_in_order = first.fixture < second->fixture;
      const auto& [low, high] =
          is_in_order ? std::pair(first.fixture, second->fixture) : std::pair(second->fixture, first.fixture);
      return {kind, low->id, high->id};
    }
    return {Kind::beside, first.fixture->id};
  }
  if (scene_.room)
    if (const CeilingZone* zone = scene_.room->zone_over(plan))
      return {Kind::zone, {}, {}, zone->height.at(plan)};
  return {};
}

}  // namespace shelfbeam
