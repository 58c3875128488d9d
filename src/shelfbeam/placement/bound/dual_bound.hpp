#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/cover_rows.hpp"

namespace shelfbeam::detail {

/// An inequality that answers meet, made of one label's row sum_j a_ij T_j >= b (cover_rows.hpp): the row, or
/// one of three others, which exclude one another. The first two say nothing where d is not positive.
///
/// With A, a knapsack cover inequality (Carr, Fleischer, Leung and Phillips, SODA 2000). With all of A chosen
/// the label still lacks d = b - sum_{j in A} a_ij, without A no less, so
///
///   sum_{j not in A} min(1, a_ij / d) T_j >= 1.
///
/// With a share s > 0, for answers of at most K units (AnswerSet::most). These give s K at most beyond the
/// parts of each above s, so the label needs d = b - s K of those, and
///
///   sum_j min(1, max(0, a_ij - s) / d) T_j >= 1.
///
/// Near s = 1 / K this is the pigeonhole principle: one unit gives at least that.
///
/// With t > 0, for answers in which some unit gives the label t at least: sum_{a_ij >= t} T_j >= 1.
struct BoundRow {
  std::uint32_t label = 0;
  std::vector<std::uint32_t> taken = {};  ///< A, ascending
  double share = 0;                       ///< s
  double strongest = 0;                   ///< t

  /// The label's own row.
  bool is_plain() const { return taken.empty() && share == 0 && strongest == 0; }

  bool operator==(const BoundRow&) const = default;
};

/// Which answers a bound is for.
struct AnswerSet {
  std::size_t least = 0;  ///< units, installed ones included
  std::size_t most = std::numeric_limits<std::size_t>::max();
  std::vector<std::uint32_t> without = {};  ///< columns that none of them has, no installed one
};

/// What multipliers prove about the cost of answers; every number is safe against rounding.
struct DualBound {
  double bound = 0;                  ///< no answer costs less
  std::vector<double> if_chosen;     ///< per column: no answer with it costs less; infinite: there is none
  std::vector<double> reduced_cost;  ///< per column: c_j - sum_i y_i a_ij
};

/// The Lagrangian bound of multipliers y >= 0 of `rows` for costs c of any sign, from the table alone: no
/// solver is asked or believed. It holds for `answers`.
///
/// For every answer T, c T >= c T + sum_i y_i (b_i - a_i T) = sum_i y_i b_i + sum_j r_j T_j with the reduced
/// costs r_j = c_j - sum_i y_i a_ij. The right-hand side is least over all T with the installed units in, at
/// most one unit a mounting point and what `answers` allows, where of every other point the option
/// of least r_j competes: the points of least r_j are taken, at least so many, and further ones as long as
/// they are negative, at most so many. `if_chosen` is the same minimum with one T_j = 1.
/// This holds for every y; multipliers that are negative or not finite count as 0. Errors of rounding are
/// bounded by (rows + columns + 8) 2^-52 times the sum of what was added up.
DualBound dual_bound(const SignalTable& table, const Question& question, std::span<const BoundRow> rows,
                     std::span<const double> y, std::span<const double> cost, const AnswerSet& answers = {});

/// Reduced-cost fixing: the columns, ascending, that no answer has which costs at most `worth`, as their
/// `if_chosen` exceeds it. To look for something better than a known cost, `worth` is that cost less 1 where
/// all costs are whole numbers, or else less what would count as better.
std::vector<std::uint32_t> useless_columns(const DualBound& dual, double worth);

/// Writes out the inequalities of one table. All are a little weaker than the formulas say, by more than what
/// rounding can do.
class BoundRowReader {
 public:
  BoundRowReader(const SignalTable& table, const Question& question, std::size_t most_units)
      : cover_(table, question, most_units),
        most_units_(static_cast<double>(most_units)),
        taken_(table.columns(), false) {}

  /// Calls visit(column, coefficient), ascending, and returns the right-hand side; 0 where the inequality
  /// says nothing.
  template <class Visit>
  double read(const BoundRow& row, Visit visit) {
    if (row.strongest > 0) return read_strongest(row, visit);
    if (row.share > 0) return read_above_share(row, visit);
    if (!row.taken.empty()) return read_without_taken(row, visit);
    cover_.for_entries(row.label, visit);
    return cover_.bound();
  }

 private:
  static constexpr double rounding = 1e-10;  // of sums of up to a million numbers up to 1
  static constexpr double least_lack = 1e-3;

  template <class Visit>
  double read_strongest(const BoundRow& row, Visit visit) const {
    cover_.for_entries(row.label, [&](std::uint32_t j, double a) {
      if (a >= row.strongest) visit(j, 1.0);
    });
    return 1;
  }

  template <class Visit>
  double read_above_share(const BoundRow& row, Visit visit) const {
    const double lacking = cover_.bound() - row.share * most_units_ - rounding;
    if (!(lacking >= least_lack)) return 0;
    cover_.for_entries(row.label, [&](std::uint32_t j, double a) {
      // The difference may have lost digits; 1e-12 is more than they are worth after the division.
      if (a > row.share) visit(j, std::min(1.0, (a - row.share) / lacking + 1e-12));
    });
    return 1;
  }

  template <class Visit>
  double read_without_taken(const BoundRow& row, Visit visit) {
    for (const std::uint32_t j : row.taken) taken_[j] = true;
    double lacking = cover_.bound() - rounding;
    cover_.for_entries(row.label, [&](std::uint32_t j, double a) { lacking -= taken_[j] ? a : 0; });
    const bool says_something = lacking >= least_lack;
    if (says_something)
      cover_.for_entries(row.label, [&](std::uint32_t j, double a) {
        if (!taken_[j]) visit(j, std::min(1.0, a / lacking));
      });
    for (const std::uint32_t j : row.taken) taken_[j] = false;
    return says_something ? 1 : 0;
  }

  CoverRows cover_;
  double most_units_;
  std::vector<bool> taken_;  ///< all false between calls
};

}  // namespace shelfbeam::detail
