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

/// Next-event estimation (2.7.2): joins a vertex x of a path to a point y that no random direction need meet,
/// of a source or, where the path comes from a source, of a label. Each way between them, the straight one
/// and, with `over_mirrors`, those over one plane mirror, contributes
///
///     f_r cos(theta_x) I(y) / d^2 V.
///
/// That is the paper's f_r L_e G / p(y) with G as in (2.11): a source of area A whose points are drawn with
/// density p(y) = 1 / A would have the intensity I = L_e A cos(theta_y) if all of it were at y. At a label R
/// stands for f_r cos(theta_x), or for I where it is the end.
///
/// `ends(connection)` is the product for both ends. `straight(open, connection)` gets what the straight way
/// contributes if V is 1, unless that is 0: callers trace V themselves, one by one or in packets.
/// `mirrored(value, connection)` gets contributions with V, which takes two rays: the mirror's reflectance,
/// panes and obstacles.
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
    const auto bent = world.mirrors.bend(g, vertex.position, end);
    if (!bent) continue;
    const double open = ends(*bent) / bent->length_squared;
    if (open > 0) mirrored(open * world.mirrors.share(g, *bent, vertex, end, world.rays), *bent);
  }
}

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
