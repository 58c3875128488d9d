#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/problem/label_shares.hpp"

namespace shelfbeam::detail {

/// A valid inequality from one label's row sum_j a_ij T_j >= b (CoverRows): the row itself or one of two
/// cuts, which exclude one another.
///
/// Share cut, empty unless d > 0, with s > 0, for selections of at most K units: parts below s contribute at
/// most s K, so the label requires d = b - s K from the parts above s:
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

/// The rows of a placement problem for bounds: for every label i
///
///   sum_j a_ij T_j >= b_i
///
/// - cooperative: a_ij = min(1, M_ij / (gamma_i tau_i)), b_i = 1 - 2 met_tolerance. With unit failure, b_i is
///   multiplied by K / (K - 1) for selections of at most K units with a signal at the label: the strongest
///   contributes at least a K-th of the sum, and the others must suffice.
/// - non-cooperative: a_ij = l_ij, b_i = 1; with unit failure b_i = 2.
///
/// Every selection that the checker accepts satisfies these rows. The checker's sum of n < 10^6 signals has a
/// relative error of at most 2^-53 n < met_tolerance. Clipping at 1 keeps the rows valid
/// (docs/methods/placement.md, "Reductions").
class CoverRows {
 public:
  explicit CoverRows(const Instance& instance,
                     std::size_t max_units = std::numeric_limits<std::size_t>::max())
      : instance_(instance), max_units_(max_units) {}

  /// b_i.
  double bound(std::size_t label) const {
    const double once = instance_.is_cooperative() ? 1 - 2 * met_tolerance : 1;
    if (!instance_.problem.redundant) return once;
    if (!instance_.is_cooperative()) return 2;
    const std::size_t units = std::max<std::size_t>(2, std::min(max_units_, instance_.row(label).size()));
    return once * static_cast<double>(units) / static_cast<double>(units - 1);
  }

  /// Calls visit(column, a_ij) for the nonzero entries of a label in ascending column order.
  template <class Visit>
  void for_entries(std::size_t label, Visit visit) const {
    const double requirement = instance_.requirement(label);
    for (const SignalEntry& entry : instance_.row(label)) {
      const double value = share_of(entry.signal, requirement, instance_.problem);
      if (value > 0) visit(entry.transceiver, value);
    }
  }

  /// Expands an inequality, slightly relaxed, by more than rounding errors: calls visit(column, coefficient),
  /// ascending, and returns the right-hand side; 0 if the inequality is empty.
  template <class Visit>
  double read(const BoundRow& row, Visit visit) const {
    if (row.is_plain()) {
      for_entries(row.label, visit);
      return bound(row.label);
    }
    const bool is_case = row.strongest > 0;
    const double lacking =
        is_case ? 1 : bound(row.label) - row.share * static_cast<double>(max_units_) - rounding;
    if (!(lacking >= min_lack)) return 0;
    for_entries(row.label, [&](std::uint32_t j, double a) {
      // The difference loses digits; 1e-12 exceeds that error after the division.
      if (is_case ? a >= row.strongest : a > row.share)
        visit(j, is_case ? 1.0 : std::min(1.0, (a - row.share) / lacking + 1e-12));
    });
    return 1;
  }

 private:
  static constexpr double rounding = 1e-10;  // of sums of up to a million numbers of at most 1
  static constexpr double min_lack = 1e-3;

  const Instance& instance_;
  std::size_t max_units_;
};

}  // namespace shelfbeam::detail
