#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/bound/dual_bound.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

struct WindowMipOptions {
  double goal = 0;     ///< a bound of this size ends the search, and no larger one is proven
  Effort effort = {};  ///< its steps: nodes of every MIP
  std::size_t windows = 4;
  std::vector<ColumnId> without = {};  ///< the bound holds for selections without these columns
  std::vector<BoundRow> rows = {};     ///< the first rows of the LP, without cuts
};

/// A lower bound on c T by the decomposition of `window_bound`, for sums of signals or covers without unit
/// failure, c >= 0. Window W_k is a part of the rows of the LP, with multipliers y. It pays for column j the
/// share that its rows have in the column's multipliers,
///
///   w_kj = c_j sum_{i in W_k} y_i a_ij / sum_i y_i a_ij,      v_k = min {w_k T: T reaches N_k},
///
/// and a selection must reach the labels N_k near W_k, those with sum_j a_ij^2 w_kj / c_j of at least a part
/// of sum_j a_ij^2. The LP bound is the sum of the windows' LP bounds, and integrality raises each of them.
///
/// Each v_k is a MIP, asked only whether it exceeds a target, which needs much smaller trees than its value.
/// Rows that a window's solution violates are added, and it is asked again. At first the targets are in
/// proportion to the LP bounds and add up to the goal; a target that is met is raised in place of the others.
///
/// Windows are asked in parallel, each on one thread. The result does not depend on the number of threads
/// unless the time is up first. The bound is lowered by the tolerance of solvers (milp::objective_slack).
double window_mip_bound(const Instance& instance, std::span<const double> cost,
                        const WindowMipOptions& options, const milp::Backend& backend,
                        const RunControl& control);

}  // namespace shelfbeam::detail
