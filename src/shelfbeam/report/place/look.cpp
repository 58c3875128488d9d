#include "shelfbeam/report/place/look.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/math/polygon.hpp"

namespace shelfbeam {

namespace {

constexpr double large_share = 0.3;  // of the floor

// In plan: z is 0.
Bounds bounds_of(const FixtureOutline& fixture) {
  Bounds bounds;
  for (const auto& [x, y] : fixture.footprint) bounds.include(Vec3{x, y, 0});
  return bounds;
}

bool surrounds(const Polygon& outer, const Polygon& inner) {
  constexpr double rounding = 1e-9;  // m
  return std::all_of(inner.begin(), inner.end(), [&](const Vec2& corner) {
    return contains(outer, corner) || distance_to_border(outer, corner) < rounding;
  });
}

// The lowest point of every fixture.
std::vector<double> bottoms_of(const Scene& scene) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  std::vector<double> bottoms(scene.fixtures.size(), unknown);
  for (const Part& part : scene.parts)
    if (part.fixture < bottoms.size() && part.kind != PartKind::shell)
      bottoms[part.fixture] = std::min(bottoms[part.fixture], part.bottom);
  std::replace(bottoms.begin(), bottoms.end(), unknown, 0.0);
  return bottoms;
}

}  // namespace

std::vector<Look> looks_of(const Scene& scene) {
  const Vec3 size = scene.upper - scene.lower;
  const double floor = scene.room ? std::abs(signed_area(scene.room->outline)) : size.x * size.y;
  const std::vector<double> bottoms = bottoms_of(scene);
  std::vector<Bounds> bounds;
  for (const FixtureOutline& fixture : scene.fixtures) bounds.push_back(bounds_of(fixture));
  const BoxIndex index(bounds);
  std::vector<Look> looks;
  for (std::uint32_t f = 0; f < scene.fixtures.size(); ++f) {
    const FixtureOutline& fixture = scene.fixtures[f];
    const auto is_inside = [&](std::uint32_t other) {
      return other != f && scene.fixtures[other].footprint.size() > 2 &&
             scene.fixtures[other].height <= fixture.height &&
             surrounds(fixture.footprint, scene.fixtures[other].footprint);
    };
    const bool covers =
        fixture.footprint.size() > 2 &&
        (signed_area(fixture.footprint) > large_share * floor || index.any(bounds[f], is_inside));
    looks.push_back(bottoms[f] >= head_height ? Look::overhead : covers ? Look::covering : Look::solid);
  }
  return looks;
}

}  // namespace shelfbeam
