#pragma once

#include <cstddef>
#include <cstdint>

#include "shelfbeam/transport/path_rules.hpp"
#include "shelfbeam/transport/world.hpp"

namespace shelfbeam {

/// What goes from a source to a label without a walk.
struct DirectSignal {
  double straight = 0;  ///< through panes at most
  double mirrored = 0;  ///< over one plane mirror, if the rules look for these from end to end
  std::uint64_t rays = 0;

  DirectSignal& operator+=(const DirectSignal& other);
};

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
