#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "shelfbeam/placement/bound/dual_bound.hpp"
#include "shelfbeam/placement/problem/cover_rows.hpp"

namespace shelfbeam::detail {

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
