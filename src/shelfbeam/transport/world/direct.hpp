#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "shelfbeam/transport/world/path_rules.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// What goes from a source to a label without a walk.
struct DirectSignal {
  double straight = 0;  ///< through panes at most
  double mirrored = 0;  ///< over one plane mirror, if the rules look for these from end to end
  std::uint64_t rays = 0;

  DirectSignal& operator+=(const DirectSignal& other);
};

/// Light from a point of source j to a point, in closed form but for visibility: over every way (straight,
/// and over plane mirrors where `images`) weight(unit direction) I_j(omega) / d^2 times the share that gets
/// through. `share_of` gives the share of the straight way, and is asked only if it matters.
template <class Weight, class Share>
DirectSignal light_from(const World& world, std::size_t j, const LightPoint& light, const SurfacePoint& at,
                        bool images, Weight&& weight, const Share& share_of) {
  DirectSignal signal;
  const Vec3 way = light.position - at.position;
  const double squared = length_squared(way);
  if (!(squared > 0)) return signal;
  const Vec3 to_source = way / std::sqrt(squared);
  const double weighted = weight(to_source);
  const double value = weighted > 0 ? weighted * world.emitters.intensity(j, light, -to_source) / squared : 0;
  if (value > 0) {
    ++signal.rays;
    signal.straight = value * share_of();
  }
  if (!images) return signal;
  for (std::size_t g = 0; g < world.mirrors.size(); ++g) {
    const auto bend = world.mirrors.bend(g, at.position, light.position);
    if (!bend) continue;
    const double mirrored = weight(bend->from_first) * world.emitters.intensity(j, light, bend->from_second) /
                            bend->length_squared;
    if (!(mirrored > 0)) continue;
    signal.rays += 2;
    signal.mirrored += mirrored * world.mirrors.share(g, *bend, at, light.position, world.rays);
  }
  return signal;
}

/// Between a point of the source and a point of the label, in closed form: R(theta) I_j(omega) / d^2 times
/// visibility.
DirectSignal direct_signal(const World& world, std::size_t i, std::size_t j, const SurfacePoint& label,
                           const LightPoint& light, const PathRules& rules);

/// Whether label and source are both points, so that the closed form is all.
bool is_point_to_point(const World& world, std::size_t i, std::size_t j);
DirectSignal direct_between_points(const World& world, std::size_t i, std::size_t j, const PathRules& rules);

/// The mean over label and source of `direct_signal`, estimated from a lattice of at least
/// `at_least`^2 strata.
DirectSignal sample_direct(const World& world, std::size_t i, std::size_t j, const PathKey& key,
                           std::uint32_t at_least, const PathRules& rules);

}  // namespace shelfbeam
