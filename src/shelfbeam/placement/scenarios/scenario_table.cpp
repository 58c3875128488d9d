#include "shelfbeam/placement/scenarios/scenario_table.hpp"

#include <algorithm>
#include <utility>

namespace shelfbeam {

ScenarioTable make_scenario_table(const SignalTable& all, std::span<const LabelId> labels,
                                  std::size_t scenarios, const ScenarioTable& before) {
  ScenarioTable result;
  result.table = all;
  result.count = scenarios;
  result.table.labels.clear();
  for (const LabelId i : labels) result.table.labels.push_back(all.labels[i]);
  result.table.scenarios.clear();  // those of several matrices
  result.table.entries.clear();
  result.table.row_begin.assign(labels.size() + 1, 0);
  result.signal.resize(all.columns() * labels.size() * scenarios);
  result.error.resize(result.signal.size());
  const std::size_t kept = before.table.rows() * scenarios;
  for (std::size_t j = 0; j < all.columns() && kept > 0; ++j)
    for (const auto values : {&ScenarioTable::signal, &ScenarioTable::error})
      std::copy_n((before.*values).begin() + static_cast<std::ptrdiff_t>(j * kept), kept,
                  (result.*values).begin() + static_cast<std::ptrdiff_t>(result.at(j, 0, 0)));
  return result;
}

void set_scenario(ScenarioTable& scenarios, std::size_t scenario, std::size_t first,
                  const SignalLayer& signals) {
  const std::size_t n = scenarios.table.columns();
  for (std::size_t i = first; i < scenarios.table.rows(); ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t from = (i - first) * n + j, to = scenarios.at(j, i, scenario);
      scenarios.signal[to] = std::max(0.0F, signals.mean[from]);
      scenarios.error[to] = signals.standard_error[from];
    }
}

ScenarioTable raised(const ScenarioTable& scenarios, double errors) {
  ScenarioTable result{scenarios.table, scenarios.count, scenarios.signal, {}};
  for (std::size_t e = 0; e < result.signal.size(); ++e)
    result.signal[e] += static_cast<float>(errors) * scenarios.error[e];
  return result;
}

std::vector<ReceivedSignal> received_signals(const ScenarioTable& scenarios, const PlacementProblem& problem,
                                             std::size_t label, std::span<const ColumnId> selected) {
  std::vector<ReceivedSignal> received(scenarios.count, ReceivedSignal(problem));
  for (const ColumnId j : selected) {
    const std::span<const float> signal = scenarios.of(j, label);
    for (std::size_t s = 0; s < signal.size(); ++s) received[s].add(static_cast<double>(signal[s]));
  }
  return received;
}

ScenarioMisses misses_of(const ScenarioTable& scenarios, const PlacementProblem& problem,
                         std::span<const ColumnId> selected, double reserve) {
  MissCounter misses(scenarios.table.rows(), scenarios.count);
  for_each_weak(scenarios, problem, selected, reserve,
                [&](LabelId i, std::uint32_t s, const ReceivedSignal&) { misses.add(i, s); });
  return misses.misses();
}

}  // namespace shelfbeam
