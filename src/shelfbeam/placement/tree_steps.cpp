#include <algorithm>
#include <cmath>
#include <optional>

#include "shelfbeam/placement/search_state.hpp"

namespace shelfbeam::detail {

namespace {

// What an exhausted tree proves, once its log has been examined.
std::optional<BoundProof> strength_of(const Proof& proof, const SearchState& state) {
  if (proof.steps.size() > state.limits.most_checked_steps) return BoundProof::search;
  switch (judge_proof(state.table, state.question, proof, {state.deadline.end(), state.control})) {
    case ProofVerdict::holds:
      return BoundProof::log;
    case ProofVerdict::left_open:
    case ProofVerdict::unfinished:
      return BoundProof::search;
    case ProofVerdict::refuted:
      break;
  }
  return std::nullopt;  // whatever the search says, it has not shown it
}

void raise_count_bound(SearchState& state, const Effort& effort) {
  while (!state.incumbent.is_closed() && !effort.is_over(state.control)) {
    TreeGoal goal;
    goal.most_units = static_cast<std::size_t>(std::llround(state.incumbent.bound()));
    const TreeAnswer answer = state.tree->run(goal, {effort, true}, state.control);
    state.offer(answer.selected);
    if (!answer.is_complete || answer.selected) return;
    const auto strength = strength_of(answer.proof, state);
    if (!strength) return;
    state.raise(state.incumbent.bound() + 1, *strength);
  }
}

struct Cheapest {
  std::optional<Selection> selected;     ///< cheaper than the best known
  double lower_bound = 0;                ///< of the cost
  std::optional<BoundProof> proof = {};  ///< of that bound; nothing where there is none
};
Cheapest cheapest(const SearchState& state, std::size_t most_units, const Effort& effort, TreeSearch& tree) {
  const std::int64_t known = state.problem.cost_of(state.incumbent.selected());
  TreeGoal goal;
  goal.kind = TreeGoal::Kind::cheapest;
  goal.most_units = most_units;
  goal.most_cost = known - std::max<std::int64_t>(1, known >> 33);  // what rounding is, is not worth a search
  const TreeAnswer answer = tree.run(goal, {effort, true}, state.control);
  if (!answer.is_complete) return {answer.selected};
  // What costs more than `most_cost` units of cost, rounded for every column.
  const double rounding = static_cast<double>(most_units + 1) / 2;
  const double least = static_cast<double>(answer.proof.most_cost) + 1 - rounding;
  return {answer.selected, std::max(0.0, least * state.problem.cost_unit), strength_of(answer.proof, state)};
}

}  // namespace

void raise_bound_by_tree(SearchState& state, const Effort& effort) {
  if (!state.has_tree(state.incumbent.selected().size())) return;
  if (!state.is_weighted) return raise_count_bound(state, effort);
  const std::size_t most_units = state.bounds.affordable(state.incumbent.value());
  if (!state.has_tree(most_units)) return;
  const Cheapest found = cheapest(state, most_units, effort, *state.tree);
  state.offer(found.selected);
  if (found.proof) state.raise(found.lower_bound, *found.proof);
}

void search_second_by_tree(SearchState& state, const Effort& effort) {
  const Cheapest found = cheapest(state, state.incumbent.selected().size(), effort, *state.tree);
  state.offer_second(found.selected);
  if (found.proof) state.raise_second(found.lower_bound, *found.proof);
}

// Nothing dearer may win, but for what sums of prices such as 0.1 and 0.2 are off.
bool settle_ties(SearchState& state, const Selection& start) {
  const SearchProblem& problem = state.problem;
  const std::size_t most_units = state.is_weighted ? state.bounds.affordable(state.incumbent.value())
                                                   : state.incumbent.selected().size();
  if (!state.has_tree(most_units) || state.out_of_time()) return false;
  TreeGoal goal;
  goal.kind = TreeGoal::Kind::widest;
  goal.most_units = most_units;
  constexpr int bits_of_rounding = 40;  // 1e-12 of it
  if (problem.has_costs) {
    goal.most_cost = problem.cost_of(state.incumbent.selected());
    goal.most_cost += goal.most_cost >> bits_of_rounding;
  }
  if (start.size() <= most_units && problem.cost_of(start) <= goal.most_cost) goal.start = start;
  TreeSearch::Limits limits;
  constexpr std::uint64_t most_work = 2'000'000'000;  // some tenths of a second
  limits.work = most_work;
  limits.effort.until = Deadline(0.5 * state.deadline.seconds_left()).end();
  TreeSearch tree(problem, *state.matrix);
  const TreeAnswer answer = tree.run(goal, limits, state.control);
  if (answer.selected) state.incumbent.accept(*answer.selected);
  return answer.is_complete;
}

}  // namespace shelfbeam::detail
