#include <algorithm>
#include <cmath>
#include <optional>

#include "shelfbeam/placement/search_state.hpp"

namespace shelfbeam::detail {

namespace {

// The proof of an exhausted tree search, after verification of its log.
std::optional<BoundProof> strength_of(const Proof& proof, const SearchState& state) {
  if (proof.steps.size() > state.limits.max_checked_steps) return BoundProof::search;
  return strength_of(judge_proof(state.instance, proof, {.until = state.deadline.end()}, state.control));
}

void raise_count_bound(SearchState& state, const Effort& effort) {
  while (!state.incumbent.is_closed() && !effort.is_over(state.control)) {
    const auto max_units = static_cast<std::size_t>(std::llround(state.incumbent.bound()));
    const TreeResult answer = state.tree->run({.max_units = max_units}, {effort, true}, state.control);
    state.offer(answer.selected);
    if (!answer.is_complete || answer.selected) return;
    const auto strength = strength_of(answer.proof, state);
    if (!strength) return;
    state.raise(state.incumbent.bound() + 1, *strength);
  }
}

struct Cheapest {
  std::optional<Selection> selected;     ///< cheaper than the incumbent
  double lower_bound = 0;                ///< on the cost
  std::optional<BoundProof> proof = {};  ///< of that bound; none without a bound
};
// Without a better selection, the bound exceeds `between`, which is between the incumbent's cost and any
// lower one.
Cheapest cheapest(const SearchState& state, std::size_t max_units, double between, const Effort& effort,
                  TreeSearch& tree) {
  // Every column is rounded by up to a half of cost_unit.
  const double rounding_errors = static_cast<double>(max_units + 1) / 2;
  const std::int64_t known = state.instance.cost_of(state.incumbent.selected());
  const double limit = std::ceil(between / state.instance.cost_unit + rounding_errors);
  const TreeGoal goal{.kind = TreeGoal::Kind::cheapest,
                      .max_units = max_units,
                      .max_cost = std::min<std::int64_t>(known - 1, std::llround(limit))};
  const TreeResult answer = tree.run(goal, {effort, true}, state.control);
  if (!answer.is_complete) return {answer.selected};
  const double bound = static_cast<double>(answer.proof.max_cost) + 1 - rounding_errors;
  return {answer.selected, std::max(0.0, bound * state.instance.cost_unit), strength_of(answer.proof, state)};
}

}  // namespace

void raise_bound_by_tree(SearchState& state, const Effort& effort) {
  if (!state.has_tree(state.incumbent.selected().size())) return;
  if (!state.instance.is_weighted()) return raise_count_bound(state, effort);
  const std::size_t max_units = state.instance.bounds.affordable(state.incumbent.value());
  if (!state.has_tree(max_units)) return;
  const double value = state.incumbent.value();
  const double between = 0.5 * (value + state.instance.bounds.below(value));
  const Cheapest found = cheapest(state, max_units, between, effort, *state.tree);
  state.offer(found.selected);
  if (found.proof) state.raise_open(found.lower_bound, *found.proof);
}

void search_second_by_tree(SearchState& state, const Effort& effort) {
  const double value = state.second->value(), between = 0.5 * (value + state.second->steps().below(value));
  const Cheapest found = cheapest(state, state.incumbent.selected().size(), between, effort, *state.tree);
  state.offer_second(found.selected);
  if (found.proof) state.raise_second(found.lower_bound, *found.proof);
}

// No more expensive selection may win, except within the rounding of sums of prices such as 0.1 and 0.2.
bool settle_ties(SearchState& state, const PlacementProblem& problem, const Selection& start) {
  const std::size_t max_units = state.instance.is_weighted()
                                    ? state.instance.bounds.affordable(state.incumbent.value())
                                    : state.incumbent.selected().size();
  if (!state.has_tree(max_units) || state.out_of_time()) return false;
  std::optional<Instance> own_instance;
  std::optional<SearchMatrix> own_matrix;
  if (problem.model != state.instance.problem.model) {
    own_instance.emplace(state.instance.table, problem);
    own_matrix.emplace(*own_instance);
  }
  const Instance& instance = own_instance ? *own_instance : state.instance;
  TreeGoal goal{.kind = TreeGoal::Kind::widest, .max_units = max_units};
  constexpr int bits_of_rounding = 40;  // 2^-40, about 1e-12 of the cost
  if (instance.has_costs) {
    goal.max_cost = instance.cost_of(state.incumbent.selected());
    goal.max_cost += goal.max_cost >> bits_of_rounding;
  }
  if (start.size() <= max_units && instance.cost_of(start) <= goal.max_cost) goal.start = start;
  constexpr std::uint64_t max_work = 2'000'000'000;  // some tenths of a second
  const TreeSearch::Limits limits{.effort = {.until = Deadline(0.5 * state.deadline.seconds_left()).end()},
                                  .work = max_work};
  TreeSearch tree(instance, own_matrix ? *own_matrix : *state.matrix);
  const TreeResult answer = tree.run(goal, limits, state.control);
  if (answer.selected)
    if (const double value = state.instance.value_of(*answer.selected); std::isfinite(value))
      state.incumbent.replace(*answer.selected, value);
  return answer.is_complete;
}

}  // namespace shelfbeam::detail
