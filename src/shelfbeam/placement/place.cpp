#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/answer/search_step.hpp"
#include "shelfbeam/placement/bound/multiplier_bound.hpp"
#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/mip/mip.hpp"
#include "shelfbeam/placement/place_by_spend.hpp"
#include "shelfbeam/placement/placement_search.hpp"
#include "shelfbeam/placement/problem/bounds.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"
#include "shelfbeam/placement/problem/spend.hpp"

namespace shelfbeam {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The labels that no selection reaches, regardless of the requirements of other labels.
std::vector<Unreachable> unreachable_labels(const SignalTable& table, const PlacementProblem& problem) {
  // Sums in another order round differently if mounting points have options or a unit may fail. The search
  // decides labels within this distance of their requirement.
  const double rounding = table.mounts.empty() && !problem.redundant ? 1 : 1 + 1e-12;
  const Mounts mounts(table);
  std::vector<Unreachable> result;
  for (std::uint32_t i = 0; i < table.rows(); ++i) {
    const double requirement = requirement_of(table.labels[i], problem.model);
    const double max_signal = mounts.max_signal(table.row(i), problem);
    if (!is_met(max_signal * rounding, requirement)) result.push_back({i, requirement, max_signal});
  }
  return result;
}

Placement infeasible(const SignalTable& table, const PlacementProblem& problem,
                     std::vector<Unreachable> unreachable) {
  Placement placement;
  placement.problem = problem;
  placement.status = Status::infeasible;
  placement.objective_value = placement.lower_bound = placement.count_lower_bound = infinite;
  placement.unit_costs = label_costs(table, problem.objective).unit;
  placement.unreachable = std::move(unreachable);
  return placement;
}

using MaybeSelection = std::optional<std::vector<std::uint32_t>>;

double value_of(const Check& check, const PlacementProblem& problem, std::size_t count) {
  return problem.combination == Combination::weighted ? check.transceiver_cost + check.objective
                                                      : static_cast<double>(count);
}

/// The cheaper feasible one of two selections, the first if both cost the same.
MaybeSelection better_of(const SignalTable& table, const PlacementProblem& problem,
                         const std::vector<std::uint32_t>& first, const std::vector<std::uint32_t>& second) {
  const Check of_first = check_selection(table, problem, first);
  if (second.empty()) return of_first.met() ? MaybeSelection(first) : std::nullopt;
  const Check of_second = check_selection(table, problem, second);
  if (!of_second.met()) return of_first.met() ? MaybeSelection(first) : std::nullopt;
  const bool is_cheaper =
      value_of(of_second, problem, second.size()) < value_of(of_first, problem, first.size());
  return is_cheaper || !of_first.met() ? second : first;
}

/// A selection with the bounds that need no search.
Placement greedy_placement(const SignalTable& table, const PlacementProblem& problem,
                           const MaybeSelection& selected) {
  Placement placement = place_by_mip(table, problem, selected, {}, 0, {}).placement;
  placement.status = selected ? Status::feasible : Status::stopped;
  placement.solver = {Method::greedy};
  return placement;
}

/// Lower bound on a sum of costs over selections of at least `min_count` units, by some multipliers; rounded
/// up.
double quick_bound(const SignalTable& table, const PlacementProblem& problem, std::span<const double> cost,
                   double known, std::size_t min_count, const PlaceOptions& options, const Deadline& deadline,
                   const RunControl& control) {
  constexpr std::uint64_t steps = 150;
  const CostBounds bounds(table, cost);
  detail::MultiplierBoundOptions quick;
  quick.selections.min_count = min_count;
  quick.known = known;
  quick.step = bounds.step();
  quick.max_steps = std::min(steps, options.step_limit.value_or(steps));
  if (!options.step_limit) quick.until = deadline.end();
  return std::min(
      known, bounds.rounded(detail::multiplier_bound(table, problem, cost, quick, {}, control).dual.bound));
}

/// Raises bounds that the search has left low: all of them if it was not ours or had no time, and otherwise
/// that of the count if a sum is minimised.
void raise_neglected_bounds(Placement& placement, const SignalTable& table, const PlaceOptions& options,
                            double seconds_left, const RunControl& control) {
  const PlacementProblem& problem = placement.problem;
  const bool is_sum = problem.combination == Combination::weighted, is_open = placement.gap() > 0;
  const bool is_count = !is_sum && problem.objective == Objective::count;
  const bool is_low = placement.bound_proof == BoundProof::trivial || options.solver == SolverChoice::mip;
  const auto raise = [&](double& bound, double found) {
    if (!(found > bound)) return;
    bound = found;
    placement.bound_proof = is_count ? BoundProof::dual : std::max(placement.bound_proof, BoundProof::dual);
  };
  constexpr double least = 0.05, most = 0.5;  // s
  const Deadline deadline(std::clamp(seconds_left, least, most));
  const std::vector<double> ones(table.columns(), 1.0);
  const auto count = static_cast<double>(placement.count());
  if (is_sum || (is_open && is_low))
    raise(placement.count_lower_bound,
          quick_bound(table, problem, ones, count, 0, options, deadline, control));
  if (is_count) {
    placement.lower_bound = placement.count_lower_bound;
  } else if (is_open && (is_low || (!is_sum && placement.count_lower_bound < count))) {
    const std::vector<double> cost =
        is_sum ? first_objective(table, problem) : objective_coefficients(table, problem);
    const auto fewest = static_cast<std::size_t>(placement.count_lower_bound);
    raise(placement.lower_bound,
          quick_bound(table, problem, cost, placement.objective_value, fewest, options, deadline, control));
  }
  const bool is_proven = is_sum || placement.count_lower_bound >= count;
  if (is_open && is_proven && placement.gap() <= 0) placement.status = Status::optimal;
}

}  // namespace

