#include "shelfbeam/placement/answer/weak_spots.hpp"

#include <limits>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam {

std::vector<ScenarioMargin> scenario_margins(const SignalTable& table, const Placement& placement) {
  std::vector<ScenarioMargin> margins;
  if (table.scenarios.empty() || !placement.has_selection()) return margins;
  const std::vector<double> signal = check_selection(table, placement.problem, placement.selected).signal;
  for (std::size_t k = 0; k < table.scenarios.size(); ++k) {
    const SignalTable::Scenario& scenario = table.scenarios[k];
    ScenarioMargin smallest{k, std::numeric_limits<double>::infinity(), 0};
    for (std::size_t i = scenario.first; i < scenario.first + scenario.labels; ++i) {
      const double margin = signal[i] / requirement_of(table.labels[i], placement.problem.model);
      if (margin < smallest.smallest_margin) smallest = {k, margin, static_cast<std::uint32_t>(i)};
    }
    margins.push_back(smallest);
  }
  return margins;
}

std::vector<Critical> critical_units(const SignalTable& table, const PlacementProblem& problem,
                                     const Selection& selected) {
  PlacementProblem nothing_fails = problem;
  nothing_fails.redundant = false;
  std::vector<std::size_t> place(table.columns(), 0);
  std::vector<bool> working = marked(table.columns(), selected);
  std::vector<Critical> result;
  for (const ColumnId j : selected) {
    place[j] = result.size();
    result.push_back({j, {}});
  }
  std::vector<SignalEntry> received;
  for (std::uint32_t i = 0; i < table.rows(); ++i) {
    const double requirement = requirement_of(table.labels[i], problem.model);
    received.clear();
    for (const SignalEntry& entry : table.row(i))
      if (working[entry.transceiver]) received.push_back(entry);
    if (!is_met(received_signal(received, working, nothing_fails), requirement)) continue;
    for (const SignalEntry& entry : received) {
      working[entry.transceiver] = false;
      if (!is_met(received_signal(received, working, nothing_fails), requirement))
        result[place[entry.transceiver]].labels.push_back(i);
      working[entry.transceiver] = true;
    }
  }
  return result;
}

}  // namespace shelfbeam
