#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/effort.hpp"

namespace shelfbeam::detail {

// Work of the methods of max coverage, in matrix entries examined, so that results do not depend on the
// machine. The bound takes about ten seconds on one core.
inline constexpr std::uint64_t coverage_bound_work = 12'000'000'000;
inline constexpr std::uint64_t enumeration_work = 50'000'000'000;

/// The part of `work` that an effort allows: a step looks at all entries once.
inline std::uint64_t allowed_work(std::uint64_t work, const Effort& effort, const SignalTable& table) {
  const std::uint64_t step = table.entries.size() + 1;
  return effort.steps > work / step ? work : effort.steps * step;
}

/// The effort of CoverageBound; a step examines its entries twice.
inline Effort bound_effort(std::size_t entries, const Effort& effort, const SignalTable& table) {
  return {1 + allowed_work(coverage_bound_work, effort, table) / (2 * entries + 1), effort.until};
}

/// The effort of `enumerate_coverage`; a step is one matrix entry.
inline Effort enumeration_effort(const Effort& effort, const SignalTable& table) {
  return {allowed_work(enumeration_work, effort, table), effort.until};
}

/// Moves of an annealing before the bounds.
inline std::uint64_t brief_annealing(const SignalTable& table) {
  constexpr std::uint64_t moves_per_candidate = 200;
  return moves_per_candidate * table.columns();
}

/// The problem of all goals that may leave labels missed: objective and prices play no part.
inline PlacementProblem counting(const PlacementProblem& problem) {
  return {.model = problem.model, .redundant = problem.redundant};
}

}  // namespace shelfbeam::detail
