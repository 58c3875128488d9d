#pragma once

#include <cstddef>

#include "shelfbeam/transport/tally/tally.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// One random walk from label i (2.7, started at the sensor, with the errata), for the strategies walk, nee
/// and mis: the first direction by the label's responsivity, the others by the materials; connections to one
/// source chosen uniformly among n, so p_e = 1/n; Russian roulette on the throughput (2.18).
///
/// Adds its contributions to `tally` (n wide).
void walk_from_label(const World& world, std::size_t i, const PathKey& key, const PathRules& rules,
                     Tally& tally);

}  // namespace shelfbeam
