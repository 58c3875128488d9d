#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/cover_rows.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// A valid inequality from one label's row sum_j a_ij T_j >= b (cover_rows.hpp): the row itself or one of
/// two cuts, which exclude one another.
///
/// Share cut, empty unless d > 0, with s > 0, for selections of at most K units (SelectionSet::max_count):
/// parts below s contribute at most s K, so the label requires d = b - s K from the parts above s:
///
///   sum_j min(1, max(0, a_ij - s) / d) T_j >= 1.
///
/// Near s = 1 / K this is the pigeonhole principle: one unit contributes at least that.
///
/// Case, with t > 0, for selections in which some unit contributes at least t to the label:
///
///   sum_{j: a_ij >= t} T_j >= 1.
struct BoundRow {
  LabelId label;
  double share = 0;      ///< s
  double strongest = 0;  ///< t

  /// The label's own row.
  bool is_plain() const { return share == 0 && strongest == 0; }

  bool operator==(const BoundRow&) const = default;
};

/// The selections for which a bound holds.
struct SelectionSet {
  std::size_t min_count = 0;  ///< minimum count, installed units included
  std::size_t max_count = std::numeric_limits<std::size_t>::max();
  std::vector<ColumnId> without = {};  ///< columns that are not chosen; no installed ones
  std::vector<ColumnId> with = {};     ///< columns that are chosen besides the installed ones
};

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

/// Expands the inequalities of one table, slightly relaxed, by more than rounding errors.
class BoundRowReader {
 public:
  BoundRowReader(const Instance& instance, std::size_t max_units)
      : cover_(instance, max_units), max_units_(static_cast<double>(max_units)) {}

  /// Calls visit(column, coefficient), ascending, and returns the right-hand side; 0 if the inequality is
  /// empty.
  template <class Visit>
  double read(const BoundRow& row, Visit visit) const {
    if (row.strongest > 0) return read_strongest(row, visit);
    if (row.share > 0) return read_above_share(row, visit);
    cover_.for_entries(row.label, visit);
    return cover_.bound(row.label);
  }

 private:
  static constexpr double rounding = 1e-10;  // of sums of up to a million numbers of at most 1
  static constexpr double min_lack = 1e-3;

  template <class Visit>
  double read_strongest(const BoundRow& row, Visit visit) const {
    cover_.for_entries(row.label, [&](std::uint32_t j, double a) {
      if (a >= row.strongest) visit(j, 1.0);
    });
    return 1;
  }

  template <class Visit>
  double read_above_share(const BoundRow& row, Visit visit) const {
    const double lacking = cover_.bound(row.label) - row.share * max_units_ - rounding;
    if (!(lacking >= min_lack)) return 0;
    cover_.for_entries(row.label, [&](std::uint32_t j, double a) {
      // The difference loses digits; 1e-12 exceeds that error after the division.
      if (a > row.share) visit(j, std::min(1.0, (a - row.share) / lacking + 1e-12));
    });
    return 1;
  }

  CoverRows cover_;
  double max_units_;
};

}  // namespace shelfbeam::detail
