#pragma once

#include <cstddef>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/certified_plan.hpp"

namespace shelfbeam {

/// The proven lower bound on the count, rounded up; 0 for infeasible problems.
std::size_t proven_count(const Placement& placement);

/// The minimised cost equals its proven lower bound.
bool cost_is_proven(const Placement& placement);

/// The value of a selection, its count or the minimised cost, with its lower bounds; 0: none.
struct ValueBounds {
  double value = 0;
  double simulated = 0;  ///< proven for the simulated signals
  double certified = 0;  ///< proven by independent samples, with the confidence of the certificate

  /// A bound excludes any lower value.
  bool is_minimum(double bound) const;
};
ValueBounds value_bounds(const CertifiedPlan& plan);

}  // namespace shelfbeam
