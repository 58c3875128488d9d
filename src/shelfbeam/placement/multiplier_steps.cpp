#include <limits>
#include <utility>
#include <vector>

#include "shelfbeam/placement/bound/multiplier_bound.hpp"
#include "shelfbeam/placement/search_state.hpp"

namespace shelfbeam::detail {

namespace {

// A cover uses the labels of its remainder, other problems choose theirs.
std::vector<BoundRow> rows_of(SearchState& state) {
  std::vector<BoundRow> rows;
  if (state.instance.is_cover())
    for (const CoverPart& part : state.reduction().parts)
      for (const LabelId i : part.labels) rows.push_back({i});
  return rows;
}

}  // namespace

void raise_bound_by_multipliers(SearchState& state, const Effort& effort) {
  // Every exclusion shrinks the remainder of a cover, and the bound of the remainder is better.
  constexpr int max_rounds = 4;
  constexpr double enough = 0.8;
  for (int round = 0; round < max_rounds && !state.is_settled(); ++round) {
    const SelectionSet open = state.open_selections();
    if (state.instance.is_cover() && state.reduction().infeasible)
      return state.raise_open(std::numeric_limits<double>::infinity(), BoundProof::dual);
    const MultiplierBoundOptions options{.selections = open,
                                         .known = state.incumbent.value(),
                                         .step = state.instance.bounds.step(),
                                         .effort = effort,
                                         .rows = rows_of(state)};
    MultiplierBound found =
        multiplier_bound(state.instance, state.instance.first_cost, options, state.control);
    state.raise_open(found.dual.bound, BoundProof::dual);
    state.rows = std::move(found.rows);
    if (!state.exclude(found.dual) || !state.instance.is_cover() || effort.is_over(state.control)) return;
    const auto before = static_cast<double>(state.instance.columns() - open.without.size());
    const auto left = static_cast<double>(state.instance.columns() - state.open_selections().without.size());
    if (left > enough * before) return;
  }
}

void bound_second_by_multipliers(SearchState& state, const Effort& effort) {
  const std::size_t count = state.incumbent.selected().size();
  const Incumbent& second = *state.second;
  const MultiplierBoundOptions options{
      .selections = {count, count}, .known = second.value(), .step = second.steps().step(), .effort = effort};
  const MultiplierBound found =
      multiplier_bound(state.instance, state.instance.second_cost, options, state.control);
  state.raise_second(found.dual.bound, BoundProof::dual);
}

}  // namespace shelfbeam::detail
