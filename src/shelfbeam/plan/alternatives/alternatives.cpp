#include "shelfbeam/plan/alternatives/alternatives.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "shelfbeam/placement/coverage/max_coverage.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/problem/label_shares.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"
#include "shelfbeam/placement/problem/progress_alone.hpp"

namespace shelfbeam {

namespace {

// Moves of a local search, or nodes of a tree, per stage of the search.
constexpr std::uint64_t steps_per_stage = 20'000;
// Matrix entries that the enumeration of one unit fewer examines, about a second; more than its search does.
constexpr std::uint64_t enumerated_entries = 5'000'000'000;

double smallest_margin(const SignalTable& table, const PlacementProblem& problem, const Check& check) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < table.rows(); ++i)
    smallest = std::min(smallest, check.signal[i] / requirement_of(table.labels[i], problem.model));
  return smallest;
}

std::optional<Alternative> one_fewer(const Placement& placement, const SignalTable& table,
                                     const RunControl& control) {
  const auto is_installed = [&](std::uint32_t j) { return table.transceivers[j].installed; };
  if (placement.selected.empty() ||
      std::all_of(placement.selected.begin(), placement.selected.end(), is_installed))
    return {};
  PlaceOptions options;
  options.solver = SolverChoice::search;
  options.step_limit = enumerated_entries / (table.entries.size() + 1);
  const MaxCoverage most =
      maximise_coverage(table, placement.problem, placement.count() - 1, options, control);
  if (control.cancelled()) return {};
  Alternative result = evaluate(table, placement.problem, most.selected);
  result.max_reached = most.upper_bound;
  // The placement's own bound may exclude that fewer units reach all labels.
  if (placement.count_lower_bound >= static_cast<double>(placement.count()) && table.rows() > 0)
    result.max_reached = std::min(result.max_reached, table.rows() - 1);
  result.is_proven = result.reached >= result.max_reached;
  return result;
}

// The margin of a label with one more signal, to rank candidates: sums may round differently from those of
// received_signal. `shares` are signals over the requirement.
double margin_with(detail::LabelShares shares, std::uint32_t column, double share,
                   const PlacementProblem& problem) {
  shares.add(column, share);
  if (problem.model == CommunicationModel::cooperative)
    return problem.redundant ? shares.sum - shares.largest : shares.sum;
  return problem.redundant ? shares.second : shares.largest;
}

std::optional<Alternative> one_more(const Placement& placement, const SignalTable& table) {
  const PlacementProblem& problem = placement.problem;
  const Mounts mounts(table);
  std::vector<bool> chosen(table.columns(), false), blocked(table.columns(), false);
  for (const std::uint32_t j : placement.selected) {
    chosen[j] = blocked[j] = true;
    mounts.for_each_conflict(j, [&](std::uint32_t other) { blocked[other] = true; });
  }
  std::vector<double> smallest(table.columns(), std::numeric_limits<double>::infinity());
  std::vector<double> share(table.columns());
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double requirement = requirement_of(table.labels[i], problem.model);
    detail::LabelShares received;
    std::fill(share.begin(), share.end(), 0.0);
    for (const SignalEntry& entry : table.row(i)) {
      share[entry.transceiver] = entry.signal / requirement;
      if (chosen[entry.transceiver]) received.add(entry.transceiver, share[entry.transceiver]);
    }
    for (std::uint32_t j = 0; j < share.size(); ++j)
      smallest[j] = std::min(smallest[j], margin_with(received, j, share[j], problem));
  }
  std::optional<std::uint32_t> best;
  for (std::uint32_t j = 0; j < table.columns(); ++j)
    if (!blocked[j] && (!best || smallest[j] > smallest[*best])) best = j;
  if (!best) return {};
  Selection selected = placement.selected;
  selected.insert(std::upper_bound(selected.begin(), selected.end(), *best), *best);
  Alternative result = evaluate(table, problem, std::move(selected));
  result.is_proven = true;
  return result;
}

}  // namespace

Alternative evaluate(const SignalTable& table, const PlacementProblem& problem, Selection selected) {
  Alternative result;
  const Check check = check_selection(table, problem, selected);
  result.reached = table.rows() - check.unmet.size();
  result.smallest_margin = smallest_margin(table, problem, check);
  PlacementProblem with_failure = problem;
  with_failure.redundant = true;
  result.secure = table.rows() - check_selection(table, with_failure, selected).unmet.size();
  if (has_prices(table)) result.price = price_of(table, selected);
  result.selected = std::move(selected);
  return result;
}

Alternatives alternatives_to(const Placement& placement, const SignalTable& table, const RunControl& given) {
  Alternatives result;
  if (!placement.has_selection() || table.rows() == 0) return result;
  // One thread: with step limits, the order of events decides.
  ProgressAlone progress(given.progress);
  const RunControl control{1, given.cancel, &progress};
  result.one_fewer = one_fewer(placement, table, control);
  result.one_more = one_more(placement, table);
  if (placement.problem.redundant || control.cancelled()) return result;
  PlacementProblem redundant = placement.problem;
  redundant.redundant = true;
  PlaceOptions options;
  options.solver = SolverChoice::search;
  options.settles_ties = false;
  options.step_limit = steps_per_stage;
  const Placement secure = place(table, redundant, options, control);
  if (control.cancelled()) return result;
  result.cannot_survive = secure.status == Status::infeasible;
  if (secure.has_selection()) {
    result.survives_failure = evaluate(table, placement.problem, secure.selected);
    result.survives_failure->is_proven = secure.status == Status::optimal;
  }
  return result;
}

}  // namespace shelfbeam
