#include "shelfbeam/placement/scenarios/place_over_scenarios.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/incumbent.hpp"
#include "shelfbeam/placement/answer/search_step.hpp"
#include "shelfbeam/placement/bound/lp_bound.hpp"
#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"
#include "shelfbeam/placement/problem/spend.hpp"
#include "shelfbeam/placement/scenarios/scenario_annealing.hpp"
#include "shelfbeam/placement/scenarios/scenario_cuts.hpp"
#include "shelfbeam/placement/scenarios/scenario_search.hpp"
#include "shelfbeam/placement/windows/window_mips.hpp"

namespace shelfbeam {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double least_step = 1e-6;  ///< of a bound on the count
// Parts of the time that is left.
constexpr double share_of_master = 0.1;  ///< one placement on cuts
constexpr double share_of_spread = 0.2;  ///< of the whole time limit
// Linear programs end if, at the progress of the last three, the next count would take more than this number
// of them; without and with a limit K.
constexpr double max_rounds = 10, max_rounds_limited = 40;
constexpr std::uint64_t first_moves = 50'000, max_moves = 20'000'000;  ///< of one annealing

/// Counts units, or the new spend.
std::vector<double> unit_costs(const SignalTable& table, const PlacementProblem& problem) {
  return problem.combination == Combination::spend ? prices_to_spend(table)
                                                   : std::vector<double>(table.columns(), 1);
}

class Solver {
 public:
  Solver(const ScenarioTable& scenarios, const PlacementProblem& problem, const MissAllowance& allowance,
         const PlaceOptions& options, std::optional<double> enough, const RunControl& control)
      : scenarios_(scenarios),
        problem_(problem),
        allowance_(allowance),
        options_(options),
        backend_(milp::backends_of(options.backend).front()),
        enough_(enough),
        control_(control),
        effort_(detail::for_seconds((enough ? 1 : 1 - share_of_spread) * options.time_limit_s)),
        end_(detail::for_seconds(options.time_limit_s)),
        cost_(unit_costs(scenarios.table, problem)),
        incumbent_(CostBounds(scenarios.table, cost_), 0),
        cuts_(scenarios, problem, allowance),
        search_(scenarios, problem, allowance, effort_, control),
        annealing_(scenarios, problem, allowance) {
    master_.model = CommunicationModel::cooperative;
    master_.redundant = false;
  }

  ScenarioPlacement run() {
    if (!is_possible()) {
      best_.lower_bound = unbounded;
      return std::move(best_);
    }
    run_schedule();
    best_.cuts = cuts_.size();
    effort_ = end_;
    // The first selection that fits the sampled scenarios overfits them.
    if (incumbent_.has_selection() && !is_over())
      detail::record_step(
          steps, "spread", [&] { return value(); }, [&] { return bound(); },
          [&] { take(annealing_.spread(incumbent_.selected(), effort_, control_)); });
    best_.steps = std::move(steps);
    best_.selected = incumbent_.selected();
    best_.value = incumbent_.value();
    best_.lower_bound = incumbent_.bound();
    if (incumbent_.has_selection()) best_.misses = misses_of(scenarios_, problem_, best_.selected);
    return std::move(best_);
  }

  // For run_steps.
  detail::Effort whole() const { return effort_; }
  bool is_settled() const { return incumbent_.is_closed() || (enough_ && incumbent_.bound() >= *enough_); }
  bool ends() const { return is_settled() || is_over(); }
  double value() const { return incumbent_.value(); }
  double bound() const { return incumbent_.bound(); }
  void after(const detail::Effort&) const { report(); }
  std::string_view step;
  std::vector<SearchStep> steps;

 private:
  using Effort = detail::Effort;
  /// Cuts for selections of at most `units` units.
  struct Limited {
    std::size_t units = 0;
    ScenarioCuts cuts;
    double bound = 0;  ///< of the linear program over these
  };

  void run_schedule() {
    using S = Solver;
    constexpr auto always = [](const S&) { return true; };
    constexpr auto bounds_alone = [](const S& s) { return s.enough_.has_value(); };
    constexpr auto selects = [](const S& s) { return !s.enough_; };
    constexpr auto selects_before_windows = [](const S& s) { return !s.enough_ && s.may_have_windows(); };
    constexpr auto windows_alone = [](const S& s) { return s.enough_ && s.may_have_windows(); };
    static constexpr detail::Step<S> schedule[] = {
        // name, condition, share of the time left, function, maximum steps, maximum seconds
        {"greedy", selects, 1, [](S& s, const Effort&) { s.start(); }},
        {"annealing", selects, 1, [](S& s, const Effort& e) { s.search_for_fewer(e); }},
        {"linear programs", selects, 0.4, [](S& s, const Effort& e) { s.relax(e); }},
        {"linear programs", bounds_alone, 1, [](S& s, const Effort& e) { s.relax(e); }},
        {"placements on cuts", always, 1,
         [](S& s, const Effort&) {
           while (!s.is_over() && !s.is_settled() && s.raise()) {
           }
         }},
        {"annealing", selects_before_windows, 0.3, [](S& s, const Effort& e) { s.anneal(e); }},
        {"windows by MIPs", selects_before_windows, 0.9,
         [](S& s, const Effort& e) { s.raise_by_windows(e); }},
        {"windows by MIPs", windows_alone, 1, [](S& s, const Effort& e) { s.raise_by_windows(e); }},
        {"annealing", selects, 1, [](S& s, const Effort& e) { s.anneal(e); }},
    };
    detail::run_steps(schedule, *this);
  }
  bool is_over() const { return effort_.is_over(control_); }

