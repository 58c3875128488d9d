#pragma once

#include "bare_rays.hpp"
#include "entrants.hpp"

namespace shelfbeam::bench {

/// Rays in a batch of path reuse, by kind.
struct RayKinds {
  double single = 0, shadow = 0, visibility = 0;
  double shadow_packet = 0;  ///< mean number of shadow rays per vertex

  /// The time of the ray library alone for these rays, in s.
  double bare_seconds(const BareRays& rates) const {
    return single / rates.single.per_second() + shadow / rates.shadow.per_second() +
           (visibility > 0 ? visibility / rates.visibility.per_second() : 0);
  }
};

/// Counts the kinds by batches in which one kind after the other is switched off.
RayKinds ray_kinds(const World& world, const Selection& selection);

}  // namespace shelfbeam::bench
