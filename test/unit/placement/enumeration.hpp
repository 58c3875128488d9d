#pragma once

#include <cstdint>

#include "shelfbeam/placement/answer/placement.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam::test {

constexpr RandomTableLimits beyond_the_paper{
    .labels = 6, .transceivers = 12, .mounts = true, .conflicts = true, .redundant = true};

/// Counts of results by kind.
struct Tally {
  int infeasible = 0;
  int by_exclusion = 0;  ///< infeasible although every label alone can be reached
  int stopped = 0, optimal = 0, settled = 0;
  int more_than_one = 0;  ///< problems with several optimal selections
  int by[6] = {};         ///< results by proof of the bound, by BoundProof

  int count(BoundProof proof) const { return by[static_cast<int>(proof)]; }
};

/// Compares a placement with enumeration: its value, its bounds, and the choice among optimal selections.
void compare(const SignalTable& table, const PlacementProblem& problem, const Placement& answer,
             Tally& tally);

/// Compares `place` on random problems and tables, sometimes on several threads. The limit is one of work, so
/// that a busy machine stops nothing.
inline constexpr std::uint64_t ample_steps = 1 << 20;

Tally compare_random(std::uint64_t seed, int cases, const RandomTableLimits& limits,
                     const PlaceOptions& options = {.step_limit = ample_steps});

}  // namespace shelfbeam::test
