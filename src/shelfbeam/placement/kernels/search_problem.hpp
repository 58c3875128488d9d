#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// A question as searches over selections see it: costs as whole numbers, so that sums do not depend on their
/// order and equal costs are equal, and which columns exclude one another.
struct SearchProblem {
  SearchProblem(const SignalTable& table, const Question& question);

  const SignalTable& table;
  const Question& question;
  /// The second objective (lexicographic; zeros for count) or the whole sum (weighted) of a column, in units
  /// of `cost_unit`, a power of two of which all columns together cost 2^60 at most, whatever they are:
  /// whole numbers are exact unless they differ by some fifteen digits. Each is off by half a unit at most.
  std::vector<std::int64_t> cost;
  double cost_unit = 1;
  bool has_costs = false;                            ///< any is not zero
  std::vector<std::vector<std::uint32_t>> excludes;  ///< by column
  std::vector<std::uint32_t> installed;
  std::vector<bool> available;  ///< neither installed nor excluded by what is

  std::vector<std::uint32_t> place_by_id;  ///< of a column among all, in the order of their ids

  /// Of two selections of equal size, each ascending: whether the ids of the first, in order, come before
  /// those of the second, in order.
  bool is_first_by_id(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) const;

  std::int64_t cost_of(std::span<const std::uint32_t> selected) const {
    std::int64_t sum = 0;
    for (const std::uint32_t j : selected) sum += cost[j];
    return sum;
  }
};

}  // namespace shelfbeam::detail
