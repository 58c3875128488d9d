#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/transport/cache/surface_guide.hpp"
#include "shelfbeam/transport/world/next_event.hpp"

namespace shelfbeam {

/// Density per area with which the rays of a label at some point of it sample another point, without
/// visibility.
inline double label_density(const World& world, std::uint32_t label, const SurfacePoint& at,
                            const SurfacePoint& there) {
  const auto seen = sight(at.position, there);
  if (!seen) return 0;
  return seen->area_density(
      pdf(world.receivers.responsivity(label), world.receivers.frame(label).to_local(seen->direction)));
}

/// The labels of a cluster, which share a point (share_point). Each sends as many rays; the gain contains
/// their number, so `rays` is 1. The radiance is that of the base without its exit factor.
struct LabelSharers {
  const World& world;
  const std::vector<LabelId>& labels;
  const std::vector<SurfacePoint>& at;  ///< points of the labels
  const SurfacePoint& point;
  const SurfaceGuide& guide;  ///< of the point
  std::uint32_t rays_each;

  std::size_t size() const { return labels.size(); }
  RayEnd end(std::uint32_t c) const { return at[c]; }
  double rays(std::uint32_t) const { return 1; }
  double density(std::uint32_t c) const { return label_density(world, labels[c], at[c], point); }
  double gain(std::uint32_t c) const {
    return integral(world.receivers.responsivity(labels[c])) / rays_each *
           guide.exit_towards(point, at[c].position);
  }
};

}  // namespace shelfbeam
