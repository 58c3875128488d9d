#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

/// No selection that meets every label has fewer units: the installed ones, and one more where they do not
/// meet everything; two where one may fail.
std::size_t least_count(const SignalTable& table, const Question& question);

/// Bounds that follow from non-negative costs of single units alone; every installed unit is always paid.
class CostBounds {
 public:
  CostBounds(const SignalTable& table, std::span<const double> cost);

  /// No selection of at least `count` units costs less: the installed ones and the cheapest others.
  double cheapest(std::size_t count) const;

  /// No selection that costs at least `cost` has fewer units: the installed ones and the dearest others.
  std::size_t fewest(double cost) const;

  /// No selection that costs at most `cost`, or 1e-9 of it more, has more units: the installed ones and the
  /// cheapest others.
  std::size_t affordable(double cost) const;

  /// A solver's bound, rounded up where every cost is a whole number (less 1e-6, the solvers' tolerance).
  double rounded(double bound) const;

 private:
  double installed_cost_ = 0;
  std::size_t installed_ = 0;
  std::vector<double> ascending_;  ///< costs of the units that are not installed
  bool whole_ = true;
};

}  // namespace shelfbeam
