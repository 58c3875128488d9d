#pragma once

#include <span>

#include "shelfbeam/milp/model.hpp"
#include "shelfbeam/milp/solver.hpp"

namespace shelfbeam::milp {

/// What a solver may be off in a bound, a row or integrality before its answer is called wrong.
inline constexpr double feasibility_tolerance = 1e-6;

/// The largest amount by which `x` misses a column bound, a whole number or a row, each relative to
/// max(1, |bound|); infinity when `x` has the wrong length or is not finite.
double violation(const Model& model, std::span<const double> x);

double objective(const Model& model, std::span<const double> x);

/// A solver's result after a check in double precision that knows no solver: integer values are rounded, the
/// objective is recomputed, and an answer that violates the model by more than `feasibility_tolerance`, or
/// claims an optimum that its own bound does not support, becomes Termination::error.
Result verified(const Model& model, const SolveOptions& options, Result result);

}  // namespace shelfbeam::milp
