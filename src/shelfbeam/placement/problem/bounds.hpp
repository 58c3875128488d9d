#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// How the values of a goal differ. Lower ones are better.
class ValueSteps {
 public:
  /// Values are multiples of `step`; 0 if there is no common step. Values that differ by at most `error`, as
  /// sums of many terms do, are equal.
  explicit ValueSteps(double step, double error = 0) : step_(step), error_(error) {}

  double step() const { return step_; }

  /// A dual bound, rounded up to a multiple of the step (less 1e-7, for rounding) if there is one.
  double rounded(double bound) const;

  /// Values that differ by no more than this are equal: 1e-9 of the value, because sums in another order
  /// round differently, and less than a step.
  double tolerance(double value) const;

  /// MIP solvers prove optima within this: 1e-6 of the value, or nothing if the step is larger, because
  /// bounds are rounded up to steps.
  double solver_tolerance(double value) const;

  /// Whether `below` is a step, and not a rounding error, below a value.
  bool sees_steps(double value) const;

  /// The max value that is better than a known one: a step less, or more than rounding errors less, with a
  /// margin for rounding.
  double below(double known) const;

 private:
  double step_, error_;
};

/// Bounds that follow from the costs of single units (not negative). Installed units are always paid for.
/// The step is the largest number of which all costs are multiples (price_step).
class CostBounds : public ValueSteps {
 public:
  CostBounds(const SignalTable& table, std::span<const double> cost);

  /// Number of installed units.
  std::size_t installed() const { return installed_; }

  /// Minimum cost of at least `count` units: the installed units and the cheapest others.
  double cheapest(std::size_t count) const;

  /// Minimum count of a selection that costs at least `cost`: the installed units and the most expensive
  /// others.
  std::size_t fewest(double cost) const;

  /// Maximum count of a selection that costs at most `cost` (1 + 1e-9): the installed units and the cheapest
  /// others.
  std::size_t affordable(double cost) const;

 private:
  double installed_cost_ = 0;
  std::size_t installed_ = 0;
  std::vector<double> ascending_;  ///< costs of the units that are not installed
};

}  // namespace shelfbeam
