#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/model.hpp"
#include "shelfbeam/milp/solver.hpp"

namespace shelfbeam::milp {

/// The end of one solve; `x` and `y` are empty unless `termination` is optimal.
struct LpResult {
  Termination termination = Termination::error;
  double objective = infinity;  ///< of `x`
  std::vector<double> x;        ///< one a column
  /// The dual of every row in the order they were added: the change of the objective per unit of the row's
  /// bound, so not negative where only `lower` is finite and not positive where only `upper` is.
  std::vector<double> y;
};

/// A linear program that stays loaded: what the solver knows of one solve (its basis) is where the next one
/// starts, so that adding rows costs a few pivots of the dual simplex method. It begins
/// without rows; `Column::integer` and names are ignored.
///
/// Silent, on one thread. Costs of any magnitude are fine (all are scaled by what the first ones need); rows
/// should have coefficients of order 1. Nothing here has been verified: tolerances are the solver's, and a
/// bound that must hold is to be recomputed from `y` by who needs it.
class LpSession {
 public:
  virtual ~LpSession() = default;

  virtual void add_rows(std::span<const Row> rows) = 0;

  /// Ends early at the limit or when cancelled; the next solve goes on from there.
  virtual LpResult solve(double time_limit_s, const RunControl& control) = 0;
};

}  // namespace shelfbeam::milp
