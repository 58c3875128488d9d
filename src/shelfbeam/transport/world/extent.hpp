#pragma once

#include <algorithm>
#include <cmath>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The box around all surfaces, labels and units.
inline Bounds extent(const Scene& scene) {
  Bounds box;
  for (const Vec3& vertex : scene.mesh.vertices) box.include(vertex);
  for (const Label& label : scene.labels) box.include(label.position);
  for (const Transceiver& unit : scene.transceivers) box.include(unit.position);
  return box;
}

/// The point from which coordinates count in single precision, and the largest of these coordinates, m.
struct RayCoordinates {
  Vec3 centre;
  double largest = 0;

  /// Rounding error of the largest coordinate.
  double rounding() const { return largest / (1 << 24); }
  /// Offsets of rays: at the start from a surface, and at the end from the target, whose surface a ray may
  /// meet at a grazing angle. A quarter of either suffices in all tests.
  double start() const { return 16 * rounding(); }
  double end() const { return 64 * rounding(); }
};

/// Two solids that overlap by up to this length count as touching, m; a solid and a sheet by half of it.
constexpr double max_overlap = 3e-5;

inline RayCoordinates ray_coordinates(const Scene& scene) {
  const Bounds box = extent(scene);
  const auto largest = [](const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); };
  const double from_zero = std::max(largest(box.low), largest(box.high));
  const double from_middle = largest(box.high - box.low) / 2;
  if (from_zero <= 4 * from_middle) return {{}, from_zero};
  return {(box.low + box.high) / 2, from_middle};
}

}  // namespace shelfbeam
