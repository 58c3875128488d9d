#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/cover_rows.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// The selections for which a bound holds.
struct SelectionSet {
  std::size_t min_count = 0;  ///< minimum count, installed units included
  std::size_t max_count = std::numeric_limits<std::size_t>::max();
  std::vector<ColumnId> without = {};  ///< columns that are not chosen; no installed ones
  std::vector<ColumnId> with = {};     ///< columns that are chosen besides the installed ones
};

/// What the selections of a SelectionSet do with a column.
enum class ColumnState : std::uint8_t {
  open,
  chosen,
  closed  ///< excluded, in conflict with an installed unit, or another option of a chosen unit's mounting
          ///< point
};

/// One per column.
std::vector<ColumnState> states_of(const Instance& instance, const SelectionSet& selections);

/// A lower bound from multipliers; all numbers are safe against rounding.
struct DualBound {
  double bound = 0;                  ///< no feasible selection costs less
  std::vector<double> if_chosen;     ///< per column: the same for selections with T_j = 1, infinite if none
  std::vector<double> reduced_cost;  ///< per column: c_j - sum_i y_i a_ij
};

/// Sums of rows times multipliers, from the table alone.
struct DualSums {
  double constant = 0;         ///< sum_i y_i b_i or, if labels may be missed, sum_i min(y_i b_i, price_i)
  std::vector<double> weight;  ///< per column: sum_i y_i a_ij
  std::size_t rows = 0;
  std::size_t max_count = 0;  ///< of the selections for which the rows hold
};

/// Of multipliers y >= 0 of `rows`, for selections of at most `max_count` units. Multipliers that are
/// negative or not finite count as 0. `price_of_miss`: per label, the price for which its rows need not be
/// met; empty if they must. (A variable z_i in {0, 1} fills the rows of label i at this price; the minimum
/// over z_i is in closed form. y_i b_i is then the sum over the rows of the label.)
DualSums dual_sums(const Instance& instance, std::span<const BoundRow> rows, std::span<const double> y,
                   std::size_t max_count, std::span<const double> price_of_miss = {});

/// The Lagrangian dual bound of multipliers y >= 0 of `rows`, for costs c of any sign, from the table alone
/// and independent of any solver. It holds for the selections of `selections`:
///
///   c T >= c T + sum_i y_i (b_i - a_i T) = sum_i y_i b_i + sum_j r_j T_j,   r_j = c_j - sum_i y_i a_ij.
///
/// The bound is the minimum of the right-hand side over all T with the chosen units, at most one option
/// per mounting point, and a count allowed by `selections`: the mounting points with the smallest r_j (of
/// their best option), at least the minimum count, and further negative ones up to the maximum. `if_chosen`
/// is the same minimum with T_j = 1. Columns in conflict with installed units are not chosen. Rounding errors
/// are bounded by (rows + columns + 8) 2^-52 times the sum of the absolute terms.
DualBound dual_bound(const Instance& instance, std::span<const BoundRow> rows, std::span<const double> y,
                     std::span<const double> cost, const SelectionSet& selections = {});

struct BoundsByCount {
  std::vector<double> at_most;  ///< by the number of units; infinite for fewer units than are installed
  double slack = 0;             ///< by which the bounds were lowered for rounding
};

/// Such bounds from the same rows for selections of at most 0, 1, ..., DualSums::max_count units, which must
/// be finite; for fewer units than that, `dual_bound` with their number has stronger rows. If labels may be
/// missed, their prices are part of the cost.
BoundsByCount bounds_by_count(const Instance& instance, const DualSums& sums, std::span<const double> cost);

/// Reduced-cost fixing: the columns, ascending, that no selection of cost at most `worth` contains, because
/// their `if_chosen` exceeds it. For a known selection of cost v, `worth` is
/// CostBounds::below(v).
std::vector<ColumnId> useless_columns(const DualBound& dual, double worth);

}  // namespace shelfbeam::detail
