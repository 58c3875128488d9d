#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/answer/search_step.hpp"
#include "shelfbeam/placement/bound/multiplier_bound.hpp"
#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/place_by_spend.hpp"
#include "shelfbeam/placement/placement_search.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/problem/spend.hpp"

namespace shelfbeam {

namespace {

using detail::Instance;
using MaybeSelection = std::optional<Selection>;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The labels that no selection reaches, regardless of the requirements of other labels.
std::vector<Unreachable> unreachable_labels(const Instance& instance) {
  // Sums in another order round differently if mounting points have options or a unit may fail. The search
  // decides labels within this distance of their requirement.
  const double rounding = instance.table.mounts.empty() && !instance.problem.redundant ? 1 : 1 + 1e-12;
  std::vector<Unreachable> result;
  for (std::uint32_t i = 0; i < instance.rows(); ++i) {
    const double requirement = instance.requirement(i);
    const double max_signal = instance.mounts.max_signal(instance.row(i), instance.problem);
    if (!is_met(max_signal * rounding, requirement)) result.push_back({i, requirement, max_signal});
  }
  return result;
}

/// The cheaper feasible one of two selections, the first if both cost the same.
MaybeSelection better_of(const Instance& instance, const Selection& first, const Selection& second) {
  const double of_first = instance.value_of(first);
  if (!second.empty() && instance.value_of(second) < of_first) return second;
  return of_first < infinite ? MaybeSelection(first) : std::nullopt;
}

/// Lower bound on a sum of costs over selections of at least `min_count` units, by some multipliers; rounded
/// up.
double quick_bound(const Instance& instance, std::span<const double> cost, double known,
                   std::size_t min_count, const detail::Effort& effort, const RunControl& control) {
  const CostBounds bounds(instance.table, cost);
  const detail::MultiplierBoundOptions options{
      .selections = {.min_count = min_count}, .known = known, .step = bounds.step(), .effort = effort};
  return std::min(known,
                  bounds.rounded(detail::multiplier_bound(instance, cost, options, control).dual.bound));
}

/// Raises bounds that the search has left low: all of them if it was not ours or had no time, and otherwise
/// that of the count if a sum is minimised.
void raise_neglected_bounds(Placement& placement, const Instance& instance, const PlaceOptions& options,
                            double seconds_left, const RunControl& control) {
  const bool is_sum = instance.is_weighted(), is_open = placement.gap() > 0;
  const bool is_count = !is_sum && instance.problem.objective == Objective::count;
  const bool is_low = placement.bound_proof == BoundProof::trivial || options.solver == SolverChoice::mip;
  constexpr double least = 0.05, most = 0.5;  // s
  constexpr std::uint64_t steps = 150;
  const detail::Effort effort =
      options.step_limit ? detail::Effort{std::min(steps, *options.step_limit)}
                         : detail::Effort{steps, Deadline(std::clamp(seconds_left, least, most)).end()};
  const auto raise = [&](double& bound, std::span<const double> cost, double known, std::size_t min_count) {
    const double found = quick_bound(instance, cost, known, min_count, effort, control);
    if (!(found > bound)) return;
    bound = found;
    placement.bound_proof = is_count ? BoundProof::dual : std::max(placement.bound_proof, BoundProof::dual);
  };
  const auto count = static_cast<double>(placement.count());
  if (is_sum || (is_open && is_low))
    raise(placement.count_lower_bound, std::vector<double>(instance.columns(), 1.0), count, 0);
  if (is_count) {
    placement.lower_bound = placement.count_lower_bound;
  } else if (is_open && (is_low || (!is_sum && placement.count_lower_bound < count))) {
    raise(placement.lower_bound, is_sum ? instance.first_cost : instance.second_cost,
          placement.objective_value, static_cast<std::size_t>(placement.count_lower_bound));
  }
  const bool is_proven = is_sum || placement.count_lower_bound >= count;
  if (is_open && is_proven && placement.gap() <= 0) placement.status = Status::optimal;
}

/// The answer for a problem whose labels can be reached one by one.
Placement placed(const Instance& instance, const PlaceOptions& options, const Deadline& deadline,
                 std::vector<SearchStep>& steps, const RunControl& control) {
  const auto backends = milp::backends_of(options.backend);
  const bool searches = options.uses(SolverChoice::search);
  const bool is_all = options.solver == SolverChoice::greedy;
  // A search of a large table takes about a second to begin.
  constexpr double share_of_greedy = 0.6, share_to_begin = 0.3, seconds_to_begin = 1;
  const double after_greedy = is_all ? 0 : (1 - share_of_greedy) * options.time_limit_s;
  Selection greedy;
  MaybeSelection known;
  detail::record_step(
      steps, "greedy", [&] { return known ? instance.value_of(*known) : infinite; }, [] { return 0.0; },
      [&] {
        greedy = greedy_selection(
            instance, detail::greedy_effort(options, deadline.seconds_left() - after_greedy), control);
        known = better_of(instance, greedy, options.start);
      });
  if (!known && searches)
    known = detail::first_selection(instance, greedy, 0.2 * deadline.seconds_left(), options.seed, control);
  const bool is_late =
      known && searches &&
      deadline.seconds_left() < std::min(share_to_begin * options.time_limit_s, seconds_to_begin);
  PlaceOptions own = options;
  if (is_late) own.solver = SolverChoice::greedy;
  // Bounds that the search leaves low are raised after it, which reads a large table a few times.
  constexpr double seconds_per_entry = 4e-9, max_share = 0.2;
  const double reserved = std::min(seconds_per_entry * static_cast<double>(instance.table.entries.size()),
                                   max_share * options.time_limit_s);
  const Deadline end(deadline.seconds_left() - reserved);
  Placement placement = detail::search_placement(instance, known, backends, own, end, control);
  if (is_all && known && !deadline.has_passed() && !control.cancelled()) placement.status = Status::feasible;
  return placement;
}

}  // namespace

double Placement::gap() const {
  if (status == Status::optimal) return 0;
  if (status == Status::infeasible || !(objective_value < infinite)) return infinite;
  return objective_value > lower_bound ? (objective_value - lower_bound) / objective_value : 0;
}

Placement infeasible_placement(std::vector<Unreachable> unreachable) {
  Placement placement;
  placement.status = Status::infeasible;
  placement.objective_value = placement.lower_bound = placement.count_lower_bound = infinite;
  placement.unreachable = std::move(unreachable);
  return placement;
}

Placement place(const SignalTable& table, const PlacementProblem& asked, const PlaceOptions& options,
                const RunControl& control) {
  const PlacementProblem problem = resolved(asked, table);
  if (problem.combination == Combination::spend)
    return detail::place_by_spend(table, problem, options, control);
  const Stopwatch watch;
  const Deadline deadline(options.step_limit ? detail::no_limit_s : options.time_limit_s);
  check_problem(table, problem);
  const ThreadLimit allowed(control.threads);
  milp::backends_of(options.backend);  // throws for an unknown name
  const Instance instance(table, problem);

  std::vector<SearchStep> steps;
  auto unreachable = unreachable_labels(instance);
  Placement placement = unreachable.empty() ? placed(instance, options, deadline, steps, control)
                                            : infeasible_placement(std::move(unreachable));
  if (placement.has_selection() && options.proves)
    raise_neglected_bounds(placement, instance, options, deadline.seconds_left(), control);
  if (placement.has_selection() && has_prices(table)) placement.price = price_of(table, placement.selected);
  placement.steps.insert(placement.steps.begin(), steps.begin(), steps.end());
  placement.problem = problem;
  placement.unit_costs = label_costs(table, problem.objective).unit;
  placement.min_spacing = table.min_spacing;
  placement.forbidden_pairs = table.conflicts.size();
  placement.seconds = watch.seconds();
  return placement;
}

}  // namespace shelfbeam
