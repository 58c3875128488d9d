#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "shelfbeam/placement/problem/placement_problem.hpp"

namespace shelfbeam::detail {

/// Signals of the chosen units at one label as shares of its requirement, each at most 1 (non-cooperative: 1
/// or 0). For searches only; received_signal decides whether a label is reached.
struct LabelShares {
  double sum = 0;
  double largest = 0, second = 0;
  std::uint32_t strongest = 0;  ///< the column of `largest`

  void add(ColumnId column, double share) {
    sum += share;
    if (share > largest) {
      second = largest;
      largest = share;
      strongest = column;
    } else {
      second = std::max(second, share);
    }
  }

  double largest_without(ColumnId column) const { return column == strongest ? second : largest; }
};

/// The share of one entry.
inline double share_of(double signal, double requirement, const PlacementProblem& problem) {
  if (problem.model == CommunicationModel::cooperative) return std::min(1.0, signal / requirement);
  return is_met(signal, requirement) ? 1 : 0;
}

/// The part of its requirement that a label lacks, given the sum and the largest of its shares; 0 once it is
/// reached. With unit failure a sum of 2 always suffices, since shares are at most 1.
inline double lacking(double sum, double largest, const PlacementProblem& problem) {
  if (!problem.redundant) return is_met(sum, 1) ? 0 : 1 - sum;
  return is_met(sum - largest, 1) ? 0 : 2 - sum;
}

}  // namespace shelfbeam::detail
