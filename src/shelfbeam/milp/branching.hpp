#pragma once

#include <span>
#include <vector>

#include "shelfbeam/milp/solver.hpp"

namespace shelfbeam::milp {

/// Solves a model of binary columns by branch and bound on linear programs, depth first: strong branching
/// (Applegate, Bixby, Chvatal and Cook, 1995) until the pseudo-costs of a column are reliable, and
/// reduced-cost fixing at every node. Suits models of a few hundred columns whose optimum is nearly known:
/// give it as the cut-off.
///
/// No bound rests on the tolerances of the LP solver: a node is closed only if its multipliers, summed again
/// in double precision, prove that it contains nothing up to the cut-off (`safe_bound`), or that it contains
/// nothing at all. Result::dual_bound is such a bound, too. SolveOptions::relative_gap plays no part.
///
/// Ends early, as at a limit, if its progress shows that the limits are several times too short.
///
/// Termination::error if some column is not binary or the LPs fail.
Result branch_and_bound(const Model& model, const Backend& backend, const SolveOptions& options,
                        const RunControl& control);

/// A lower bound on the objective of every x within the columns' bounds that satisfies the rows.
struct SafeBound {
  double value = 0;             ///< less `rounding`
  double rounding = 0;          ///< bound on the rounding errors of the sums
  std::vector<double> reduced;  ///< per column: c_j - sum_i y_i a_ij
};

/// The Lagrangian bound of the multipliers y, one per row. Infinite multipliers, and multipliers whose
/// side of the row is infinite, count as 0.
SafeBound safe_bound(const Model& model, std::span<const double> lower, std::span<const double> upper,
                     std::span<const double> y, bool with_costs = true);

}  // namespace shelfbeam::milp
