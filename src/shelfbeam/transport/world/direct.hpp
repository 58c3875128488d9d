#pragma once

#include <cstddef>
#include <cstdint>

#include "shelfbeam/transport/world/next_event.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// The signal of connections from a source to a label without a walk.
struct DirectSignal {
  double straight = 0;  ///< of the straight connection, attenuated by panes
  double mirrored = 0;  ///< of mirror paths, if PathRules::uses_images
  std::uint64_t rays = 0;

  DirectSignal& operator+=(const DirectSignal& other) {
    straight += other.straight;
    mirrored += other.mirrored;
    rays += other.rays;
    return *this;
  }
};

/// Light from a point of source j to a point `at` (connect): weight(direction) I_j(omega) / d^2 times the
/// transmittance, for the straight connection and summed over mirror paths. `share_of` returns the
/// transmittance of the straight connection; it is called only if the rest of the product is not 0.
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

/// Direct light from a point of the source to a point of the label, in closed form: R(theta) I_j(omega) / d^2
/// times the transmittance.
DirectSignal direct_signal(const World& world, std::size_t i, std::size_t j, const SurfacePoint& label,
                           const LightPoint& light, const PathRules& rules);

/// Whether label and source are both points, so that the closed form needs no sampling.
bool is_point_to_point(const World& world, std::size_t i, std::size_t j);
DirectSignal direct_between_points(const World& world, std::size_t i, std::size_t j, const PathRules& rules);

/// Estimates the mean of `direct_signal` over the areas of label and source with a lattice of at least
/// `at_least`^2 strata.
DirectSignal sample_direct(const World& world, std::size_t i, std::size_t j, const PathKey& key,
                           std::uint32_t at_least, const PathRules& rules);

}  // namespace shelfbeam
