#include "shelfbeam/milp/verify.hpp"

#include <algorithm>
#include <cmath>

namespace shelfbeam::milp {

namespace {

double miss(double value, double lower, double upper) {
  double worst = 0;
  if (lower > -infinity) worst = std::max(worst, (lower - value) / std::max(1.0, std::abs(lower)));
  if (upper < infinity) worst = std::max(worst, (value - upper) / std::max(1.0, std::abs(upper)));
  return worst;
}

// What sums of this model's costs can be trusted to, beside the relative gap.
double objective_slack(const Model& model, double objective_value) {
  double largest = 0;
  for (const Column& column : model.columns) largest = std::max(largest, std::abs(column.cost));
  return feasibility_tolerance * std::max(largest, std::abs(objective_value));
}

}  // namespace

double violation(const Model& model, std::span<const double> x) {
  if (x.size() != model.columns.size()) return infinity;
  double worst = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const Column& column = model.columns[j];
    if (!std::isfinite(x[j])) return infinity;
    worst = std::max(worst, miss(x[j], column.lower, column.upper));
    if (column.integer) worst = std::max(worst, std::abs(x[j] - std::round(x[j])));
  }
  for (const Row& row : model.rows) {
    double sum = 0;
    for (const Entry& entry : row.entries) sum += entry.value * x[entry.column];
    worst = std::max(worst, miss(sum, row.lower, row.upper));
  }
  return worst;
}

double objective(const Model& model, std::span<const double> x) {
  double sum = 0;
  for (std::size_t j = 0; j < x.size(); ++j) sum += model.columns[j].cost * x[j];
  return sum;
}

Result verified(const Model& model, const SolveOptions& options, Result result) {
  Result wrong;
  if (result.termination == Termination::error) return wrong;
  if (result.termination == Termination::infeasible) {
    if (!result.solution.empty()) return wrong;
    return {Termination::infeasible, infinity, infinity, {}};
  }
  if (std::isnan(result.dual_bound)) result.dual_bound = -infinity;

  const bool found = !result.solution.empty() || model.columns.empty();
  if (!found) {
    result.primal_bound = infinity;
    return result.termination == Termination::optimal ? wrong : result;
  }
  for (std::size_t j = 0; j < std::min(result.solution.size(), model.columns.size()); ++j) {
    double& value = result.solution[j];
    if (model.columns[j].integer && std::abs(value - std::round(value)) <= feasibility_tolerance)
      value = std::round(value);
  }
  if (violation(model, result.solution) > feasibility_tolerance) return wrong;
  result.primal_bound = objective(model, result.solution);

  const double slack = objective_slack(model, result.primal_bound);
  if (result.dual_bound > result.primal_bound + slack) return wrong;
  result.dual_bound = std::min(result.dual_bound, result.primal_bound);
  const double allowed = options.relative_gap * std::abs(result.primal_bound) + slack;
  if (result.termination == Termination::optimal && result.primal_bound - result.dual_bound > allowed)
    return wrong;
  return result;
}

}  // namespace shelfbeam::milp
