#include "shelfbeam/plan/answer/value_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace shelfbeam {

namespace {

constexpr double rounding_of_costs = 1e-9;

}  // namespace

std::size_t proven_count(const Placement& placement) {
  if (!std::isfinite(placement.count_lower_bound)) return 0;
  return static_cast<std::size_t>(std::max(0.0, std::ceil(placement.count_lower_bound - 1e-6)));
}

bool cost_is_proven(const Placement& placement) {
  return minimises_cost(placement.problem) &&
         (placement.status == Status::optimal ||
          (placement.has_selection() &&
           placement.lower_bound >= placement.objective_value * (1 - rounding_of_costs)));
}

bool ValueBounds::is_minimum(double bound) const {
  return bound >= value * (1 - rounding_of_costs);
}

ValueBounds value_bounds(const CertifiedPlan& plan) {
  const Placement& placement = plan.placement;
  const bool is_verified = plan.has_verdicts();
  if (!minimises_cost(placement.problem))
    return {static_cast<double>(placement.count()), static_cast<double>(proven_count(placement)),
            is_verified ? static_cast<double>(plan.certificate->count_lower_bound) : 0};
  const bool is_covered = is_verified && has_known_prices(placement.problem);
  return {placement.objective_value,
          cost_is_proven(placement) ? placement.objective_value : placement.lower_bound,
          is_covered ? plan.certificate->cost_lower_bound : 0};
}

}  // namespace shelfbeam
