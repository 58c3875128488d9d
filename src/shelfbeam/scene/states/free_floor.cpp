#include "shelfbeam/scene/states/free_floor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "shelfbeam/scene/build/blocks.hpp"
#include "shelfbeam/scene/plan_parts.hpp"

namespace shelfbeam {

FreeFloor::FreeFloor(const Scene& scene)
    : scene_(scene),
      obstacles_(obstacles_of(scene)),
      index_(BoxIndex::over(obstacles_, [](const Part& part) { return shelfbeam::bounds_of(part); })) {}

// Meshes count with their triangles, because the hull of a mesh may contain free floor.
std::vector<Part> FreeFloor::obstacles_of(const Scene& scene) {
  std::vector<Part> obstacles;
  const auto add = [&](Polygon plan, double bottom, double top) {
    obstacles.push_back({PartKind::solid, 0, {}, std::move(plan), bottom, top});
  };
  const auto keep_clear = [&](const Vec3& p) {
    constexpr double around = 0.02;  // m
    add({{p.x - around, p.y - around},
         {p.x + around, p.y - around},
         {p.x + around, p.y + around},
         {p.x - around, p.y + around}},
        p.z, p.z);
  };
  for (const Label& label : scene.labels) keep_clear(label.position);
  for (const Transceiver& unit : scene.transceivers)
    if (unit.installed) keep_clear(unit.position);
  for (const Part& part : scene.parts) {
    if (part.kind != PartKind::mesh) {
      add(part.footprint, part.bottom, part.top);
      continue;
    }
    for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
      Polygon plan;
      double bottom = HUGE_VAL, top = -HUGE_VAL;
      for (const std::uint32_t v : scene.mesh.triangles[t]) {
        const Vec3& p = scene.mesh.vertices[v];
        plan.push_back({p.x, p.y});
        bottom = std::min(bottom, p.z);
        top = std::max(top, p.z);
      }
      add(std::move(plan), bottom, top);
    }
  }
  return obstacles;
}

bool FreeFloor::is_free(const Polygon& plan, double height) const {
  constexpr double kerb = 0.02;  // m: carpets, thresholds
  Bounds block;
  for (const Vec2& p : plan) {
    block.include(Vec3{p[0], p[1], kerb});
    block.include(Vec3{p[0], p[1], height});
  }
  if (index_.any(block, [&](std::uint32_t k) { return overlap(obstacles_[k].footprint, plan); }))
    return false;
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
