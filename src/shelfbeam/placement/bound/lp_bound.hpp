#pragma once

#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/bound/dual_bound.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

struct LpBoundOptions {
  Effort effort = {};                                       ///< its time alone
  double enough = std::numeric_limits<double>::infinity();  ///< a bound of this size ends the search
  SelectionSet selections = {};                             ///< the bound holds for these selections
  std::vector<BoundRow> rows = {};  ///< initial rows, without duplicate label rows; empty: as below
};

/// The LP bound with its rows and multipliers.
struct LpBound {
  DualBound dual;               ///< of `rows` and `y`; the only proven result
  std::vector<BoundRow> rows;   ///< rows with a positive multiplier
  std::vector<double> y;        ///< multipliers, one per row
  std::vector<double> x;        ///< solution of the last LP, one per column; empty if none was solved
  std::vector<LabelId> labels;  ///< labels whose rows are in the LP, in order of addition
  /// `x` violates no label row by more than 1e-6, and the time limit omitted no cut.
  bool complete = false;
  bool failed = true;  ///< no LP was solved
};

/// The label rows of its LP and its cuts with multipliers, as initial rows of a similar LP.
std::vector<BoundRow> rows_of(const LpBound& bound);

/// The LP relaxation of min c T over the selections, by row generation. Starts with the label of smallest
/// total sum_j a_ij per strongest unit; each round solves the LP and adds the most violated labels, one per
/// strongest unit. Ends when no row is violated, at the time limit or when cancelled. Every round gives a
/// dual bound; the best is returned, at least that of y = 0. `cost` may have any sign.
///
/// Every round scans the table once on `control.threads` threads; the result does not depend on their number.
LpBound lp_bound(const Instance& instance, std::span<const double> cost, const milp::Backend& backend,
                 const LpBoundOptions& options, const RunControl& control);

}  // namespace shelfbeam::detail
