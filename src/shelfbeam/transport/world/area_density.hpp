#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"

namespace shelfbeam {

/// How a point of a surface is seen from elsewhere.
struct Sight {
  Vec3 direction;  ///< unit, to the surface
  double cosine;   ///< of its angle of incidence, above 0
  double squared;  ///< distance, m^2

  /// The density per area of rays that leave in this direction with some density per solid angle p:
  /// p cos(theta) / r^2, as dA cos(theta) / r^2 is the solid angle of dA (2.10).
  double area_density(double p) const { return p * cosine / squared; }
};

/// Nothing where the point is seen from behind, its normal being that of the side which is meant.
inline std::optional<Sight> sight(const Vec3& from, const SurfacePoint& to) {
  const Vec3 way = to.position - from;
  const double squared = length_squared(way);
  if (!(squared > 0)) return std::nullopt;
  const Vec3 direction = way / std::sqrt(squared);
  const double cosine = -dot(direction, to.normal);
  if (!(cosine > 0)) return std::nullopt;
  return Sight{direction, cosine, squared};
}

/// The same density for rays that leave a surface with p = cos(theta') / pi: G / pi, with the geometry term G
/// (2.11) but for what stands between. 0 where one side is seen from behind.
inline double cosine_area_density(const SurfacePoint& from, const SurfacePoint& to) {
  const Vec3 way = to.position - from.position;
  const double squared = length_squared(way);
  const double cosines = std::max(0.0, dot(way, from.normal)) * std::max(0.0, -dot(way, to.normal));
  return squared > 0 ? cosines / (pi * squared * squared) : 0;
}

}  // namespace shelfbeam
