#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/reduce/reductions.hpp"

namespace shelfbeam::detail {

struct WindowBoundOptions {
  double known = 0;    ///< cost of a selection, which the steps aim at; any positive number is valid
  double step = 0;     ///< costs are multiples of this (0: any): a bound above known - step ends the search
  Effort effort = {};  ///< its steps: nodes of trees
  std::size_t windows = 8;  ///< at first; more if their trees are large
};

struct WindowBound {
  /// Every selection of the remainder, forced columns included, that is better than the known ones costs at
  /// least this; above known - step if there is none.
  double bound = 0;
  std::vector<ColumnId> useless;  ///< the table's columns that no such selection contains, ascending
};

/// Receives selections of the remainder that reach all labels, forced columns included, ascending;
/// constraints between columns are ignored. Returns the cost of the best selection known.
using WindowHeuristic = std::function<double(const Selection&)>;

/// A lower bound on the remainder of a cover by Lagrangian decomposition into windows, that is, sets W_k of
/// neighbouring labels to which the cost of every column is allotted:
///
///   c T >= sum_k w_k T >= sum_k v_k,   v_k = min {w_k T: T reaches W_k},   w_k >= 0,   sum_k w_kj <= c_j.
///
/// A tree search finds every v_k (cheapest_cover). Subgradient steps move costs towards the windows that use
/// a column. If they gain nothing, neighbouring windows are merged, which never lowers the bound: w_k T + w_l
/// T of the same T replaces two minima. The bound exceeds that of the LP if windows are large enough to show
/// that fractions of units are useless; as a single window it would be exact.
///
/// If windows search no longer gains, columns are excluded: a selection of cost C has w_k T <= v_k + (C - sum
/// of all v) in every window, so a column that no such selection of the window contains is in none of cost C.
///
/// The work is counted, so that the result is the same for any number of threads unless the time is up first.
/// Without an LP from the back end, bounds hold but take longer.
WindowBound window_bound(const Instance& instance, std::span<const double> cost, const Reduction& reduction,
                         const WindowBoundOptions& options, const milp::Backend& backend,
                         const WindowHeuristic& heuristic, const RunControl& control);

}  // namespace shelfbeam::detail
