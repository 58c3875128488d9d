#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/stats/moments.hpp"

namespace shelfbeam::detail {

/// Summarises the signals of states: their mean, their deviation, and every state of the hardest labels,
/// which the fewest candidates reach (docs/formats/signal.md).
class StateSummary {
 public:
  /// Fills the entries of `matrix`, except `direct`; it must outlive the object.
  StateSummary(SignalMatrix& matrix, std::size_t max_hard)
      : matrix_(matrix), max_hard_(max_hard), moments_(matrix.rows() * matrix.columns()) {}

  /// Adds the signals of the next state, by label and transceiver, and their errors if the states serve a
  /// plan.
  void add(std::span<const float> signals, std::span<const float> errors = {});
  /// After the last state.
  void finish();

 private:
  SignalMatrix& matrix_;
  std::size_t max_hard_;
  std::vector<Moments> moments_;
};

}  // namespace shelfbeam::detail
