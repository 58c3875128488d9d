#pragma once

#include <cstdint>

#include "shelfbeam/placement/answer/placement.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam::test {

constexpr RandomTableLimits beyond_the_paper{
    .labels = 6, .transceivers = 12, .mounts = true, .apart = true, .redundant = true};

/// How often answers were of a kind.
struct Tally {
  int infeasible = 0;
  int by_exclusion = 0;  ///< infeasible although every label alone could be met
  int stopped = 0, optimal = 0, settled = 0;
  int more_than_one = 0;  ///< best answers of which ties were settled
  int by[5] = {};         ///< proofs of bounds, by BoundProof

  int count(BoundProof proof) const { return by[static_cast<int>(proof)]; }
};

/// Expects of one answer what enumeration says: its value, its bounds, and which of several best ones it is.
void compare(const SignalTable& table, const Question& question, const Placement& answer, Tally& tally);

/// Compares what `place` answers to random questions about random tables, now and then on several threads.
/// Work, so that a busy machine stops nothing.
inline constexpr std::uint64_t ample_steps = 1 << 20;

Tally compare_random(std::uint64_t seed, int cases, const RandomTableLimits& limits,
                     const PlaceOptions& options = {.step_limit = ample_steps});

}  // namespace shelfbeam::test
