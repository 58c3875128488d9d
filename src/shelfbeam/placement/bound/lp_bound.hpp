#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/bound/dual_bound.hpp"

namespace shelfbeam::detail {

struct LpBoundOptions {
  double time_limit_s = 60;
  double enough = std::numeric_limits<double>::infinity();  ///< a bound of this much ends it
  /// Inequalities beyond the labels' rows, where units cooperate: knapsack covers, and those with a share
  /// where the number of units is limited.
  bool cuts = true;
  AnswerSet answers = {};           ///< bounds these
  std::vector<BoundRow> rows = {};  ///< to begin with, no label's own row twice; empty: as below
};

/// The bound of the LP relaxation, and what it was found with.
struct LpBound {
  DualBound dual;                     ///< of `rows` and `y`: all that may be relied on
  std::vector<BoundRow> rows;         ///< those with a positive multiplier
  std::vector<double> y;              ///< one a row
  std::vector<double> x;              ///< solution of the last LP, one a column; empty where none was solved
  std::vector<std::uint32_t> labels;  ///< whose rows the LP holds, in the order they were added
  /// No label is violated by `x` by more than 1e-6, and no inequality left out because of the time.
  bool complete = false;
  std::size_t rounds = 0;  ///< LPs that were solved
};

/// The rows of all its labels, and its other inequalities with multipliers: what a linear program like it
/// begins with.
std::vector<BoundRow> rows_of(const LpBound& bound);

/// Bounds min c T over the answers by its LP relaxation, rows generated: begins with the label that is worst
/// off at every strongest unit, solves, adds the most violated labels, of those with the same strongest unit
/// only one a round, and ends when no row is violated, with the time or when cancelled. Every round has a
/// bound; the best is returned, at least that of y = 0. `cost` may be of any sign.
///
/// Every round scans the table once on `control.threads` threads; the result does not depend on their number.
LpBound lp_bound(const SignalTable& table, const Question& question, std::span<const double> cost,
                 const milp::Backend& backend, const LpBoundOptions& options, const RunControl& control);

}  // namespace shelfbeam::detail
