#include "shelfbeam/milp/solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/milp/backend.hpp"

namespace shelfbeam::milp {

namespace {

double miss(double value, double lower, double upper) {
  double worst = 0;
  if (lower > -infinity) worst = std::max(worst, (lower - value) / std::max(1.0, std::abs(lower)));
  if (upper < infinity) worst = std::max(worst, (value - upper) / std::max(1.0, std::abs(upper)));
  return worst;
}

// Beyond the cut-off, solvers end with the status "optimal" and a solution that is none, or none at all.
Result within_cutoff(const Model& model, const SolveOptions& options, Result result) {
  if (!(options.cutoff < infinity)) return result;
  const double slack = objective_slack(model, options.cutoff);
  const bool is_beyond =
      !result.solution.empty() && !(objective(model, result.solution) <= options.cutoff + slack);
  if (is_beyond) result.solution.clear();
  const bool has_none = result.solution.empty() && !model.columns.empty();
  if (has_none && result.termination == Termination::optimal) result.termination = Termination::infeasible;
  if (has_none) result.dual_bound = std::min(result.dual_bound, options.cutoff);
  return result;
}

// Not every solver accepts a model without columns. The empty solution meets its rows, or none does.
Result solve_empty(const Model& model) {
  if (violation(model, {}) > feasibility_tolerance) return {Termination::infeasible, infinity, infinity, {}};
  return {Termination::optimal, 0, 0, {}};
}

template <Result (*solve)(const Model&, const SolveOptions&, const RunControl&)>
Result guarded(const Model& model, const SolveOptions& options, const RunControl& control) {
  if (control.cancelled()) return {Termination::interrupted, infinity, -infinity, {}};
  if (model.columns.empty()) return solve_empty(model);
  return verified(model, options, solve(model, options, control));
}

}  // namespace

double objective_slack(const Model& model, double objective_value) {
  if (!std::isfinite(objective_value)) return 0;
  double largest = 0;
  for (const Column& column : model.columns) largest = std::max(largest, std::abs(column.cost));
  return objective_tolerance * std::max(largest, std::abs(objective_value));
}

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
  result = within_cutoff(model, options, std::move(result));
  if (result.termination == Termination::infeasible) {
    if (!result.solution.empty()) return wrong;
    return {Termination::infeasible, infinity, infinity, {}, result.is_safe};
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

std::span<const Backend> backends() {
  static const std::array table = {
#ifdef SHELFBEAM_HAS_HIGHS
      Backend{"highs", highs_version(), guarded<solve_highs>, read_highs, lp_highs},
#endif
#ifdef SHELFBEAM_HAS_CBC
      Backend{"cbc", cbc_version(), guarded<solve_cbc>, read_cbc, lp_cbc},
#endif
  };
  return table;
}

std::string Backend::full_name() const {
  return fmt::format("{} {}", name, version);
}

std::span<const Backend> backends_of(std::string_view name) {
  const std::span<const Backend> all = backends();
  if (name.empty()) return all;
  std::vector<std::string_view> known;
  for (const Backend& backend : all) {
    if (backend.name == name) return {&backend, 1};
    known.push_back(backend.name);
  }
  throw InputError("MIP back end", fmt::format("'{}' is not built in", name), suggest(name, known));
}

void BoundReport::operator()(double primal, double dual) {
  const auto now = std::chrono::steady_clock::now();
  if (control_.progress == nullptr || now < next_) return;
  next_ = now + std::chrono::milliseconds(200);
  const bool found = std::isfinite(primal) && std::abs(primal) < 1e40;
  const bool bounded = std::isfinite(dual) && std::abs(dual) < 1e40;
  std::string text = found ? fmt::format("best {:.6g}", primal) : "no solution yet";
  if (bounded) text += fmt::format(", bound {:.6g}", dual);
  if (found && bounded && primal != 0) text += fmt::format(", gap {:.1f} %", 100 * (primal - dual) / primal);
  control_.report(Task::solving, -1, text);
}

double objective_scale(std::span<const Column> columns) {
  double largest = 0;
  bool whole = true;
  for (const Column& column : columns) {
    largest = std::max(largest, std::abs(column.cost));
    whole = whole && column.cost == std::round(column.cost);
  }
  if (largest == 0 || (whole && largest <= 1e6)) return 1;
  return std::ldexp(1.0, std::clamp(10 - (std::ilogb(largest) + 1), -1020, 1020));
}

}  // namespace shelfbeam::milp
