#include <algorithm>
#include <cstdint>
#include <vector>

#include "shelfbeam/placement/search_state.hpp"
#include "shelfbeam/placement/windows/window_bound.hpp"
#include "shelfbeam/placement/windows/window_mips.hpp"

namespace shelfbeam::detail {

void raise_bound_by_windows(SearchState& state, const Effort& effort) {
  if (state.relaxation) state.exclude(*state.relaxation);  // the incumbent may be better than at that time
  const Reduction& reduction = state.reduction();
  if (reduction.infeasible) return;
  constexpr std::size_t units_per_window = 5;
  const WindowBoundOptions options{
      .known = state.incumbent.value(),
      .step = state.instance.bounds.step(),
      .effort = effort,
      .windows = std::max<std::size_t>(1, state.incumbent.selected().size() / units_per_window)};
  const auto heuristic = [&](const Selection& selected) {
    state.offer(selected);
    return state.incumbent.value();
  };
  const WindowBound found = window_bound(state.instance, state.instance.first_cost, reduction, options,
                                         clp_first(state).front(), heuristic, state.control);
  state.exclude(found.useless);
  state.raise_open(found.bound, BoundProof::branches);
}

void raise_bound_by_window_mips(SearchState& state, const Effort& effort) {
  constexpr std::size_t units_per_window = 6;
  constexpr double above = 1e-3;                 // of a step, more than rounding takes back
  constexpr std::uint64_t steps_per_node = 200;  // a node of a MIP takes much longer than a move of a walk
  const milp::Backend& backend = state.backends.front();
  state.last_backend = backend.full_name();
  while (!state.is_settled() && !effort.is_over(state.control)) {
    WindowMipOptions options{
        .goal = state.incumbent.bound() + above * state.instance.bounds.step(),
        .effort = {.until = effort.until},
        .windows = std::max<std::size_t>(1, state.incumbent.selected().size() / units_per_window),
        .without = state.useless,
        .rows = state.rows};
    if (state.options.step_limit) options.effort.steps = 1 + *state.options.step_limit / steps_per_node;
    std::erase_if(options.rows, [](const BoundRow& row) { return !row.is_plain(); });
    const double bound =
        window_mip_bound(state.instance, state.instance.first_cost, options, backend, state.control);
    state.raise_open(bound, BoundProof::solver);
    if (bound < options.goal) return;
  }
}

}  // namespace shelfbeam::detail
