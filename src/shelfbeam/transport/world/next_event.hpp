#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/world/mis_weights.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Next event estimation (2.7.2): connects a vertex x of a path to a point y of a source or, if the path
/// starts at a source, of a label. The straight connection and, with `over_mirrors`, each mirror path
/// contribute
///
///     f_r cos(theta_x) I(y) / d^2 V.
///
/// This is the paper's f_r L_e G / p(y) with G as in (2.11): a source of area A, sampled with density
/// p(y) = 1 / A, has the intensity I = L_e A cos(theta_y) if it is concentrated at y. At a label, R replaces
/// f_r cos(theta_x) if the label is x, and I if it is y.
///
/// `ends(connection)` returns the product of the factors at both ends. `straight(open, connection)` receives
/// the contribution of the straight connection for V = 1, unless it is 0: callers trace V themselves, singly
/// or in packets. `mirrored(value, connection)` receives the contribution of a mirror path including V (the
/// mirror's reflectance, panes and obstacles), for which `connect` traces two rays.
template <class Ends, class Straight, class Mirrored>
void connect(const World& world, const SurfacePoint& vertex, const Vec3& end, bool over_mirrors, Ends&& ends,
             Straight&& straight, Mirrored&& mirrored) {
  const Vec3 way = end - vertex.position;
  const double squared = length_squared(way);
  if (squared > 0) {
    const Vec3 direction = way / std::sqrt(squared);
    const Connection connection{direction, -direction, squared};
    const double open = ends(connection) / squared;
    if (open > 0) straight(open, connection);
  }
  if (!over_mirrors) return;
  for (std::size_t g = 0; g < world.mirrors.size(); ++g) {
    const auto mirror_path = world.mirrors.mirror_path(g, vertex.position, end);
    if (!mirror_path) continue;
    const double open = ends(*mirror_path) / mirror_path->length_squared;
    if (open > 0)
      mirrored(open * world.mirrors.share(g, *mirror_path, vertex, end, world.rays), *mirror_path);
  }
}

/// Direction, angle and distance at which a position sees a point of a surface.
struct Sight {
  Vec3 direction;           ///< unit length, to the surface
  double cosine;            ///< of the angle of incidence, above 0
  double distance_squared;  ///< distance squared, m^2

  /// Converts a density p per solid angle to a density per area of the surface: p cos(theta) / r^2, because
  /// dA cos(theta) / r^2 is the solid angle of dA (2.10).
  double area_density(double p) const { return p * cosine / distance_squared; }
};

/// No value if `from` is behind the surface; the normal of `to` selects its side.
inline std::optional<Sight> sight(const Vec3& from, const SurfacePoint& to) {
  const Vec3 way = to.position - from;
  const double squared = length_squared(way);
  if (!(squared > 0)) return std::nullopt;
  const Vec3 direction = way / std::sqrt(squared);
  const double cosine = -dot(direction, to.normal);
  if (!(cosine > 0)) return std::nullopt;
  return Sight{direction, cosine, squared};
}

/// Density per area at `to` of rays that leave `from` with p = cos(theta') / pi per solid angle: G / pi, with
/// the geometry term G (2.11) without visibility. 0 if either point is behind the other's surface.
inline double cosine_area_density(const SurfacePoint& from, const SurfacePoint& to) {
  const Vec3 way = to.position - from.position;
  const double squared = length_squared(way);
  const double cosines = std::max(0.0, dot(way, from.normal)) * std::max(0.0, -dot(way, to.normal));
  return squared > 0 ? cosines / (pi * squared * squared) : 0;
}

}  // namespace shelfbeam
