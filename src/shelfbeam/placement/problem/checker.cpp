#include "shelfbeam/placement/problem/checker.hpp"

#include <algorithm>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam {

Check check_selection(const SignalTable& table, const PlacementProblem& problem,
                      std::span<const ColumnId> selected) {
  std::vector<bool> chosen(table.columns(), false);
  for (const ColumnId j : selected) chosen.at(j) = true;
  const auto count = static_cast<double>(std::count(chosen.begin(), chosen.end(), true));
  const bool cooperative = problem.model == CommunicationModel::cooperative;
  const std::vector<double> cost = label_costs(table, problem.objective).cost;

  Check check;
  check.crowded = shared_mounts(table, chosen);
  check.too_close = conflicting_pairs(table, chosen);
  for (std::size_t j = 0; j < table.columns(); ++j)
    if (chosen[j]) check.transceiver_cost += table.transceivers[j].cost;
  check.signal.resize(table.rows());
  check.serving.resize(table.rows());
  std::vector<double> objective(table.rows(), 0.0);
  const auto look = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const double requirement = requirement_of(table.labels[i], problem.model);
      double sum = 0;
      std::uint32_t alone = 0, effective = 0;  // units with l_ij = 1, effective links
      for (const SignalEntry& entry : table.row(i)) {
        if (!chosen[entry.transceiver]) continue;
        sum += entry.signal;
        if (is_met(entry.signal, table.labels[i].single_requirement)) ++alone;
        if (is_met(entry.signal, problem.share * requirement)) ++effective;
      }
      check.signal[i] = received_signal(table.row(i), chosen, problem);
      check.serving[i] = alone;
      switch (problem.objective) {
        case Objective::count:
          break;
        case Objective::links:
          objective[i] = cost[i] * (cooperative ? count : alone);
          break;
        case Objective::effective_links:
          objective[i] = cost[i] * effective;
          break;
        case Objective::signal:
          objective[i] = cost[i] * sum;
          break;
      }
    }
  };
  constexpr std::size_t many = 100'000;  // entries, so that threads are worth their start
  if (table.entries.size() > many)
    parallel_for_ranges(table.rows(), look);
  else
    look(0, table.rows());
  for (std::uint32_t i = 0; i < table.rows(); ++i) {
    check.objective += objective[i];
    if (!is_met(check.signal[i], requirement_of(table.labels[i], problem.model))) check.unmet.push_back(i);
  }
  return check;
}

}  // namespace shelfbeam
