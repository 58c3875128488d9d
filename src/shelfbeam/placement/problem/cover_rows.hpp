#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

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
    const bool adds_up = instance_.is_cooperative();
    for (const SignalEntry& entry : instance_.row(label)) {
      const double value = adds_up ? std::min(1.0, entry.signal / requirement)
                                   : static_cast<double>(is_met(entry.signal, requirement));
      if (value > 0) visit(entry.transceiver, value);
    }
  }

 private:
  const Instance& instance_;
  std::size_t max_units_;
};

}  // namespace shelfbeam::detail
