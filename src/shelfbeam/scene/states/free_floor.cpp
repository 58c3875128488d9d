#include "shelfbeam/scene/states/free_floor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "shelfbeam/scene/plan_parts.hpp"

namespace shelfbeam {

FreeFloor::FreeFloor(const Scene& scene)
    : scene_(scene), obstacles_(obstacles_of(scene)), index_(bounds_of(obstacles_)) {}

// Meshes count with their triangles, because the hull of a mesh may contain free floor.
std::vector<FreeFloor::Obstacle> FreeFloor::obstacles_of(const Scene& scene) {
  std::vector<Obstacle> obstacles;
  const auto keep_clear = [&](const Vec3& p) {
    constexpr double around = 0.02;  // m
    obstacles.push_back({{{p.x - around, p.y - around},
                          {p.x + around, p.y - around},
                          {p.x + around, p.y + around},
                          {p.x - around, p.y + around}},
                         p.z,
                         p.z});
  };
  for (const Label& label : scene.labels) keep_clear(label.position);
  for (const Transceiver& unit : scene.transceivers)
    if (unit.installed) keep_clear(unit.position);
  for (const Part& part : scene.parts) {
    if (part.kind != PartKind::mesh) {
      obstacles.push_back({part.footprint, part.bottom, part.top});
      continue;
    }
    for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
      Obstacle obstacle{{}, HUGE_VAL, -HUGE_VAL};
      for (const std::uint32_t v : scene.mesh.triangles[t]) {
        const Vec3& p = scene.mesh.vertices[v];
        obstacle.plan.push_back({p.x, p.y});
        obstacle.bottom = std::min(obstacle.bottom, p.z);
        obstacle.top = std::max(obstacle.top, p.z);
      }
      obstacles.push_back(std::move(obstacle));
    }
  }
  return obstacles;
}

std::vector<Bounds> FreeFloor::bounds_of(const std::vector<Obstacle>& obstacles) {
  std::vector<Bounds> bounds;
  bounds.reserve(obstacles.size());
  for (const Obstacle& obstacle : obstacles) {
    bounds.emplace_back();
    for (const Vec2& p : obstacle.plan) {
      bounds.back().include(Vec3{p[0], p[1], obstacle.bottom});
      bounds.back().include(Vec3{p[0], p[1], obstacle.top});
    }
  }
  return bounds;
}

bool FreeFloor::is_free(const Polygon& plan, double height) const {
  constexpr double kerb = 0.02;  // m: carpets, thresholds
  Bounds block;
  for (const Vec2& p : plan) {
    block.include(Vec3{p[0], p[1], kerb});
    block.include(Vec3{p[0], p[1], height});
  }
  if (index_.any(block, [&](std::uint32_t k) { return overlap(obstacles_[k].plan, plan); })) return false;
  return !scene_.room || is_within_room(*scene_.room, plan, height);
}

bool TakenFloor::take(const Polygon& plan, double height) {
  const PlanBounds bounds = bounds_of(plan);
  for (auto other = taken_.lower_bound(bounds.low[0] - longest_);
       other != taken_.end() && other->first <= bounds.high[0]; ++other)
    if (other->second.bounds.meets(bounds) && overlap(other->second.plan, plan)) return false;
  if (!floor_.is_free(plan, height)) return false;
  longest_ = std::max(longest_, bounds.high[0] - bounds.low[0]);
  taken_.emplace(bounds.low[0], Taken{bounds, plan});
  return true;
}

}  // namespace shelfbeam
