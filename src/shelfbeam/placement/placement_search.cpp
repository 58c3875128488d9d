#include "shelfbeam/placement/placement_search.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/placement/answer/search_step.hpp"
#include "shelfbeam/placement/heuristic/searches.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/search_state.hpp"

namespace shelfbeam::detail {

namespace {

using State = const SearchState&;

// Covers that are searched without a dense matrix.
constexpr auto is_sparse = [](State state) {
  return state.instance.is_cover() && (state.instance.is_weighted() || !state.is_small());
};

// `steps` are moves of the weighted local search; moves of the other walks take less time. Weighted exchanges
// suit signals of 0 and 1 better than annealing, because most exchanges of units leave their lack as it is.
void improve(SearchState& state, const Effort& effort) {
  const auto with_moves = [&](std::uint64_t of_one) {
    return Effort{std::min(effort.steps, any_steps / of_one) * of_one, effort.until};
  };
  const Selection& best = state.incumbent.selected();
  if (is_sparse(state))
    state.offer(
        cover_search(state.instance, state.reduction(), best, with_moves(10), state.seed, state.control));
  else if (state.matrix && can_anneal(state.instance.problem) && state.instance.is_cooperative())
    state.offer(anneal(state.instance, *state.matrix, best, with_moves(state.is_small() ? 10 : 40),
                       state.seed, state.control));
  else if (state.matrix)
    state.offer(local_search(state.instance, *state.matrix, best, effort, state.seed, state.control));
  state.seed += walks_at_once;  // the same seed would repeat the same walk
}

// Conditions of the steps.
constexpr auto always = [](State) { return true; };
constexpr auto is_small = [](State state) { return state.is_small(); };
constexpr auto is_large = [](State state) { return !state.is_small(); };
constexpr auto is_small_whole = [](State state) { return state.is_small() && !state.instance.is_cover(); };
constexpr auto is_large_or_cover = [](State state) { return !state.is_small() || state.instance.is_cover(); };
// Relaxations say little, as for Steiner triples: MIP solvers know better cuts than `branch_and_bound`.
constexpr auto asks_mip_first = [](State state) {
  constexpr double wide = 1.5;
  return state.instance.is_cover() && !state.is_small() && state.may_ask_mip() &&
         state.incumbent.value() > wide * state.incumbent.bound();
};
constexpr auto may_branch = [](State state) { return state.instance.is_cover() && !asks_mip_first(state); };
// Better selections exclude more columns, which pays if many are left.
constexpr auto has_many_left = [](State state) {
  constexpr std::size_t many = 1000;
  return state.instance.is_cover() && state.instance.columns() - state.useless.size() > many;
};
// Covers of many units that are counted, as in a hall: neighbouring units overlap, distant ones do not.
constexpr auto may_have_windows = [](State state) {
  constexpr std::size_t enough = 200;
  return state.instance.is_cover() && !state.instance.is_weighted() && !state.is_small() &&
         state.instance.columns() - state.useless.size() >= enough;
};
constexpr auto may_improve_again = [](State state) {
  return !has_many_left(state) && !asks_mip_first(state);
};
constexpr auto has_tree = [](State state) { return state.has_tree(state.incumbent.selected().size()); };
// Tree searches of more units hardly ever end.
constexpr auto has_few_units = [](State state) {
  constexpr std::size_t few = 14;
  return state.is_small() || (has_tree(state) && state.incumbent.selected().size() < few);
};
constexpr auto is_large_whole_of_few = [](State state) {
  return !state.is_small() && !state.instance.is_cover() && has_few_units(state);
};
// Sums of many units: tree searches do not end, and the whole is too large for a MIP.
constexpr auto may_have_window_mips = [](State state) {
  return has_tree(state) && !has_few_units(state) && !state.instance.is_cover() &&
         !state.instance.is_weighted() && !state.instance.problem.redundant &&
         state.options.uses(SolverChoice::mip) && !state.fits_mip();
};
constexpr auto fits_mip = [](State state) { return state.fits_mip(); };
constexpr auto has_bounds_alone = [](State state) { return !has_tree(state) && !state.may_ask_mip(); };
constexpr auto has_more_than_bounds = [](State state) { return !has_bounds_alone(state); };

// The first local search: short if it gains little or moves are cheap.
constexpr auto gains_little = [](State state) { return is_sparse(state) && state.instance.is_weighted(); };
constexpr auto has_cheap_moves = [](State state) {
  return !gains_little(state) && (is_sparse(state) || state.is_small());
};
constexpr auto gains_much = [](State state) { return !gains_little(state) && !has_cheap_moves(state); };
constexpr Step<SearchState> opening[] = {
    {"local search", gains_little, 1, improve, 100},
    {"local search", has_cheap_moves, 1, improve, 1'000},
    {"local search", gains_much, 1, improve, 20'000},
};

// The schedule until the gap is closed (docs/methods/placement.md, "The search"). Small: a tree search may
// end within seconds. Cover: the reductions apply; other problems are searched whole.
constexpr Step<SearchState> schedule[] = {
    // name, condition, share of the time left, function, maximum steps, maximum seconds
    {"short tree search", is_small, 0.2, raise_bound_by_tree, 15'000},
    {"multipliers", always, 0.2, raise_bound_by_multipliers},
    {"linear programs", has_more_than_bounds, 0.5, raise_bound_by_lp},
    {"linear programs only", has_bounds_alone, 0.7, raise_bound_by_lp},
    {"longer tree search", is_small_whole, 0.3, raise_bound_by_tree, 5'000'000},
    {"more local search", has_many_left, 0.2, improve, 200'000, 20},
    // Branch and bound gives up at once if it cannot end in time; windows do not know when they will end.
    {"short branch and bound", may_have_windows, 0.15, branch_on_remainder},
    {"windows", may_have_windows, 0.75, raise_bound_by_windows},
    {"short branch and bound", asks_mip_first, 0.15, branch_on_remainder, any_steps, 2},
    {"branch and bound", may_branch, 0.8, branch_on_remainder},
    {"more local search", may_improve_again, 0.2, improve, 200'000, 20},
    // MIP solvers suit reduced covers of many units; tree searches do not.
    {"tree search", is_small, 0.6, raise_bound_by_tree},
    {"tree search", is_large_whole_of_few, 0.35, raise_bound_by_tree},
    {"windows by MIPs", may_have_window_mips, 0.9, raise_bound_by_window_mips},
    {"MIP", is_large_or_cover, 0.9, solve_mip},
    {"final tree search", has_few_units, 1, raise_bound_by_tree},
    {"final local search", always, 1, improve},
};

// The schedule of the second objective, once the minimum count is known.
constexpr Step<SearchState> second_schedule[] = {
    {"second objective, multipliers", is_large, 0.2, bound_second_by_multipliers},
    {"second objective, linear program", is_large, 0.3, bound_second_by_lp},
    {"second objective, tree", has_tree, 0.6, search_second_by_tree},
    {"second objective, MIP", fits_mip, 1, solve_mip_for_second},
};

// A MIP back end alone.
constexpr Step<SearchState> solver_schedule[] = {{"MIP", always, 1, solve_mip_alone}};
constexpr Step<SearchState> second_solver_schedule[] = {
    {"second objective, MIP", always, 1, solve_mip_for_second}};

// A MIP back end solves the whole problem: the options ask for it, or no selection is known and the model is
// small enough.
bool asks_solver_alone(State state) {
  return !state.searches && state.options.uses(SolverChoice::mip) &&
         (state.options.solver == SolverChoice::mip ||
          state.instance.table.entries.size() <= state.limits.max_model_entries);
}

Placement answer_of(State state) {
  const Instance& instance = state.instance;
  if (!state.incumbent.has_selection() && state.incumbent.is_closed()) return infeasible_placement();
  Placement placement;
  placement.selected = state.incumbent.selected();
  const bool is_second = state.second && state.incumbent.has_selection();
  placement.objective_value =
      is_second ? instance.second_value_of(placement.selected) : state.incumbent.value();
  placement.lower_bound = std::min(state.bound(), placement.objective_value);
  placement.count_lower_bound =
      instance.is_weighted() ? static_cast<double>(std::max(instance.trivial_count_bound(),
                                                            instance.bounds.fewest(placement.lower_bound)))
                             : state.incumbent.bound();
  return placement;
}

Placement search(SearchState& state, const PlacementProblem& problem) {
  const bool asks_solver = asks_solver_alone(state);
  std::span<const Step<SearchState>> first, second;
  if (asks_solver)
    first = solver_schedule, second = second_solver_schedule;
  else if (state.searches && state.options.proves)
    first = schedule, second = second_schedule;
  if (state.searches) run_steps(opening, state);
  const Selection of_opening = state.incumbent.selected();
  state.report_state();
  run_steps(first, state);
  if (!state.instance.is_weighted() && state.instance.problem.objective != Objective::count &&
      state.incumbent.bound() < milp::infinity) {
    const CostBounds& bounds = state.instance.second_bounds;
    const Selection& best = state.incumbent.selected();
    state.second.emplace(bounds, bounds.cheapest(static_cast<std::size_t>(state.incumbent.bound())));
    if (state.incumbent.has_selection()) state.second->replace(best, state.instance.second_value_of(best));
    if (state.incumbent.is_closed()) run_steps(second, state);
  }
  const bool is_optimal = (state.searches || asks_solver) && state.is_settled();
  const bool settled =
      is_optimal && state.searches && state.options.settles_ties && settle_ties(state, problem, of_opening);
  Placement placement = answer_of(state);
  if (placement.has_selection()) placement.status = is_optimal ? Status::optimal : Status::stopped;
  placement.ties_settled = settled;
  placement.bound_proof = state.incumbent.proof();
  const bool is_greedy = state.options.solver == SolverChoice::greedy;
  placement.solver = {asks_solver ? Method::mip
                      : is_greedy ? Method::greedy
                                  : Method::search,
                      state.last_backend};
  placement.steps = std::move(state.steps);
  return placement;
}

}  // namespace

std::optional<Selection> first_selection(const Instance& instance, const Selection& start,
                                         double time_limit_s, std::uint64_t seed, const RunControl& control) {
  if (instance.rows() * instance.columns() > SearchLimits{}.max_cells_of_local_search) return std::nullopt;
  const SearchMatrix matrix(instance);
  const auto own_seed = static_cast<std::uint32_t>(mix_key(seed, 1));
  const auto found =
      local_search(instance, matrix, start, {5000, Deadline(time_limit_s).end()}, own_seed, control);
  return found && instance.check(*found).met() ? found : std::nullopt;
}

Placement search_placement(const Instance& instance, const std::optional<Selection>& start,
                           std::span<const milp::Backend> backends, const PlaceOptions& options,
                           const Deadline& deadline, const RunControl& control, const SearchLimits& limits) {
  const auto search_for = [&](const Instance& own) {
    SearchState state(own, start, backends, options, deadline, control, limits);
    return search(state, instance.problem);
  };
  const auto answer = [&](const Instance& priced) {
    if (!priced.has_covers_of_sums) return search_for(priced);
    const auto needs_rule = [](const SignalTable::Label& label) {
      return label.single_requirement != label.requirement;
    };
    PlacementProblem alone = instance.problem;
    alone.model = CommunicationModel::non_cooperative;
    if (std::ranges::none_of(priced.table.labels, needs_rule)) return search_for({priced.table, alone});
    SignalTable cover = priced.table;
    for (SignalTable::Label& label : cover.labels) label.single_requirement = label.requirement;
    return search_for({cover, alone});
  };
  if (!start || !options.uses(SolverChoice::search)) return search_for(instance);
  const Check known = instance.check(*start);
  const double max_cost = 2 * (known.objective + known.transceiver_cost);
  const auto is_too_expensive = [&](const SignalTable::Transceiver& unit) { return unit.cost > max_cost; };
  if (instance.problem.combination == Combination::lexicographic || !(max_cost > 0) ||
      std::ranges::none_of(instance.table.transceivers, is_too_expensive))
    return answer(instance);
  // No selection as good as the known one contains a more expensive unit. Capping such prices keeps the other
  // prices from vanishing in the rounding.
  SignalTable cheaper = instance.table;
  for (auto& unit : cheaper.transceivers) unit.cost = std::min(unit.cost, max_cost);
  return answer({cheaper, instance.problem});
}

}  // namespace shelfbeam::detail
