#include "shelfbeam/placement/secondary_objective.hpp"

#include <cstddef>

namespace shelfbeam::detail {

std::span<const Step<SecondaryObjective>> SecondaryObjective::schedule() {
  using S = SecondaryObjective;
  static constexpr Step<S> lines[] = {
      // name, when it applies, share of the time left, most seconds, most steps, what is run
      {"second objective, linear program", &S::is_large, 0.3, no_limit_s, any_steps, &S::bound_by_lp},
      {"second objective, tree", &S::has_tree, 0.6, no_limit_s, any_steps, &S::search_tree},
      {"second objective, MIP", &S::fits_mip, 1, no_limit_s, any_steps, &S::ask_mip},
  };
  return lines;
}

SecondaryObjective::SecondaryObjective(SearchState& state, TreeStep& trees, SolverStep& solvers)
    : state_(state),
      trees_(trees),
      solvers_(solvers),
      cost_(objective_coefficients(state.table, state.question)),
      bounds_(state.table, cost_),
      value_(state.incumbent.value_of(state.incumbent.selected())),
      lower_bound_(bounds_.cheapest(static_cast<std::size_t>(state.incumbent.bound()))) {}

void SecondaryObjective::optimise() {
  run_schedule(*this, schedule(), state_);
}

void SecondaryObjective::bound_by_lp(const Effort& effort) {
  const LpBound lp = solvers_.bound_at_count(cost_, effort);
  raise(lp.dual.bound, BoundProof::dual);
  trees_.begin_with(lp);
}

void SecondaryObjective::search_tree(const Effort& effort) {
  const TreeStep::Cheapest found = trees_.cheapest(effort);
  take(found.selected);
  if (found.proof) raise(found.cost_lower_bound, *found.proof);
}

void SecondaryObjective::ask_mip(const Effort& effort) {
  const ReducedAnswer answer = solvers_.ask_mip_at_count(cost_, effort);
  take(answer.selected);
  raise(answer.bound, BoundProof::solver);
  if (!answer.proven) return;
  solver_closed_ = true;
  state_.incumbent.rest_on(BoundProof::solver);
}

void SecondaryObjective::take(const std::optional<Selection>& found) {
  if (!found || found->size() != state_.incumbent.selected().size()) return;
  const double other = state_.incumbent.value_of(*found);
  if (other < value_ && state_.incumbent.accept(*found)) value_ = other;
}

void SecondaryObjective::raise(double bound, BoundProof proof) {
  bound = bounds_.rounded(bound);
  if (!(bound > lower_bound_)) return;
  lower_bound_ = bound;
  state_.incumbent.rest_on(proof);
}

}  // namespace shelfbeam::detail
