#pragma once

#include <algorithm>
#include <cstddef>

#include "shelfbeam/placement/instance.hpp"

namespace shelfbeam::detail {

/// The rows of a question as bounds use them: sum_j a_ij T_j >= b for every label i, with
/// - cooperative: a_ij = min(1, M_ij / (gamma_i tau_i)), b = 1 - 2 met_tolerance,
/// - non-cooperative: a_ij = l_ij, b = 1.
///
/// Every selection that the checker accepts meets them: it sums n signals, n below a million, with a relative
/// error of at most 2^-53 n < met_tolerance, and where clipping at 1 takes something away the row holds
/// anyhow.
class CoverRows {
 public:
  CoverRows(const SignalTable& table, CommunicationModel model)
      : table_(table), model_(model), cooperative_(model == CommunicationModel::cooperative) {}

  double bound() const { return cooperative_ ? 1 - 2 * met_tolerance : 1; }

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
};

}  // namespace shelfbeam::detail
