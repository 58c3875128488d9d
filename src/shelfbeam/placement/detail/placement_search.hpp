#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/placement.hpp"

namespace shelfbeam::detail {

/// Answers a question by local search, linear programming, tree search and, where these leave a gap, a MIP on
/// what reductions leave. `start` is a selection that the checker accepts. The answer lacks `seconds`.
/// `for_large_lp` solves the linear programs of large tables, if it is given.
///
/// Where the tree search ends by proof, ties are settled, too: of all placements with the best value that
/// with the largest smallest margin, of these that with the fewest units, of these the first by column. Then
/// the answer is the same for any number of threads.
Placement search_placement(const SignalTable& table, const Question& question,
                           const std::vector<std::uint32_t>& start, const milp::Backend& backend,
                           double time_limit_s, const RunControl& control,
                           const milp::Backend* for_large_lp = nullptr);

}  // namespace shelfbeam::detail
