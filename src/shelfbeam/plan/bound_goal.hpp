#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/refutation.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// The bound that a certificate proves: every selection that reaches all labels costs at least this much. The
/// cost of a selection is the sum of its prices: its count where every price is 1, and the weighted sum where
/// that does not depend on signals (has_known_prices).
struct BoundGoal {
  PlacementProblem problem;   ///< the rules of the placement, and the sum of prices as the objective
  std::vector<double> price;  ///< by column
  bool is_count = true;       ///< every price is 1
  double step = 1;            ///< every price is a multiple of it; 0: there is none
  double value = 0;           ///< the bound that holds on the matrix; 0: nothing to prove

  /// The selections that cost less than `bound`. Free units get a token price, which excludes none of them.
  SelectionBudget below(double bound) const;
  /// The maximum number of units of these selections.
  std::size_t max_units_below(double bound) const;
  /// A lower bound on the cost, rounded up to a possible cost.
  double rounded(double bound) const;
  /// The bound that a placement on some rows proves.
  double bound_of(const Placement& placement) const;
  /// Rows with these prices as costs.
  SignalTable priced(SignalTable rows) const;
  /// The values to prove in turn, the largest first, above a bound that is already certified.
  std::vector<double> targets(double certified) const;
  /// "8 are needed", "a cost of 1800 is needed"
  std::string text(double bound) const;
};

/// The goal of a placement with a selection: the bound that it proves on its table.
BoundGoal bound_goal(const SignalTable& table, const Placement& placement);

/// The cost of the installed units, or of the cheapest unit if there are labels: needs no samples.
double trivial_bound(const BoundGoal& goal, const SignalTable& table);

}  // namespace shelfbeam
