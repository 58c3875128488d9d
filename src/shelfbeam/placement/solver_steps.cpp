#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "shelfbeam/milp/branching.hpp"
#include "shelfbeam/placement/mip/cover_model.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/problem/cover_rows.hpp"
#include "shelfbeam/placement/search_state.hpp"

namespace shelfbeam::detail {

namespace {

using Answer = CoverModel::Outcome;

// Runs the back ends in order until one does not fail.
template <class Ask>
auto ask_in_turn(SearchState& state, std::span<const milp::Backend> backends, const Ask& ask) {
  for (std::size_t k = 0;; ++k) {
    state.last_backend = backends[k].full_name();
    auto answer = ask(backends[k]);
    if (!answer.failed || k + 1 == backends.size()) return answer;
  }
}

void begin_tree_with(const LpBound& lp, SearchState& state) {
  std::vector<LabelId> rows;
  std::vector<double> weights;
  for (std::size_t k = 0; k < lp.rows.size(); ++k) {
    if (!lp.rows[k].is_plain()) continue;
    rows.push_back(lp.rows[k].label);
    weights.push_back(lp.y[k]);
  }
  if (state.tree && !rows.empty()) state.tree->begin_with(rows, weights);
}

// The part as a table; transceivers have the given costs.
SignalTable table_of(const Instance& instance, std::span<const double> cost, const CoverPart& part,
                     const std::vector<bool>& is_out, std::vector<ColumnId>& columns) {
  SignalTable own;
  std::vector<std::uint32_t> place(instance.columns(), ~std::uint32_t{0});
  for (const ColumnId j : part.columns) {
    if (is_out[j]) continue;
    place[j] = static_cast<std::uint32_t>(own.transceivers.size());
    columns.push_back(j);
    own.transceivers.push_back(instance.table.transceivers[j]);
    own.transceivers.back().cost = cost[j];
    own.transceivers.back().installed = false;
  }
  for (const auto& mount : instance.table.mounts) {
    std::vector<ColumnId> options;
    for (const ColumnId j : mount)
      if (place[j] < own.columns()) options.push_back(place[j]);
    if (options.size() > 1) own.mounts.push_back(std::move(options));
  }
  for (const auto& [a, b] : instance.table.conflicts)
    if (place[a] < own.columns() && place[b] < own.columns()) own.conflicts.emplace_back(place[a], place[b]);
  own.row_begin = {0};
  for (const LabelId i : part.labels) {
    own.labels.push_back(instance.table.labels[i]);
    for (const SignalEntry& entry : instance.row(i))
      if (place[entry.transceiver] < own.columns())
        own.entries.push_back({place[entry.transceiver], entry.signal});
    own.row_begin.push_back(own.entries.size());
  }
  return own;
}

// Solves the remainder of a cover part by part for a selection of cost up to `cutoff`. The bound is that of
// selections of the remainder, and at most just above the cut-off. `selected` is not checked yet.
Answer place_reduced(const Instance& instance, std::span<const double> cost, const Reduction& reduction,
                     double cutoff, const milp::SolveFunction& solve, const Effort& effort,
                     const RunControl& control) {
  Answer answer;
  Selection selected = reduction.forced;
  answer.bound = 0;
  for (const ColumnId j : reduction.forced) answer.bound += cost[j];
  bool is_whole = true;
  const std::vector<bool> blocked = blocked_columns(instance, reduction);
  for (const CoverPart& part : reduction.parts) {
    if (part.labels.empty()) continue;
    std::vector<ColumnId> columns;
    const SignalTable own = table_of(instance, cost, part, blocked, columns);
    const PlacementProblem sum{.model = instance.problem.model, .combination = Combination::weighted};
    // The other parts cost at least their bounds so far, and at least nothing.
    const Instance own_instance(own, sum);
    CoverModel model(own_instance, solve, effort, control, {.cutoff = cutoff - answer.bound});
    const Answer best = model.minimise({.cost = own_instance.first_cost});
    answer.failed = answer.failed || best.failed;
    if (best.infeasible) {
      answer.bound = milp::infinity;
      return answer;
    }
    const CostBounds& bounds = own_instance.bounds;
    answer.bound += std::max(bounds.cheapest(1), bounds.rounded(best.bound));
    is_whole = is_whole && best.selected;
    if (best.selected)
      for (const ColumnId j : *best.selected) selected.push_back(columns[j]);
  }
  std::sort(selected.begin(), selected.end());
  if (is_whole) answer.selected = std::move(selected);
  return answer;
}

// Between the values of the incumbent and of any better selection.
double cutoff_of(const ValueSteps& bounds, double value) {
  return bounds.below(value) + (bounds.sees_steps(value) ? 0.5 * bounds.step() : 0);
}

// Branch and bound on the remainder of a cover, by the linear programs of Clp if it is built in.
Answer branch_reduced(SearchState& state, const Reduction& reduction, double cutoff, const Effort& effort) {
  const std::vector<milp::Backend> backends = clp_first(state);
  const milp::SolveFunction branch = [&](const milp::Model& model, const milp::SolveOptions& options,
                                         const RunControl& control) {
    return milp::branch_and_bound(model, backends.front(), options, control);
  };
  if (reduction.infeasible) return {std::nullopt, milp::infinity};
  constexpr std::uint64_t steps_per_node = 20;  // strong branching takes much longer than other steps
  Effort nodes = effort;
  if (state.options.step_limit) nodes.steps = 1 + *state.options.step_limit / steps_per_node;
  return place_reduced(state.instance, state.instance.first_cost, reduction, cutoff, branch, nodes,
                       state.control);
}

// Raises the bound by proofs that no selection costs little more: their trees are small, because reduced
// costs exclude most columns.
void raise_bound_by_cutoffs(SearchState& state, const Effort& effort) {
  constexpr double min_part = 0.002, max_part = 0.02;
  double part = max_part;
  for (std::uint64_t tries = 0; tries < effort.steps && !state.is_settled(); ++tries) {
    const double bound = state.incumbent.bound(), gap = state.incumbent.value() - bound;
    const double min_increment =
        state.instance.bounds.step() > 0 ? 0.5 * state.instance.bounds.step() : min_part * gap;
    const double increment = std::max(min_increment, part * gap), cutoff = bound + increment;
    if (!(cutoff > bound) || effort.is_over(state.control)) return;
    const Answer answer = branch_reduced(state, state.reduction_below(cutoff), cutoff, effort);
    state.offer(answer.selected);
    if (answer.bound > cutoff)
      state.raise_open(cutoff, BoundProof::branches);
    else if (increment > min_increment)
      part /= 2;
    else
      return;
  }
}

Answer solve_reduced(SearchState& state, double cutoff, const Effort& effort) {
  return ask_in_turn(state, state.backends, [&](const milp::Backend& backend) {
    return place_reduced(state.instance, state.instance.first_cost, state.reduction(), cutoff, backend.solve,
                         effort, state.control);
  });
}

// The label rows and cuts of the last relaxation are part of the model, the cuts as further rows.
std::vector<milp::Row> cuts_of(const SearchState& state) {
  std::vector<milp::Row> cuts;
  const CoverRows cover(state.instance, state.max_better_count());
  for (const BoundRow& row : state.rows) {
    if (row.is_plain()) continue;
    milp::Row& cut = cuts.emplace_back();
    cut.lower = cover.read(row, [&](std::uint32_t j, double a) { cut.entries.push_back({j, a}); });
    if (cut.lower > 0)
      cut = relaxed(std::move(cut));
    else
      cuts.pop_back();  // every selection satisfies it
  }
  return cuts;
}

// Asks for the whole model. A bound above the value of `known` is wrong.
Answer ask_whole(SearchState& state, const Incumbent& known, const MipGoal& goal,
                 const MipKnowledge& knowledge, const Effort& effort) {
  return ask_in_turn(state, state.backends, [&](const milp::Backend& backend) {
    CoverModel model(state.instance, backend.solve, effort, state.control, knowledge);
    Answer answer = model.minimise(goal);
    answer.failed = answer.failed || known.contradicts(answer.bound);
    return answer;
  });
}

}  // namespace

std::vector<milp::Backend> clp_first(const SearchState& state) {
  std::vector<milp::Backend> backends(state.backends.begin(), state.backends.end());
  std::stable_partition(backends.begin(), backends.end(),
                        [](const milp::Backend& own) { return own.name == "cbc"; });
  return backends;
}

void raise_bound_by_lp(SearchState& state, const Effort& effort) {
  const SelectionSet open = state.open_selections();
  if (state.instance.is_cover() && state.reduction().infeasible)
    return state.raise_open(milp::infinity, BoundProof::dual);
  const bool is_large = state.instance.table.entries.size() > state.limits.max_small_lp_entries;
  const std::vector<milp::Backend> by_clp = is_large ? clp_first(state) : std::vector<milp::Backend>();
  const LpBoundOptions options{.effort = effort, .selections = open, .rows = state.rows};
  const auto ask = [&](const milp::Backend& backend) {
    LpBound lp;
    if (state.instance.is_weighted()) {
      lp = lp_bound(state.instance, state.instance.first_cost, backend, options, state.control);
      state.raise_open(lp.dual.bound, BoundProof::dual);
    } else {
      CountBound count = count_bound(state.instance, backend, options, state.control);
      state.raise_open(static_cast<double>(count.count), BoundProof::dual);
      lp = std::move(count.relaxation);
    }
    lp.failed = lp.failed && !state.out_of_time();
    return lp;
  };
  // Clp is faster than HiGHS on large linear programs.
  const LpBound lp = ask_in_turn(state, is_large ? by_clp : state.backends, ask);
  state.exclude(lp.dual);
  state.relaxation = lp.dual;
  if (!lp.rows.empty()) state.rows = lp.rows;
  begin_tree_with(lp, state);
}

void branch_on_remainder(SearchState& state, const Effort& effort) {
  if (state.relaxation) state.exclude(*state.relaxation);  // the incumbent may be better than at that time
  const Answer answer =
      branch_reduced(state, state.reduction(), state.instance.bounds.below(state.incumbent.value()), effort);
  state.offer(answer.selected);
  state.raise_open(answer.bound, BoundProof::branches);
  if (!state.is_settled())
    raise_bound_by_cutoffs(state, {effort.steps, Deadline(0.4 * effort.seconds_left()).end()});
}

void solve_mip(SearchState& state, const Effort& effort) {
  if (!state.may_ask_mip()) return;
  const double cutoff = cutoff_of(state.instance.bounds, state.incumbent.value());
  const Answer answer = state.instance.is_cover()
                            ? solve_reduced(state, cutoff, effort)
                            : ask_whole(state, state.incumbent, {.cost = state.instance.first_cost},
                                        {cutoff, state.useless, cuts_of(state)}, effort);
  state.offer(answer.selected);
  state.raise_open(answer.infeasible ? milp::infinity : answer.bound, BoundProof::solver);
}

void solve_mip_alone(SearchState& state, const Effort& effort) {
  const MipGoal goal{.cost = state.instance.first_cost, .known = state.incumbent.value()};
  const Answer answer = ask_whole(state, state.incumbent, goal, {}, effort);
  state.offer(answer.selected);
  state.raise(answer.infeasible ? milp::infinity : answer.bound, BoundProof::solver);
}

void bound_second_by_lp(SearchState& state, const Effort& effort) {
  const std::size_t count = state.incumbent.selected().size();
  const LpBound lp = lp_bound(state.instance, state.instance.second_cost, state.backends.front(),
                              {.effort = effort, .selections = {count, count}}, state.control);
  state.raise_second(lp.dual.bound, BoundProof::dual);
  begin_tree_with(lp, state);
}

void solve_mip_for_second(SearchState& state, const Effort& effort) {
  const Selection& best = state.incumbent.selected();
  const Incumbent& second = *state.second;
  const MipGoal goal{state.instance.second_cost, state.instance.check(best).objective, best.size(),
                     best.size()};
  const double cutoff = state.searches ? cutoff_of(second.steps(), second.value()) : milp::infinity;
  const Answer answer = ask_whole(state, second, goal, {.cutoff = cutoff}, effort);
  state.offer_second(answer.selected);
  state.raise_second(answer.bound, BoundProof::solver);
}

}  // namespace shelfbeam::detail
