#pragma once

#include "bare_rays.hpp"
#include "entrants.hpp"

namespace shelfbeam::bench {

/// Rays in a batch of path reuse.
struct RayKinds {
  double single = 0, shadow = 0, visibility = 0;
  double shadow_packet = 0;  ///< mean number of shadow rays at a vertex

  /// What the ray library alone would take for them, in s.
  double bare_seconds(const BareRays& rates) const {
    return single / rates.single.per_second() + shadow / rates.shadow.per_second() +
           (visibility > 0 ? visibility / rates.visibility.per_second() : 0);
  }
};

/// Found from batches in which one kind after the other is switched off.
RayKinds ray_kinds(const World& world, const Selection& selection);

}  // namespace shelfbeam::bench
