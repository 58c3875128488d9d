#include "shelfbeam/placement/placement_search.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/placement/heuristic/annealing.hpp"
#include "shelfbeam/placement/heuristic/cover_search.hpp"
#include "shelfbeam/placement/heuristic/local_search.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/search_state.hpp"
#include "shelfbeam/placement/secondary_objective.hpp"
#include "shelfbeam/placement/solver_step.hpp"
#include "shelfbeam/placement/tree_step.hpp"

namespace shelfbeam::detail {

namespace {

class ExactSolver {
 public:
  ExactSolver(const SignalTable& table, const Question& question, const Selection& start,
              const Solvers& solvers, double time_limit_s, const SearchLimits& limits, std::uint64_t seed,
              const RunControl& control)
      : state_(table, question, start, solvers, time_limit_s, limits, control),
        trees_(state_),
        solvers_(state_),
        seed_(static_cast<std::uint32_t>(mix_key(seed, 0))) {}

  Placement run() {
    if (!state_.out_of_time()) improve(opening());
    const Selection of_opening = incumbent_.selected();
    state_.report();
    run_schedule(*this, schedule(), state_);

    std::optional<SecondaryObjective> secondary;
    if (!state_.is_weighted && state_.question.objective != Objective::count) {
      secondary.emplace(state_, trees_, solvers_);
      if (is_closed()) secondary->optimise();
    }
    const bool is_optimal = is_closed() && (!secondary || secondary->is_closed());
    const bool settles = is_optimal && state_.limits.settles_ties;
    const bool settled = settles && trees_.settle_ties(of_opening);
    Placement placement = answer(secondary ? secondary->lower_bound() : incumbent_.bound());
    placement.status = is_optimal ? Status::optimal : Status::stopped;
    placement.ties_settled = settled;
    return placement;
  }

  bool is_closed() const { return incumbent_.is_closed(); }

 private:
  using Line = Step<ExactSolver>;
  static std::span<const Line> schedule();

  bool always() const { return true; }
  bool is_small() const { return state_.is_small(); }
  bool is_small_whole() const { return is_small() && !state_.is_cover(); }
  bool is_large_whole() const { return !is_small() && !state_.is_cover(); }
  bool is_large_cover() const { return !is_small() && state_.is_cover(); }
  bool is_large_or_cover() const { return !is_small() || state_.is_cover(); }
  bool has_bounds_alone() const {
    return !state_.has_tree(incumbent_.selected().size()) && !state_.may_ask_mip();
  }
  bool has_more_than_bounds() const { return !has_bounds_alone(); }
  bool is_plain() const { return is_plain_cover(state_.table, state_.question); }

  // Where little is to be gained by it, or moves are cheap, the opening is short.
  Effort opening() const {
    const std::uint64_t moves = is_plain() || is_small() ? 1'000 : 20'000;
    return {std::min(moves, state_.limits.step_limit.value_or(any_steps)), state_.deadline.end()};
  }

  // Walks count `steps` in moves of local search with weights; those of the others take less time.
  void improve(const Effort& effort) {
    const auto with_moves = [&](std::uint64_t of_one) {
      return Effort{std::min(effort.steps, any_steps / of_one) * of_one, effort.until};
    };
    const SearchProblem& problem = state_.problem;
    const Selection& best = incumbent_.selected();
    if (is_plain() && !is_small())
      state_.offer(cover_search(state_.table, state_.question, state_.reduction(), best, with_moves(10),
                                seed_, state_.control));
    else if (state_.matrix && can_anneal(state_.question))
      state_.offer(
          anneal(problem, *state_.matrix, best, with_moves(is_small() ? 10 : 40), seed_, state_.control));
    else if (state_.matrix)
      state_.offer(local_search(problem, *state_.matrix, best, effort, seed_, state_.control));
    seed_ += walks_at_once;  // from the same start the same numbers would lead the same way
  }

  void raise_bound_by_lp(const Effort& effort) { trees_.begin_with(solvers_.raise_bound(effort)); }
  void raise_bound_by_tree(const Effort& effort) { trees_.raise_bound(effort); }
  void ask_mip(const Effort& effort) { solvers_.ask_mip(effort); }

