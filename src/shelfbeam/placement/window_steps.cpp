#include <vector>

#include "shelfbeam/placement/search_state.hpp"
#include "shelfbeam/placement/windows/window_bound.hpp"

namespace shelfbeam::detail {

void raise_bound_by_windows(SearchState& state, const Effort& effort) {
  if (state.relaxation) state.exclude(*state.relaxation);  // the incumbent may be better than at that time
  const Reduction& reduction = state.reduction();
  if (reduction.infeasible || state.solvers.preferred.empty()) return;
  constexpr std::size_t units_per_window = 5;
  WindowBoundOptions options;
  options.known = state.incumbent.value();
  options.step = state.bounds.step();
  options.max_work = effort.steps;
  options.until = effort.until;
  options.windows = state.incumbent.selected().size() / units_per_window;
  const auto heuristic = [&](const Selection& selected) {
    state.offer(selected);
    return state.incumbent.value();
  };
  const WindowBound found = window_bound(state.table, state.problem, state.first_cost, reduction, options,
                                         clp_first(state).front(), heuristic, state.control);
  state.exclude(found.useless);
  state.raise_open(found.bound, BoundProof::branches);
}

}  // namespace shelfbeam::detail