  void start() {
    first_ = options_.start;
    if (first_.empty()) first_ = greedy_selection({cuts_.table(), master_}, effort_, control_);
    if (auto repaired = search_.repaired(first_, unbounded)) first_ = std::move(*repaired);
    take(first_);
  }

  void relax(const Effort& effort) {
    raise_to(lp_bound(cuts_, scenarios_.table.columns(), unbounded, effort), BoundProof::dual);
    if (problem_.combination != Combination::spend) refute_counts(effort);
  }

  // No selection has at most K units if the bound of the linear program for these exceeds K. Raises the bound
  // until that fails; `limited_` are the cuts for the present bound then.
  void refute_counts(const Effort& effort) {
    while (incumbent_.bound() > 0 && !is_settled() && !effort.is_over(control_)) {
      const double enough = incumbent_.bound() + least_step;
      limited_.emplace(Limited{static_cast<std::size_t>(incumbent_.bound()), cuts_});
      limited_->bound = lp_bound(limited_->cuts, limited_->units, enough, effort);
      if (limited_->bound < enough) return;
      raise_to(incumbent_.bound() + 1, BoundProof::dual);
    }
  }

  // Windows gain up to a tenth.
  bool may_have_windows() const {
    constexpr double gain = 1.1;
    return options_.uses(SolverChoice::mip) && limited_ && !is_settled() &&
           incumbent_.bound() < gain * limited_->bound;
  }

  // The same as `refute_counts` by windows of the cuts.
  void raise_by_windows(const Effort& effort) {
    constexpr std::size_t units_per_window = 3;
    constexpr double above = 1e-3;  // more than rounding takes back
    while (may_have_windows() && !effort.is_over(control_)) {
      const std::size_t limit = limited_->units;
      if (static_cast<double>(limit) < incumbent_.bound()) {
        refute_counts(effort);
        continue;
      }
      const detail::WindowMipOptions options{.goal = static_cast<double>(limit) + above,
                                             .effort = effort,
                                             .windows = std::max<std::size_t>(1, limit / units_per_window)};
      if (detail::window_mip_bound({limited_->cuts.table(), master_}, cost_, options, backend_, control_) <
          options.goal)
        return;
      raise_to(static_cast<double>(limit + 1), BoundProof::solver);
      report();
    }
  }

  // The bound of the linear program over the cuts, to which violated ones are added, until it is `enough`.
  double lp_bound(ScenarioCuts& cuts, std::size_t max_units, double enough, const Effort& effort) {
    detail::LpBoundOptions options{.effort = effort, .enough = enough};
    options.selections.max_count = max_units;
    const bool counts = problem_.combination != Combination::spend;
    double bound = 0;
    std::array<double, 3> before{};  // the last bounds, the oldest first
    while (!effort.is_over(control_) && bound < enough) {
      std::shift_left(before.begin(), before.end(), 1);
      before.back() = bound;
      const detail::LpBound found =
          detail::lp_bound({cuts.table(), master_}, cost_, backend_, options, control_);
      bound = std::max(bound, found.dual.bound);
      control_.report(Task::placing_over_states, -1, fmt::format("at least {:.3g}", bound));
      options.rows = detail::rows_of(found);
      const double next = std::min(enough, std::ceil(bound - least_step) + least_step);
      const double rounds = max_units < cost_.size() ? max_rounds_limited : max_rounds;
      const double progress = (bound - before.front()) / static_cast<double>(before.size());
      if (counts && !enough_ && next - bound > rounds * progress) break;
      if (!found.complete || bound >= enough || cuts.add_violated(found.x, max_units, effort, control_) == 0)
        break;
    }
    return bound;
  }

  // Solves the cuts. Returns whether new ones may raise the bound. If these were not solved in time,
  // annealing uses the rest of it better.
  bool raise() {
    PlaceOptions own = options_;
    own.time_limit_s = std::min(std::max(1.0, share_of_master * effort_.seconds_left()), end_.seconds_left());
    own.settles_ties = false;
    own.start.clear();
    const Placement placement = place(cuts_.table(), master_, own, control_);
    ++best_.calls;
    const double bound = placement.status == Status::infeasible       ? unbounded
                         : problem_.combination == Combination::spend ? placement.lower_bound
                                                                      : placement.count_lower_bound;
    if (incumbent_.contradicts(bound)) return false;
    raise_to(bound, std::max(placement.bound_proof, BoundProof::dual));
    if (!placement.has_selection()) return false;
    const std::size_t added =
        cuts_.add(placement.selected, misses_of(scenarios_, problem_, placement.selected));
    if (!enough_) improve(placement.selected);
    report();
    return added > 0 && (placement.status == Status::optimal || enough_);
  }

