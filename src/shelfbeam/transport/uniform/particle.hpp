#pragma once

#include <cstddef>

#include "shelfbeam/transport/tally/tally.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// One particle from source j: a share of its flux is followed from surface to surface, at each of which (and
/// at the source) it is connected to every label; labels of some size are also met by it after mirrors and
/// refraction. An implementation of the same integral as `walk_from_label` that shares with it the materials
/// and devices, but no estimator.
///
/// Adds its contributions to `tally` (m wide).
void follow_particle(const World& world, std::size_t j, const PathKey& key, const PathRules& rules,
                     Tally& tally);

}  // namespace shelfbeam
