#pragma once

#include <cmath>
#include <cstddef>

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

}  // namespace shelfbeam
