#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// The rows of a placement problem for bounds: for every label i
///
///   sum_j a_ij T_j >= b
///
/// - cooperative: a_ij = min(1, M_ij / (gamma_i tau_i)), b = 1 - 2 met_tolerance. With unit failure, b is
///   multiplied by K / (K - 1) for selections of at most K units: the strongest contributes at least a K-th
///   of the sum, and the others must suffice.
/// - non-cooperative: a_ij = l_ij, b = 1; with unit failure b = 2.
///
/// Every selection that the checker accepts satisfies these rows. The checker's sum of n < 10^6 signals has a
/// relative error of at most 2^-53 n < met_tolerance. Clipping at 1 keeps the rows valid
/// (docs/methods/placement.md, "Reductions").
class CoverRows {
 public:
  CoverRows(const Instance& instance, std::size_t max_units = std::numeric_limits<std::size_t>::max())
      : table_(instance.table),
        model_(instance.problem.model),
        cooperative_(model_ == CommunicationModel::cooperative),
        bound_(cooperative_ ? 1 - 2 * met_tolerance : 1) {
    const auto units = static_cast<double>(std::max<std::size_t>(max_units, 2));
    if (instance.problem.redundant) bound_ *= cooperative_ ? units / (units - 1) : 2;
  }

  double bound() const { return bound_; }

  /// Calls visit(column, a_ij) for the nonzero entries of a label in ascending column order.
  template <class Visit>
  void for_entries(std::size_t label, Visit visit) const {
    const double requirement = requirement_of(table_.labels[label], model_);
    for (const SignalEntry& entry : table_.row(label)) {
      const double value = cooperative_ ? std::min(1.0, entry.signal / requirement)
                                        : static_cast<double>(is_met(entry.signal, requirement));
      if (value > 0) visit(entry.transceiver, value);
    }
  }

 private:
  const SignalTable& table_;
  CommunicationModel model_;
  bool cooperative_;
  double bound_;
};

}  // namespace shelfbeam::detail
