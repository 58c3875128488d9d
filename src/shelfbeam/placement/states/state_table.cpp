#include "shelfbeam/placement/states/state_table.hpp"

#include <algorithm>
#include <utility>

namespace shelfbeam {

StateTable make_state_table(const SignalMatrix& matrix, SignalTable table, double errors) {
  StateTable states;
  states.table = std::move(table);
  states.states = matrix.by_state.size();
  const std::size_t m = matrix.rows(), n = matrix.columns();
  states.signal.resize(m * states.states * n);
  for (std::size_t s = 0; s < states.states; ++s) {
    const SignalLayer& layer = matrix.by_state[s];
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const std::size_t e = i * n + j;
        const float signal = layer.mean[e] + static_cast<float>(errors) * layer.standard_error[e];
        states.signal[(j * m + i) * states.states + s] = std::max(0.0F, signal);
      }
  }
  return states;
}

std::vector<double> received_signals(const StateTable& states, const PlacementProblem& problem,
                                     std::size_t label, std::span<const std::uint32_t> selected) {
  std::vector<ReceivedSignal> received(states.states, ReceivedSignal(problem));
  for (const std::uint32_t j : selected) {
    const std::span<const float> signal = states.of(j, label);
    for (std::size_t s = 0; s < signal.size(); ++s) received[s].add(static_cast<double>(signal[s]));
  }
  std::vector<double> values(states.states);
  std::transform(received.begin(), received.end(), values.begin(),
                 [](const ReceivedSignal& one) { return one.value(); });
  return values;
}

StateMisses misses_of(const StateTable& states, const PlacementProblem& problem,
                      std::span<const std::uint32_t> selected) {
  StateMisses misses;
  misses.of_label.assign(states.table.rows(), 0);
  std::vector<bool> any(states.states, false);
  for (std::size_t i = 0; i < states.table.rows(); ++i) {
    const double requirement = requirement_of(states.table.labels[i], problem.model);
    const std::vector<double> received = received_signals(states, problem, i, selected);
    for (std::size_t s = 0; s < received.size(); ++s)
      if (!is_met(received[s], requirement)) {
        ++misses.of_label[i];
        any[s] = true;
      }
  }
  misses.of_shop = static_cast<std::uint32_t>(std::count(any.begin(), any.end(), true));
  return misses;
}

}  // namespace shelfbeam
