#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/stats/moments.hpp"

namespace shelfbeam::detail {

/// Summarises the signals of states: their mean, their deviation, and every state of the hardest labels,
/// which the fewest candidates reach (docs/formats/signal.md).
class StateSummary {
 public:
  /// `head`: the matrix without means and errors.
  StateSummary(SignalMatrix head, std::size_t max_hard)
      : signals_{std::move(head), StateTensor(), {}},
        max_hard_(max_hard),
        moments_(signals_.rows() * signals_.columns()) {}

  /// Adds the signals of the next state, by label and transceiver, and their errors if the states serve a
  /// plan.
  void add(std::span<const float> signals, std::span<const float> errors = {});
  std::uint32_t states() const { return signals_.states->states; }
  /// After the last state.
  StoredSignals result() &&;

 private:
  StoredSignals signals_;
  std::size_t max_hard_;
  std::vector<Moments> moments_;
};

}  // namespace shelfbeam::detail
