#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/kernels/effort.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/kernels/search_problem.hpp"

namespace shelfbeam::detail {

/// A better selection than `start`: one of fewer units (lexicographic) or of less cost (weighted), or any
/// that meets every label where `start` does not, by exchanges with weights on rows that stay unmet (as in
/// weighting searches for set covering, Gao et al. 2015), on the rows that have been unmet so far. Whatever
/// is returned has passed the contract's rule on all rows. Walks begin with `seed` and those that follow.
/// Nothing where none was found.
std::optional<std::vector<std::uint32_t>> local_search(const SearchProblem& problem, const SearchMatrix& all,
                                                       const std::vector<std::uint32_t>& start,
                                                       const Effort& effort, std::uint32_t seed,
                                                       const RunControl& control);

}  // namespace shelfbeam::detail
