#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// The rows of a question as bounds use them: sum_j a_ij T_j >= b for every label i, with
/// - cooperative: a_ij = min(1, M_ij / (gamma_i tau_i)), b = 1 - 2 met_tolerance; where a unit may fail, for
///   answers of at most K units, K / (K - 1) times that: without the strongest, which gives a K-th of the sum
///   or more, there is still enough,
/// - non-cooperative: a_ij = l_ij, b = 1; where a unit may fail 2.
///
/// Every selection that the checker accepts meets them: it sums n signals, n below a million, with a relative
/// error of at most 2^-53 n < met_tolerance, and where clipping at 1 takes something away the row holds
/// anyhow.
class CoverRows {
 public:
  CoverRows(const SignalTable& table, const Question& question,
            std::size_t most_units = std::numeric_limits<std::size_t>::max())
      : table_(table),
        model_(question.model),
        cooperative_(model_ == CommunicationModel::cooperative),
        bound_(cooperative_ ? 1 - 2 * met_tolerance : 1) {
    const auto units = static_cast<double>(std::max<std::size_t>(most_units, 2));
    if (question.redundant) bound_ *= cooperative_ ? units / (units - 1) : 2;
  }

  double bound() const { return bound_; }

  /// Calls visit(column, a_ij) for the entries of a label in ascending column order, zeros left out.
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
