#include "shelfbeam/placement/problem/placement_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

double received_signal(std::span<const SignalEntry> row, const std::vector<bool>& chosen,
                       const PlacementProblem& problem) {
  ReceivedSignal received(problem);
  for (const SignalEntry& entry : row)
    if (chosen[entry.transceiver]) received.add(entry.signal);
  return received.value();
}

void check_problem(const SignalTable& table, const PlacementProblem& problem) {
  for (const SignalTable::Label& label : table.labels) {
    const double requirement = requirement_of(label, problem.model);
    if (!(requirement > 0) || !std::isfinite(requirement))
      throw InputError("label " + label.id, "has no finite requirement greater than 0",
                       "set one for all labels", Setting::requirement);
  }
  if (!(problem.share > 0) || !std::isfinite(problem.share))
    throw InputError("share of effective links", fmt::format("is {}", problem.share),
                     "use a number greater than 0, such as 1", Setting::share);
}

LabelCosts label_costs(const SignalTable& table, Objective objective) {
  LabelCosts result{std::vector<double>(table.rows(), 0.0), false};
  if (objective == Objective::count) return result;
  for (std::size_t i = 0; i < table.rows(); ++i)
    result.cost[i] = objective == Objective::signal ? table.labels[i].signal_cost : table.labels[i].link_cost;
  result.unit = std::none_of(result.cost.begin(), result.cost.end(), [](double cost) { return cost > 0; });
  if (result.unit) std::fill(result.cost.begin(), result.cost.end(), 1.0);
  return result;
}

bool is_cover_of_sums(const SignalTable& table, const PlacementProblem& problem) {
  // Only the cost of links depends on the model.
  if (problem.model != CommunicationModel::cooperative || problem.objective == Objective::links) return false;
  for (std::size_t i = 0; i < table.rows(); ++i)
    for (const SignalEntry& entry : table.row(i))
      if (entry.signal > 0 && !is_met(entry.signal, table.labels[i].requirement)) return false;
  return true;
}

std::vector<double> objective_coefficients(const SignalTable& table, const PlacementProblem& problem) {
  std::vector<double> result(table.columns(), 0.0);
  if (problem.objective == Objective::count) return result;
  const std::vector<double> cost = label_costs(table, problem.objective).cost;
  const bool cooperative = problem.model == CommunicationModel::cooperative;
  if (problem.objective == Objective::links && cooperative) {
    std::fill(result.begin(), result.end(), std::accumulate(cost.begin(), cost.end(), 0.0));
    return result;
  }
  const double share = words_of(problem.objective).has_share ? problem.share : 1.0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double min_signal = share * requirement_of(table.labels[i], problem.model);
    for (const SignalEntry& entry : table.row(i)) {
      if (problem.objective == Objective::signal)
        result[entry.transceiver] += cost[i] * entry.signal;
      else if (is_met(entry.signal, min_signal))
        result[entry.transceiver] += cost[i];
    }
  }
  return result;
}

std::vector<double> first_objective(const SignalTable& table, const PlacementProblem& problem,
                                    std::vector<double> second) {
  if (problem.combination == Combination::lexicographic) return std::vector<double>(table.columns(), 1.0);
  const bool is_spend = problem.combination == Combination::spend;
  for (std::size_t j = 0; j < second.size(); ++j)
    second[j] += is_spend ? price_to_spend(table.transceivers[j]) : table.transceivers[j].cost;
  return second;
}

}  // namespace shelfbeam
