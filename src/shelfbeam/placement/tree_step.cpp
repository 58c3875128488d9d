#include "shelfbeam/placement/tree_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "shelfbeam/placement/tree/proof.hpp"

namespace shelfbeam::detail {

TreeStep::TreeStep(SearchState& state) : state_(state) {
  if (state.has_tree(0)) tree_.emplace(state.problem, *state.matrix);
}

void TreeStep::begin_with(const LpBound& lp) {
  std::vector<std::uint32_t> rows;
  std::vector<double> weights;
  for (std::size_t k = 0; k < lp.rows.size(); ++k) {
    if (!lp.rows[k].is_plain()) continue;
    rows.push_back(lp.rows[k].label);
    weights.push_back(lp.y[k]);
  }
  if (tree_ && !rows.empty()) tree_->begin_with(rows, weights);
}

void TreeStep::raise_bound(const Effort& effort) {
  if (!state_.has_tree(state_.incumbent.selected().size())) return;
  if (state_.is_weighted)
    raise_cost_bound(effort);
  else
    raise_count_bound(effort);
}

void TreeStep::raise_count_bound(const Effort& effort) {
  while (!state_.incumbent.is_closed() && !effort.is_over(state_.control)) {
    TreeGoal goal;
    goal.most_units = static_cast<std::size_t>(std::llround(state_.incumbent.bound()));
    const TreeAnswer answer = tree_->run(goal, {effort, true}, state_.control);
    state_.offer(answer.selected);
    if (!answer.is_complete || answer.selected) return;
    const auto strength = strength_of(answer.proof);
    if (!strength) return;
    state_.raise(state_.incumbent.bound() + 1, *strength);
  }
}

void TreeStep::raise_cost_bound(const Effort& effort) {
  const std::size_t most_units = state_.bounds.affordable(state_.incumbent.value());
  if (!state_.has_tree(most_units)) return;
  const Cheapest found = cheaper(most_units, effort);
  state_.offer(found.selected);
  if (found.proof) state_.raise(found.cost_lower_bound, *found.proof);
}

TreeStep::Cheapest TreeStep::cheapest(const Effort& effort) {
  return cheaper(state_.incumbent.selected().size(), effort);
}

TreeStep::Cheapest TreeStep::cheaper(std::size_t most_units, const Effort& effort) {
  const std::int64_t known = state_.problem.cost_of(state_.incumbent.selected());
  TreeGoal goal;
  goal.kind = TreeGoal::Kind::cheapest;
  goal.most_units = most_units;
  goal.most_cost = known - std::max<std::int64_t>(1, known >> 33);  // what rounding is, is not worth a search
  const TreeAnswer answer = tree_->run(goal, {effort, true}, state_.control);
  Cheapest found{answer.selected, 0, std::nullopt};
  if (!answer.is_complete) return found;
  found.cost_lower_bound = cost_lower_bound(answer.proof.most_cost, most_units);
  found.proof = strength_of(answer.proof);
  return found;
}

// What costs more than `most` units of cost, rounded for every column.
double TreeStep::cost_lower_bound(std::int64_t most, std::size_t units) const {
  const double rounding = static_cast<double>(units + 1) / 2;
  return std::max(0.0, (static_cast<double>(most) + 1 - rounding) * state_.problem.cost_unit);
}

// What an exhausted tree proves, once its log has been examined.
std::optional<BoundProof> TreeStep::strength_of(const Proof& proof) const {
  if (proof.steps.size() > state_.limits.most_checked_steps) return BoundProof::search;
  switch (judge_proof(state_.table, state_.question, proof, {state_.deadline.end(), state_.control})) {
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

// Nothing dearer may win, but for what sums of prices such as 0.1 and 0.2 are off.
bool TreeStep::settle_ties(const Selection& start) {
  const SearchProblem& problem = state_.problem;
  const std::size_t most_units = state_.is_weighted ? state_.bounds.affordable(state_.incumbent.value())
                                                    : state_.incumbent.selected().size();
  if (!state_.has_tree(most_units) || state_.out_of_time()) return false;
  TreeGoal goal;
  goal.kind = TreeGoal::Kind::widest;
  goal.most_units = most_units;
  constexpr int bits_of_rounding = 40;  // 1e-12 of it
  if (problem.has_costs) {
    goal.most_cost = problem.cost_of(state_.incumbent.selected());
    goal.most_cost += goal.most_cost >> bits_of_rounding;
  }
  if (start.size() <= most_units && problem.cost_of(start) <= goal.most_cost) goal.start = start;
  TreeSearch::Limits limits;
  constexpr std::uint64_t most_work = 2'000'000'000;  // some tenths of a second
  limits.work = most_work;
  limits.effort.until = Deadline(0.5 * state_.deadline.seconds_left()).end();
  TreeSearch tree(problem, *state_.matrix);
  const TreeAnswer answer = tree.run(goal, limits, state_.control);
  if (answer.selected) state_.incumbent.accept(*answer.selected);
  return answer.is_complete;
}

}  // namespace shelfbeam::detail
