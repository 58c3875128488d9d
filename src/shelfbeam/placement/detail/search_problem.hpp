#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/instance.hpp"

namespace shelfbeam::detail {

/// A question as searches over selections see it: costs as whole numbers, so that sums do not depend on their
/// order and equal costs are equal, and which columns exclude one another.
struct SearchProblem {
  SearchProblem(const SignalTable& table, const Question& question);

  const SignalTable& table;
  const Question& question;
  /// The second objective (lexicographic; zeros for count) or the whole sum (weighted) of a column, in units
  /// of `cost_unit`, a power of two that is 2^-40 to 2^-39 of the largest: whole numbers up to 2^39 times
  /// smaller than the largest are exact.
  std::vector<std::int64_t> cost;
  double cost_unit = 1;
  bool has_costs = false;                            ///< any is not zero
  std::vector<std::vector<std::uint32_t>> excludes;  ///< by column
  std::vector<std::uint32_t> installed;
  std::vector<bool> available;  ///< neither installed nor excluded by what is

  std::int64_t cost_of(std::span<const std::uint32_t> selected) const {
    std::int64_t sum = 0;
    for (const std::uint32_t j : selected) sum += cost[j];
    return sum;
  }
};

}  // namespace shelfbeam::detail
