#include "shelfbeam/placement/states/state_table.hpp"

#include <algorithm>
#include <utility>

namespace shelfbeam {

StateTable make_state_table(const SignalTable& all, std::span<const std::uint32_t> labels, std::size_t states,
                            const StateTable& before) {
  StateTable result;
  result.table = all;
  result.states = states;
  result.table.labels.clear();
  for (const std::uint32_t i : labels) result.table.labels.push_back(all.labels[i]);
  result.table.scenarios.clear();
  result.table.entries.clear();
  result.table.row_begin.assign(labels.size() + 1, 0);
  result.signal.resize(all.columns() * labels.size() * states);
  result.error.resize(result.signal.size());
  const std::size_t kept = before.table.rows() * states;
  for (std::size_t j = 0; j < all.columns() && kept > 0; ++j)
    for (const auto values : {&StateTable::signal, &StateTable::error})
      std::copy_n((before.*values).begin() + static_cast<std::ptrdiff_t>(j * kept), kept,
                  (result.*values).begin() + static_cast<std::ptrdiff_t>(result.at(j, 0, 0)));
  return result;
}

void set_state(StateTable& states, std::size_t state, std::size_t first, const SignalLayer& signals) {
  const std::size_t n = states.table.columns();
  for (std::size_t i = first; i < states.table.rows(); ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t from = (i - first) * n + j, to = states.at(j, i, state);
      states.signal[to] = std::max(0.0F, signals.mean[from]);
      states.error[to] = signals.standard_error[from];
    }
}

StateTable raised(const StateTable& states, double errors) {
  StateTable result{states.table, states.states, states.signal, {}};
  for (std::size_t e = 0; e < result.signal.size(); ++e)
    result.signal[e] += static_cast<float>(errors) * states.error[e];
  return result;
}

std::vector<ReceivedSignal> received_signals(const StateTable& states, const PlacementProblem& problem,
                                             std::size_t label, std::span<const ColumnId> selected) {
  std::vector<ReceivedSignal> received(states.states, ReceivedSignal(problem));
  for (const ColumnId j : selected) {
    const std::span<const float> signal = states.of(j, label);
    for (std::size_t s = 0; s < signal.size(); ++s) received[s].add(static_cast<double>(signal[s]));
  }
  return received;
}

StateMisses misses_of(const StateTable& states, const PlacementProblem& problem,
                      std::span<const ColumnId> selected, double reserve) {
  MissCounter misses(states.table.rows(), states.states);
  for_each_weak(states, problem, selected, reserve,
                [&](std::uint32_t i, std::uint32_t s, const ReceivedSignal&) { misses.add(i, s); });
  return misses.misses();
}

}  // namespace shelfbeam