double Placement::gap() const {
  if (status == Status::optimal) return 0;
  if (status == Status::infeasible || !(objective_value < infinite)) return infinite;
  return objective_value > lower_bound ? (objective_value - lower_bound) / objective_value : 0;
}

Placement place(const SignalTable& table, const PlacementProblem& asked, const PlaceOptions& options,
                const RunControl& control) {
  const PlacementProblem problem = resolved(asked, table);
  if (problem.combination == Combination::spend)
    return detail::place_by_spend(table, problem, options, control);
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const auto left = [&] { return options.step_limit ? infinite : options.time_limit_s - elapsed(); };
  check_problem(table, problem);
  const ThreadLimit allowed(control.threads);
  const auto backends = milp::backends_of(options.backend);

  Placement placement;
  std::vector<SearchStep> steps;
  if (auto unreachable = unreachable_labels(table, problem); !unreachable.empty()) {
    placement = infeasible(table, problem, std::move(unreachable));
  } else {
    const bool without_mip = options.solver == SolverChoice::search;
    const bool searches = without_mip || options.solver == SolverChoice::automatic;
    // A search of a large table takes about a second to begin.
    constexpr double share_of_greedy = 0.6, share_to_begin = 0.3, seconds_to_begin = 1;
    const bool is_all = options.solver == SolverChoice::greedy;
    const double until = (is_all ? 1 : share_of_greedy) * options.time_limit_s;
    std::vector<std::uint32_t> greedy;
    MaybeSelection known;
    const auto value = [&] {
      return known ? value_of(check_selection(table, problem, *known), problem, known->size()) : infinite;
    };
    detail::record_step(
        steps, "greedy", value, [] { return 0.0; },
        [&] {
          greedy =
              greedy_selection(table, problem, detail::greedy_effort(options, until - elapsed()), control);
          known = better_of(table, problem, greedy, options.start);
        });
    if (!known && searches)
      known = detail::first_selection(table, problem, greedy, 0.2 * left(), options.seed, control);
    if (options.solver == SolverChoice::greedy) {
      placement = greedy_placement(table, problem, known);
      if (left() <= 0 || control.cancelled()) placement.status = Status::stopped;
    } else if (known && searches &&
               left() < std::min(share_to_begin * options.time_limit_s, seconds_to_begin)) {
      placement = greedy_placement(table, problem, known);
      placement.status = Status::stopped;
    } else if (known && searches) {
      placement = detail::search_placement(
          table, problem, *known, {backends, without_mip}, left(), options.seed, control,
          {.proves = options.proves, .settles_ties = options.settles_ties, .step_limit = options.step_limit});
    } else if (without_mip || (searches && table.entries.size() > detail::SearchLimits{}.max_model_entries)) {
      placement = greedy_placement(table, problem, known);
      placement.solver = {Method::search};
    } else {
      for (const milp::Backend& backend : backends) {
        MipResult answer =
            place_by_mip(table, problem, known, limited(backend.solve, options.step_limit), left(), control);
        placement = std::move(answer.placement);
        placement.solver = {Method::mip, backend.full_name()};
        if (!answer.solver_failed) break;
      }
      // Bounds above those without a search rest on the solver alone.
      const Placement plain = greedy_placement(table, problem, known);
      if (placement.count_lower_bound > plain.count_lower_bound || placement.lower_bound > plain.lower_bound)
        placement.bound_proof = BoundProof::solver;
    }
  }
  if (placement.has_selection() && options.proves)
    raise_neglected_bounds(placement, table, options, left(), control);
  if (placement.has_selection() && has_prices(table)) placement.price = price_of(table, placement.selected);
  placement.steps.insert(placement.steps.begin(), steps.begin(), steps.end());
  placement.min_spacing = table.min_spacing;
  placement.forbidden_pairs = table.conflicts.size();
  placement.seconds = elapsed();
  return placement;
}

}  // namespace shelfbeam
