#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/placement/scenarios/scenario_table.hpp"

namespace shelfbeam {

/// Why every selection that keeps to an allowance satisfies a cut sum_j a_j x_j >= 1
/// (place_over_scenarios.hpp).
///
/// A rule allows k misses among the cases; at least t - k of the t cases are met. A case that is met has
/// sum_j c_j x_j >= 1 over the units other than `failed`, c_j = min(1, max(0, share of unit j - s) / (1 - s
/// K)) for selections of at most K units; so a_j may be the mean of the t - k largest c_j, or more.
///
/// Or the units with a_j = 0 miss more cases than a rule allows even all together; then a_j = 1 for the
/// others.
struct CutProof {
  struct Case {
    LabelId label;
    std::uint32_t scenario = 0;
    ColumnId failed =
        std::numeric_limits<std::uint32_t>::max();  ///< with unit failure; none: counts all units
  };

  std::vector<Case> cases;  ///< distinct
  bool is_cover = false;    ///< the second kind
  double above = 0;         ///< s
  double units = 0;         ///< K; only used if s > 0
};

/// Whether the proof shows from the signals and the allowance alone that the cut holds. `shares` are a_j, one
/// per column.
bool proves(const CutProof& proof, std::span<const double> shares, const ScenarioTable& scenarios,
            const PlacementProblem& problem, const MissAllowance& allowance);

}  // namespace shelfbeam