  Placement answer(double lower_bound) const {
    const SignalTable& table = state_.table;
    const Question& question = state_.question;
    Placement placement;
    placement.question = question;
    placement.unit_costs = label_costs(table, question.objective).unit;
    placement.selected = incumbent_.selected();
    placement.objective_value = state_.is_weighted || question.objective != Objective::count
                                    ? incumbent_.value_of(placement.selected)
                                    : static_cast<double>(placement.selected.size());
    placement.lower_bound = std::min(lower_bound, placement.objective_value);
    placement.count_lower_bound =
        state_.is_weighted ? static_cast<double>(std::max(least_count(table, question),
                                                          state_.bounds.fewest(placement.lower_bound)))
                           : incumbent_.bound();
    placement.bound_proof = incumbent_.proof();
    placement.solver = solvers_.asked().empty() ? "search" : "search with " + solvers_.asked();
    return placement;
  }

  SearchState state_;
  const Incumbent& incumbent_ = state_.incumbent;
  TreeStep trees_;
  SolverStep solvers_;
  std::uint32_t seed_;
};

// Until the gap is closed. A question is small where a tree may settle it within seconds; it is a cover where
// reductions apply, and searched as a whole where they do not.
std::span<const ExactSolver::Line> ExactSolver::schedule() {
  using S = ExactSolver;
  static constexpr Line lines[] = {
      // name, when it applies, share of the time left, most seconds, most steps, what is run
      {"first look by tree", &S::is_small, 0.2, no_limit_s, 15'000, &S::raise_bound_by_tree},
      {"linear programs", &S::has_more_than_bounds, 0.5, no_limit_s, any_steps, &S::raise_bound_by_lp},
      {"linear programs alone", &S::has_bounds_alone, 0.7, no_limit_s, any_steps, &S::raise_bound_by_lp},
      // What reductions leave is often little, and then nothing is as fast; nor is anything for small models.
      {"first look by MIP", &S::is_large_cover, 0.3, no_limit_s, any_steps, &S::ask_mip},
      {"first look by MIP", &S::is_large_whole, 0.15, 5, any_steps, &S::ask_mip},
      {"second look by tree", &S::is_small_whole, 0.3, no_limit_s, 5'000'000, &S::raise_bound_by_tree},
      {"more local search", &S::always, 0.2, 20, 200'000, &S::improve},
      // Covers of many units are what MIP solvers are good at, once they are reduced, and trees are not.
      {"tree", &S::is_small, 0.6, no_limit_s, any_steps, &S::raise_bound_by_tree},
      {"tree", &S::is_large_whole, 0.35, no_limit_s, any_steps, &S::raise_bound_by_tree},
      {"MIP", &S::is_large_or_cover, 0.9, no_limit_s, any_steps, &S::ask_mip},
      {"tree to the end", &S::always, 1, no_limit_s, any_steps, &S::raise_bound_by_tree},
      {"local search to the end", &S::always, 1, no_limit_s, any_steps, &S::improve},
  };
  return lines;
}

}  // namespace

std::optional<std::vector<std::uint32_t>> first_selection(const SignalTable& table, const Question& question,
                                                          const std::vector<std::uint32_t>& start,
                                                          double time_limit_s, std::uint64_t seed,
                                                          const RunControl& control,
                                                          const SearchLimits& limits) {
  if (table.rows() * table.columns() > limits.most_places_of_local_search) return std::nullopt;
  const SearchProblem problem(table, question);
  const SearchMatrix matrix(table, question.model);
  const auto own_seed = static_cast<std::uint32_t>(mix_key(seed, 1));
  const auto found =
      local_search(problem, matrix, start, {5000, Deadline(time_limit_s).end()}, own_seed, control);
  return found && check_selection(table, question, *found).met() ? found : std::nullopt;
}

Placement search_placement(const SignalTable& table, const Question& question,
                           const std::vector<std::uint32_t>& start, const Solvers& solvers,
                           double time_limit_s, std::uint64_t seed, const RunControl& control,
                           const SearchLimits& limits) {
  const auto answer = [&](const SignalTable& asked) {
    return ExactSolver(asked, question, start, solvers, time_limit_s, limits, seed, control).run();
  };
  const Check known = check_selection(table, question, start);
  const double most = 2 * (known.objective + known.transceiver_cost);
  const auto is_too_dear = [&](const SignalTable::Transceiver& unit) { return unit.cost > most; };
  if (question.combination == Combination::lexicographic || !(most > 0) ||
      std::none_of(table.transceivers.begin(), table.transceivers.end(), is_too_dear))
    return answer(table);
  // No answer as good as the known one has such a unit, at that price or less: so far off, it would only
  // drown the others' prices in its rounding.
  SignalTable cheaper = table;
  for (auto& unit : cheaper.transceivers) unit.cost = std::min(unit.cost, most);
  return answer(cheaper);
}

}  // namespace shelfbeam::detail
