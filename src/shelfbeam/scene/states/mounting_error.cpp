#include "shelfbeam/scene/states/mounting_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "shelfbeam/math/polygon_edges.hpp"
#include "shelfbeam/scene/states/draws.hpp"

namespace shelfbeam {

namespace {

constexpr double length_rounding = 1e-9;  // m

// The distance from p, in either direction, at which a line meets the edge; infinite if it does not.
double distance_along(const Vec2& p, const Vec2& direction, const Vec2& a, const Vec2& b) {
  const double x = b[0] - a[0], y = b[1] - a[1], slope = direction[0] * y - direction[1] * x;
  if (std::abs(slope) <= length_rounding * std::hypot(x, y)) return HUGE_VAL;
  const double to_x = a[0] - p[0], to_y = a[1] - p[1];
  const double share = (to_x * direction[1] - to_y * direction[0]) / slope;
  return share < 0 || share > 1 ? HUGE_VAL : std::abs((to_x * y - to_y * x) / slope);
}

// A value that is reflected at -limit and limit until it lies between them.
double folded(double value, double limit) {
  if (std::abs(value) <= limit) return value;
  if (!(limit > length_rounding)) return 0;
  const double turn = std::fmod(std::abs(value) + limit, 4 * limit);
  return std::copysign(turn <= 2 * limit ? turn - limit : 3 * limit - turn, value);
}

}  // namespace

MountingError::MountingError(const Scene& scene)
    : scene_(scene),
      blocks_(scene),
      room_edges_(edges_of(scene)),
      room_index_(BoxIndex::over(room_edges_, [](const Edge& edge) {
        Bounds bounds;
        for (const auto& [x, y] : {edge.a, edge.b}) bounds.include(Vec3{x, y, 0});
        return bounds;
      })) {}

std::vector<MountingError::Edge> MountingError::edges_of(const Scene& scene) {
  std::vector<Edge> edges;
  if (!scene.room) return edges;
  const auto add = [&](const Vec2& a, const Vec2& b) { edges.push_back({a, b}); };
  each_edge(scene.room->outline, add);
  for (const Polygon& hole : scene.room->holes) each_edge(hole, add);
  for (const CeilingZone& zone : scene.room->zones) each_edge(zone.polygon, add);
  return edges;
}

// Between zones, only ceilings below the point are in the way.
bool MountingError::is_surface_at(const Edge& edge, const Vec3& p) const {
  constexpr double beside = 1e-5;  // m
  const double size = distance(edge.a, edge.b);
  const Vec2 across{(edge.a[1] - edge.b[1]) / size * beside, (edge.b[0] - edge.a[0]) / size * beside};
  const auto [x, y] = nearest_point(edge.a, edge.b, {p.x, p.y});
  return !scene_.room->beyond({x + across[0], y + across[1], p.z}, 0).empty() ||
         !scene_.room->beyond({x - across[0], y - across[1], p.z}, 0).empty();
}

std::vector<MountingError::Edge> MountingError::edges_within(const Vec3& p, double reach) const {
  std::vector<Edge> edges;
  const Vec2 plan{p.x, p.y};
  const auto is_near = [&](const Edge& edge) {
    return distance(nearest_point(edge.a, edge.b, plan), plan) <= reach;
  };
  const Vec3 foot{p.x, p.y, 0};
  room_index_.any(Bounds{foot, foot}.wider_by(reach), [&](std::uint32_t k) {
    if (is_near(room_edges_[k]) && is_surface_at(room_edges_[k], p)) edges.push_back(room_edges_[k]);
    return false;
  });
  blocks_.any(Bounds{p, p}.wider_by(reach), [&](const Part& part) {
    if (p.z - part.bottom > length_rounding && part.top - p.z > length_rounding)
      each_edge(part.footprint, [&](const Vec2& a, const Vec2& b) {
        if (distance(a, b) > 0 && is_near({a, b})) edges.push_back({a, b});
      });
    return false;
  });
  return edges;
}

bool MountingError::is_free(const Vec3& from, const Vec3& to) const {
  if (scene_.room && !scene_.room->beyond(to, 0).empty()) return false;
  Bounds path;
  path.include(from);
  path.include(to);
  return !blocks_.any(path, [&](const Part& part) {
    const Stretch within = stretch_within(part, from, to - from);
    return within.begin < within.end && within.begin < 1 && within.end > 0;
  });
}

Vec3 MountingError::moved(const Vec3& planned, const Vec2& deviation) const {
  const Vec2 p{planned.x, planned.y};
  Vec2 by = deviation;
  const std::vector<Edge> edges = edges_within(planned, std::hypot(by[0], by[1]));
  if (!edges.empty()) {
    const auto far = [&](const Edge& edge) { return distance(nearest_point(edge.a, edge.b, p), p); };
    const Edge& nearest = *std::min_element(edges.begin(), edges.end(),
                                            [&](const Edge& a, const Edge& b) { return far(a) < far(b); });
    const Vec2 foot = nearest_point(nearest.a, nearest.b, p);
    const double gap = far(nearest);
    // At a corner away from it, otherwise across the edge.
    const bool is_corner = (foot == nearest.a || foot == nearest.b) && gap > length_rounding;
    const double size = is_corner ? gap : distance(nearest.a, nearest.b);
    const Vec2 across =
        is_corner ? Vec2{(p[0] - foot[0]) / size, (p[1] - foot[1]) / size}
                  : Vec2{(nearest.a[1] - nearest.b[1]) / size, (nearest.b[0] - nearest.a[0]) / size};
    const Vec2 along{-across[1], across[0]};
    double to_surface = gap, on_surface = HUGE_VAL;
    for (const auto& [a, b] : edges) {
      to_surface = std::min(to_surface, distance_along(p, across, a, b));
      if (const double way = distance_along(p, along, a, b); way > length_rounding || gap > length_rounding)
        on_surface = std::min(on_surface, way);
    }
    const double x = by[0] * across[0] + by[1] * across[1], y = by[0] * along[0] + by[1] * along[1];
    const double u = folded(x, to_surface), v = folded(y, on_surface);
    if (u != x || v != y) by = {u * across[0] + v * along[0], u * across[1] + v * along[1]};
  }
  // Corners may be in the way of both. Half the way again is as likely as its opposite.
  constexpr int halvings = 10;
  for (int k = 0; k < halvings; ++k) {
    const auto at = [&](double sign) {
      return Vec3{rounded(planned.x + sign * by[0], 1e6), rounded(planned.y + sign * by[1], 1e6),
                  rounded(planned.z, 1e6)};
    };
    const Vec3 to = at(1);
    if (is_free(planned, to) && is_free(planned, at(-1))) return to;
    by = {by[0] / 2, by[1] / 2};
  }
  return planned;
}

}  // namespace shelfbeam
