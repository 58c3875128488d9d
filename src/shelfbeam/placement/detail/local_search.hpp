#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/detail/search_matrix.hpp"
#include "shelfbeam/placement/detail/search_problem.hpp"

namespace shelfbeam::detail {

struct LocalSearchEffort {
  std::uint64_t moves = 20000;  ///< of each walk
  std::uint32_t walks = 2;      ///< with random numbers of their own, on all threads
  std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();
  std::uint32_t seed = 1;  ///< of the first walk, the next ones have those that follow
};

/// A better selection than `start`: one of fewer units (lexicographic) or of less cost (weighted), or any
/// that meets every label where `start` does not, by exchanges with weights on rows that stay unmet (as in
/// weighting searches for set covering, Gao et al. 2015), on the rows that have been unmet so far. Whatever
/// is returned has passed the contract's rule on all rows. Limited by moves, so that it is reproducible, but
/// where `until` comes first. Nothing where none was found.
std::optional<std::vector<std::uint32_t>> local_search(const SearchProblem& problem, const SearchMatrix& all,
                                                       const std::vector<std::uint32_t>& start,
                                                       const LocalSearchEffort& effort,
                                                       const RunControl& control);

}  // namespace shelfbeam::detail
