#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

// Random questions about weights of labels, and comparisons of their results.
namespace shelfbeam::test {

inline constexpr RandomTableLimits unweighed_tables{
    .labels = 8, .transceivers = 10, .mounts = true, .conflicts = true, .redundant = true};
inline constexpr RandomTableLimits weighed_tables{
    .labels = 8, .transceivers = 10, .mounts = true, .conflicts = true, .redundant = true, .weights = true};

inline std::size_t installed(const SignalTable& table) {
  return static_cast<std::size_t>(std::count_if(table.transceivers.begin(), table.transceivers.end(),
                                                [](const auto& unit) { return unit.installed; }));
}

/// A valid number of units.
inline std::size_t some_units(RandomTables& tables, const SignalTable& table) {
  return static_cast<std::size_t>(
      tables.whole(static_cast<int>(installed(table)), static_cast<int>(table.columns())));
}

/// Sums of weights in another order.
inline bool are_equal(double a, double b) {
  return std::abs(a - b) <= 2e-9 * std::max(a, b);
}

inline double weight_of(const SignalTable& table, const PlacementProblem& problem,
                        const Selection& selected) {
  const Check check = check_selection(table, problem, selected);
  EXPECT_TRUE(check.allowed());
  double weight = 0;
  for (std::uint32_t i = 0; i < table.rows(); ++i)
    if (!std::binary_search(check.unmet.begin(), check.unmet.end(), i)) weight += table.labels[i].weight;
  return weight;
}

}  // namespace shelfbeam::test
