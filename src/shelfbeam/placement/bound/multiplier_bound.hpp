#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/bound/dual_bound.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// A proven bound with the rows that its multipliers use.
struct MultiplierBound {
  DualBound dual;
  std::vector<BoundRow> rows;  ///< rows with a positive multiplier
};

struct MultiplierBoundOptions {
  SelectionSet selections = {};  ///< the bound holds for these selections
  double known = 0;    ///< cost of a selection, which the steps aim at; any positive number is valid
  double step = 0;     ///< costs are multiples of this: a bound above known - step ends the search
  Effort effort = {};  ///< its steps: per set of rows
  /// The labels whose rows are used. Empty: the labels of smallest total sum_j a_ij per strongest unit, to
  /// which labels are added that the relaxation misses.
  std::vector<BoundRow> rows = {};
};

/// A lower bound on the cost of the selections by dual ascent and subgradient steps, without a solver; costs
/// must not be negative. The work is counted, so the result is the same for any number of threads unless
/// the time comes first.
MultiplierBound multiplier_bound(const Instance& instance, std::span<const double> cost,
                                 const MultiplierBoundOptions& options, const RunControl& control);

}  // namespace shelfbeam::detail
