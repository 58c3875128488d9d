#include "shelfbeam/placement/problem/checker.hpp"

#include <algorithm>

#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam {

Check check_selection(const SignalTable& table, const PlacementProblem& problem,
                      std::span<const std::uint32_t> selected) {
  std::vector<bool> chosen(table.columns(), false);
  for (const std::uint32_t j : selected) chosen.at(j) = true;
  const auto count = static_cast<double>(std::count(chosen.begin(), chosen.end(), true));
  const bool cooperative = problem.model == CommunicationModel::cooperative;
  const std::vector<double> cost = label_costs(table, problem.objective).cost;

  Check check;
  check.crowded = shared_mounts(table, chosen);
  check.too_close = conflicting_pairs(table, chosen);
  for (std::size_t j = 0; j < table.columns(); ++j)
    if (chosen[j]) check.transceiver_cost += table.transceivers[j].cost;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double requirement = requirement_of(table.labels[i], problem.model);
    double sum = 0;
    std::uint32_t alone = 0, effective = 0;  // units with l_ij = 1, effective links
    for (const SignalEntry& entry : table.row(i)) {
      if (!chosen[entry.transceiver]) continue;
      sum += entry.signal;
      if (is_met(entry.signal, table.labels[i].single_requirement)) ++alone;
      if (is_met(entry.signal, problem.share * requirement)) ++effective;
    }
    check.signal.push_back(received_signal(table, i, chosen, problem));
    check.serving.push_back(alone);
    if (!is_met(check.signal.back(), requirement)) check.unmet.push_back(static_cast<std::uint32_t>(i));
    switch (problem.objective) {
      case Objective::count:
        break;
      case Objective::links:
        check.objective += cost[i] * (cooperative ? count : alone);
        break;
      case Objective::effective_links:
        check.objective += cost[i] * effective;
        break;
      case Objective::signal:
        check.objective += cost[i] * sum;
        break;
    }
  }
  return check;
}

}  // namespace shelfbeam
