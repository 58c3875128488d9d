#include "shelfbeam/placement/problem/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "shelfbeam/math/steps.hpp"
#include "shelfbeam/placement/problem/spend.hpp"

namespace shelfbeam {

namespace {

constexpr double solver_gap = 1e-6;
constexpr double rounding = 1e-7;  // of a bound, before it is rounded up to a step

double step_of(std::span<const double> cost) {
  const bool are_whole = std::ranges::all_of(cost, [](double one) { return one == std::round(one); });
  return std::max(price_step(cost), are_whole ? 1.0 : 0.0);
}

}  // namespace

CostBounds::CostBounds(const SignalTable& table, std::span<const double> cost) : ValueSteps(step_of(cost)) {
  for (std::size_t j = 0; j < cost.size(); ++j) {
    if (table.transceivers[j].installed) {
      installed_cost_ += cost[j];
      ++installed_;
    } else {
      ascending_.push_back(cost[j]);
    }
  }
  std::sort(ascending_.begin(), ascending_.end());
}

double CostBounds::cheapest(std::size_t count) const {
  const std::size_t further = std::min(count > installed_ ? count - installed_ : 0, ascending_.size());
  return std::accumulate(ascending_.begin(), ascending_.begin() + static_cast<std::ptrdiff_t>(further),
                         installed_cost_);
}

std::size_t CostBounds::fewest(double cost) const {
  const double enough = cost * (1 - solver_gap);
  double spent = installed_cost_;
  std::size_t count = installed_;
  for (auto dearest = ascending_.rbegin(); dearest != ascending_.rend() && spent < enough; ++dearest) {
    spent += *dearest;
    ++count;
  }
  return count;
}

std::size_t CostBounds::affordable(double cost) const {
  const double max_cost = cost * (1 + 1e-9);
  double spent = installed_cost_;
  std::size_t count = installed_;
  for (const double one : ascending_) {
    spent += one;
    if (spent > max_cost) break;
    ++count;
  }
  return count;
}

double ValueSteps::rounded(double bound) const {
  const double slack = rounding * std::max(step_, std::abs(bound));
  if (!std::isfinite(bound) || !(slack < 0.5 * step_)) return bound;
  return std::ceil((bound - slack) / step_) * step_;
}

bool ValueSteps::sees_steps(double value) const {
  constexpr double exact = 1e13;  // sums of so many steps still differ by more than their rounding errors
  return step_ > 0 && value < exact * step_;
}

double ValueSteps::tolerance(double value) const {
  constexpr double equal_values = 1e-9;
  return std::max(error_,
                  sees_steps(value) ? std::min(equal_values * value, 0.5 * step_) : equal_values * value);
}

double ValueSteps::solver_tolerance(double value) const {
  constexpr double errors = 2000;  // of sums, because the value is a small part of them
  return step_ > solver_gap * value ? 0 : std::max(solver_gap * value, errors * error_);
}

double ValueSteps::below(double known) const {
  constexpr double within = 0.99;  // the difference is rounded
  return sees_steps(known) ? next_better(known, step_) : known - within * tolerance(known);
}

}  // namespace shelfbeam
