#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam::test {

/// The minimum cost of feasible selections, by enumeration; infinite if there is none.
inline double min_cost(const SignalTable& table, const PlacementProblem& problem,
                       const std::vector<double>& cost) {
  double best = std::numeric_limits<double>::infinity();
  for (std::uint32_t set = 0; set < (std::uint32_t{1} << table.columns()); ++set) {
    Selection selected;
    double sum = 0;
    for (std::uint32_t j = 0; j < table.columns(); ++j)
      if ((set >> j & 1U) != 0 || table.transceivers[j].installed) selected.push_back(j), sum += cost[j];
    if (sum < best && check_selection(table, problem, selected).met()) best = sum;
  }
  return best;
}

}  // namespace shelfbeam::test
