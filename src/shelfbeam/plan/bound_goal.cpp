#include "shelfbeam/plan/bound_goal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/placement/problem/spend.hpp"

namespace shelfbeam {

namespace {

// Differences of costs below this share are rounding.
constexpr double relative_rounding = 1e-9;
// Token prices add up to this share of the step.
constexpr double share_of_tokens = 0.25;

}  // namespace

BoundGoal bound_goal(const SignalTable& table, const Placement& placement) {
  BoundGoal goal;
  goal.problem.model = placement.problem.model;
  goal.problem.redundant = placement.problem.redundant;
  goal.price.assign(table.columns(), 1.0);
  if (has_known_prices(placement.problem)) {
    goal.problem.combination = Combination::weighted;
    goal.price = first_objective(table, placement.problem, objective_coefficients(table, placement.problem));
    goal.is_count =
        std::all_of(goal.price.begin(), goal.price.end(), [](double price) { return price == 1; });
    goal.step = price_step(goal.price);
  }
  // Where the weighted sum depends on signals, no bound says something about it.
  if (placement.problem.combination == Combination::lexicographic || has_known_prices(placement.problem))
    goal.value = goal.bound_of(placement);
  return goal;
}

double trivial_bound(const BoundGoal& goal, const SignalTable& table) {
  double installed = 0, cheapest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < goal.price.size(); ++j) {
    if (table.transceivers[j].installed) installed += goal.price[j];
    cheapest = std::min(cheapest, goal.price[j]);
  }
  return table.rows() == 0 || goal.price.empty() ? installed : std::max(installed, cheapest);
}

SelectionBudget BoundGoal::below(double bound) const {
  if (is_count) return {price, std::max(0.0, bound - 1)};
  const double gap = step > 0 ? step : relative_rounding * bound;
  const double tokens = share_of_tokens * gap;
  // Sums of prices are rounded. No cost is between the budget and the bound.
  constexpr double share_of_rounding = 1e-3;
  SelectionBudget budget{price, std::max(0.0, bound - gap * (1 - share_of_rounding))};
  if (std::all_of(price.begin(), price.end(), [](double one) { return one > 0; })) return budget;
  for (double& one : budget.price)
    if (!(one > 0)) one = tokens / static_cast<double>(price.size());
  budget.budget += tokens;
  return budget;
}

std::size_t BoundGoal::max_units_below(double bound) const {
  std::vector<double> ascending = price;
  std::sort(ascending.begin(), ascending.end());
  const double budget = below(bound).budget;
  double cost = 0;
  std::size_t units = 0;
  while (units < ascending.size() && (cost += ascending[units]) <= budget * (1 + relative_rounding)) ++units;
  return units;
}

double BoundGoal::rounded(double bound) const {
  if (!(bound > 0)) return 0;
  return step > 0 ? step * std::ceil(bound / step * (1 - relative_rounding)) : bound;
}

double BoundGoal::bound_of(const Placement& placement) const {
  return rounded(problem.combination == Combination::weighted ? placement.lower_bound
                                                              : placement.count_lower_bound);
}

SignalTable BoundGoal::priced(SignalTable rows) const {
  for (std::size_t j = 0; j < price.size(); ++j) rows.transceivers[j].cost = price[j];
  return rows;
}

std::vector<double> BoundGoal::targets(double certified) const {
  std::vector<double> targets;
  if (is_count) {
    for (auto count = std::llround(value); static_cast<double>(count) > certified; --count)
      targets.push_back(static_cast<double>(count));
    return targets;
  }
  for (const double share : {1.0, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5})
    if (const double target = rounded(share * value);
        target > certified && (targets.empty() || target < targets.back()))
      targets.push_back(target);
  return targets;
}

std::string BoundGoal::text(double bound) const {
  return is_count ? fmt::format("{:.0f} {} needed", bound, bound == 1 ? "is" : "are")
                  : fmt::format("a cost of {:.6g} is needed", bound);
}

}  // namespace shelfbeam
