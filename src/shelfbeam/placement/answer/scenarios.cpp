#include "shelfbeam/placement/answer/scenarios.hpp"

#include <cmath>
#include <limits>

#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam {

std::vector<ScenarioMargin> scenario_margins(const SignalTable& table, const Placement& placement) {
  std::vector<ScenarioMargin> margins;
  if (table.scenarios.empty() || !placement.has_selection()) return margins;
  const std::vector<double> signal = check_selection(table, placement.question, placement.selected).signal;
  for (std::size_t k = 0; k < table.scenarios.size(); ++k) {
    const SignalTable::Scenario& scenario = table.scenarios[k];
    ScenarioMargin least{k, std::numeric_limits<double>::infinity(), 0};
    for (std::size_t i = scenario.first; i < scenario.first + scenario.labels; ++i) {
      const double margin = signal[i] / requirement_of(table.labels[i], placement.question.model);
      if (margin < least.smallest_margin) least = {k, margin, static_cast<std::uint32_t>(i)};
    }
    margins.push_back(least);
  }
  return margins;
}

}  // namespace shelfbeam
