#pragma once

#include <cstddef>
#include <cstdint>

#include "shelfbeam/transport/world/next_event.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// What goes from a source to a label without a walk.
struct DirectSignal {
  double straight = 0;  ///< through panes at most
  double mirrored = 0;  ///< over one plane mirror, if the rules look for these from end to end
  std::uint64_t rays = 0;

  DirectSignal& operator+=(const DirectSignal& other) {
    straight += other.straight;
    mirrored += other.mirrored;
    rays += other.rays;
    return *this;
  }
};

/// Light from a point of source j to a point (connect): the sums over the straight way and over plane mirrors
/// of weight(unit direction) I_j(omega) / d^2 times the share that gets through. `share_of` gives that of the
/// straight way, and is asked only if it matters.
template <class Weight, class Share>
DirectSignal light_from(const World& world, std::size_t j, const LightPoint& light, const SurfacePoint& at,
                        bool images, const Weight& weight, const Share& share_of) {
  DirectSignal signal;
  connect(
      world, at, light.position, images,
      [&](const Connection& way) {
        const double weighted = weight(way.from_first);
        return weighted > 0 ? weighted * world.emitters.intensity(j, light, way.from_second) : 0;
      },
      [&](double open, const Connection&) {
        ++signal.rays;
        signal.straight = open * share_of();
      },
      [&](double value, const Connection&) {
        signal.rays += 2;
        signal.mirrored += value;
      });
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