  // A solver that contradicts a checked selection is wrong.
  void raise_to(double bound, BoundProof proof) {
    if (!incumbent_.contradicts(bound)) incumbent_.raise(bound, proof, step);
  }

  void anneal(const Effort& effort) {
    for (; !effort.is_over(control_) && !is_settled() && annealing_.can_exchange(known());
         moves_ = std::min(max_moves, 2 * moves_))
      search_for_fewer(effort);
  }

  const Selection& known() const { return incumbent_.has_selection() ? incumbent_.selected() : first_; }

  void improve(const Selection& selected) {
    if (const auto repaired = search_.repaired(selected, incumbent_.value())) take(*repaired);
    search_for_fewer(effort_);
  }

  void search_for_fewer(const Effort& effort) {
    while (!is_settled() && !effort.is_over(control_)) {
      const auto fewer = annealing_.next(known(), 1, {moves_, effort.until}, control_);
      if (!fewer) return;
      take(*fewer);
    }
  }

  void take(const Selection& selected) {
    const double value = scenario_value(scenarios_, problem_, selected);
    if (value > incumbent_.value() || allowance_.excess(misses_of(scenarios_, problem_, selected)) > 0)
      return;
    incumbent_.replace(selected, value);
    report();
  }

  void report() const {
    const std::string at_least = fmt::format("at least {:g}", incumbent_.bound());
    if (incumbent_.has_selection())
      detail::report_incumbent(control_, scenarios_.table, incumbent_.selected(), incumbent_.value(),
                               incumbent_.bound());
    control_.report(
        Task::placing_over_states, -1,
        incumbent_.has_selection() ? fmt::format("{:g}, {}", incumbent_.value(), at_least) : at_least);
  }

  // Names the labels that are missed too often by all units together; if no label alone is, all that are
  // missed.
  bool is_possible() {
    // Options of a mounting point exclude one another, but all of them give at least as much as any one.
    const Mounts mounts(scenarios_.table);
    const auto all =
        numbers_where<ColumnId>(scenarios_.table.columns(), [&](ColumnId j) { return mounts.available(j); });
    const ScenarioMisses misses = misses_of(scenarios_, problem_, all);
    best_.unreachable = numbers_where<LabelId>(
        misses.of_label.size(), [&](LabelId i) { return misses.of_label[i] > allowance_.limit(i); });
    const bool fits = allowance_.excess(misses) == 0;
    if (!fits && best_.unreachable.empty())
      best_.unreachable =
          numbers_where<LabelId>(misses.of_label.size(), [&](LabelId i) { return misses.of_label[i] > 0; });
    return fits;
  }

  const ScenarioTable& scenarios_;
  const PlacementProblem& problem_;
  const MissAllowance& allowance_;
  const PlaceOptions& options_;
  milp::Backend backend_;
  std::optional<double> enough_;  ///< for a bound alone
  const RunControl& control_;
  detail::Effort effort_, end_;
  std::vector<double> cost_;
  detail::Incumbent incumbent_;
  ScenarioCuts cuts_;
  ScenarioSearch search_;
  ScenarioAnnealing annealing_;
  // Shares add up in both models, and cuts contain unit failure.
  PlacementProblem master_ = problem_;
  std::optional<Limited> limited_;
  ScenarioPlacement best_;
  Selection first_;  ///< annealing begins with it as long as no selection is known
  std::uint64_t moves_ = first_moves;
};

void check(const ScenarioTable& scenarios, const PlacementProblem& problem) {
  if (problem.objective != Objective::count || problem.combination == Combination::weighted)
    throw InputError("objective", "is not the number or the price of units",
                     "placements over states minimise these");
  check_problem(scenarios.table, problem);
}

}  // namespace

ScenarioPlacement place_over_scenarios(const ScenarioTable& scenarios, const PlacementProblem& problem,
                                       const MissAllowance& allowance, const PlaceOptions& options,
                                       const RunControl& control) {
  check(scenarios, problem);
  return Solver(scenarios, problem, allowance, options, {}, control).run();
}

double bound_over_scenarios(const ScenarioTable& scenarios, const PlacementProblem& problem,
                            const MissAllowance& allowance, double enough, const PlaceOptions& options,
                            const RunControl& control) {
  check(scenarios, problem);
  return Solver(scenarios, problem, allowance, options, enough, control).run().lower_bound;
}

}  // namespace shelfbeam
