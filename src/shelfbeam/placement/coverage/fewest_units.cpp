#include "shelfbeam/placement/coverage/fewest_units.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/search_step.hpp"
#include "shelfbeam/placement/coverage/coverage_annealing.hpp"
#include "shelfbeam/placement/coverage/coverage_bound.hpp"
#include "shelfbeam/placement/coverage/coverage_effort.hpp"
#include "shelfbeam/placement/coverage/coverage_enumeration.hpp"
#include "shelfbeam/placement/coverage/coverage_model.hpp"
#include "shelfbeam/placement/coverage/coverage_search.hpp"
#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam {

namespace {

using detail::CoverageModel;
using detail::uses;
using Clock = std::chrono::steady_clock;

class Minimisation {
 public:
  Minimisation(const SignalTable& table, const PlacementProblem& problem, double share,
               const PlaceOptions& options, const RunControl& control)
      : table_(table),
        problem_(problem),
        options_(options),
        control_(control),
        max_units_(table.mounting_points()),
        weights_(table),
        search_(table, problem, weights_),
        target_(weights_.rounded_up(share * weights_.total())) {
    result_.problem = problem;
    result_.problem.combination = Combination::lexicographic;
    result_.share = share;
    result_.target = weights_.in_table(target_);
    result_.solver = {Method::greedy};
    offer(detail::installed_units(table));
    result_.count_lower_bound = search_.count();
    if (target_ > 0 && !result_.has_selection)
      result_.count_lower_bound = std::max(search_.count() + 1, problem.redundant ? std::size_t{2} : 1);
    if (!options.start.empty()) offer(options.start);
  }

  FewestUnits run() {
    constexpr double endless_s = 1e8;
    const double limit_s = options_.step_limit ? endless_s : options_.time_limit_s;
    const bool may_ask = uses(options_, SolverChoice::mip);
    const bool fits = CoverageModel::fits(table_, problem_);
    result_.too_large = may_ask && !fits;
    const bool may_solve = may_ask && fits;
    const bool has_rest = may_solve || may_anneal();  // a step that can use the rest of the time
    const Deadline search_end((has_rest ? 0.3 : 0.5) * limit_s), bound_end((has_rest ? 0.5 : 0.8) * limit_s),
        enumeration_end((has_rest ? 0.6 : 1) * limit_s), anneal_end((may_solve ? 0.75 : 1) * limit_s),
        end(limit_s);
    bool was_cut_short = false;

    upper_bound_ = detail::reachable_weight(table_, problem_, weights_);
    is_infeasible_ =
        !result_.has_selection && (upper_bound_ < target_ || result_.count_lower_bound > max_units_);
    const auto step = [&](std::string_view name, const Deadline& until, const auto& run) {
      if (!is_settled() && !until.has_passed() && !control_.cancelled()) record(name, run);
      was_cut_short = was_cut_short || until.has_passed();
    };
    step("local search", search_end, [&] { search(search_end.end()); });
    if (!result_.has_selection && !is_settled())
      record("greedy", [&] { offer(greedy_selection(table_, problem_, {.steps = 0}, control_)); });
    step("multipliers", bound_end, [&] { raise_by_multipliers(bound_end.end()); });
    if (uses(options_, SolverChoice::search))
      step("tree search", enumeration_end, [&] { raise_by_enumeration(enumeration_end.end()); });
    if (may_anneal()) step("annealing", anneal_end, [&] { anneal(anneal_end.end()); });
    const bool solves = !is_settled() && may_solve;
    if (solves) record("MIP", [&] { solve(end); });
    finish(was_cut_short || solves || control_.cancelled() || end.has_passed());
    return std::move(result_);
  }

 private:
  bool is_settled() const {
    return is_infeasible_ || (result_.has_selection && result_.count_lower_bound >= result_.selected.size());
  }

  template <class Run>
  void record(std::string_view name, const Run& run) {
    const auto value = [&] {
      return result_.has_selection ? static_cast<double>(result_.selected.size())
                                   : std::numeric_limits<double>::infinity();
    };
    const auto bound = [&] { return static_cast<double>(result_.count_lower_bound); };
    detail::record_step(result_.steps, name, value, bound, run);
  }

  /// Accepts a selection that reaches the target with fewer units than the incumbent.
  void offer(const std::vector<std::uint32_t>& selected) {
    Check check = check_selection(table_, problem_, selected);
    const double weight = weights_.without(check.unmet);
    if (!check.allowed() || weight < target_ ||
        (result_.has_selection && selected.size() >= result_.selected.size()))
      return;
    result_.has_selection = true;
    result_.selected = selected;
    result_.missed = std::move(check.unmet);
    reached_ = weight;
  }

  /// Adds units, with exchanges, until they reach the target, and then looks for fewer.
  void search(Clock::time_point until) {
    std::size_t left = detail::allowed_work(detail::coverage_search_work, options_, table_);
    const std::size_t work = left / 2 / (max_units_ + 1);
    for (std::size_t k = result_.count_lower_bound; k <= max_units_ && !result_.has_selection; ++k) {
      search_.improve(k, std::max<std::size_t>(work, 1), control_, until);
      offer(search_.selected());
      if (control_.cancelled() || Clock::now() >= until) return;
    }
    while (!is_settled() && result_.has_selection) {
      const std::size_t fewer = result_.selected.size() - 1;
      search_.start(result_.selected);
      if (!search_.drop()) return;
      left /= 2;
      search_.improve_repeatedly(fewer, left, control_, until);
      offer(search_.selected());
      if (result_.selected.size() > fewer) return;
    }
  }

  bool may_anneal() const {
    return uses(options_, SolverChoice::search) && detail::can_anneal_coverage(table_);
  }

  /// Annealing for fewer units, again and again until the time is up.
  void anneal(Clock::time_point until) {
    constexpr std::uint64_t moves = 20'000'000;
    if (!result_.has_selection) return;
    detail::anneal_repeatedly(
        table_, result_.problem, options_, moves, until, control_, [&] { return is_settled(); },
        [&](const auto& instance, const auto& matrix, const detail::Effort& effort, std::uint32_t seed) {
          const auto found = detail::anneal_reach(instance, matrix, weights_, target_, result_.selected,
                                                  effort, seed, control_);
          if (!found) return;
          offer(*found);
          result_.solver = {Method::search};
        });
  }

  void raise_to(std::size_t count, BoundProof proof) {
    if (count <= result_.count_lower_bound) return;
    result_.count_lower_bound = count;
    result_.bound_proof = proof;
    is_infeasible_ = !result_.has_selection && count > max_units_;
  }

  void raise_by_multipliers(Clock::time_point until) {
    // With unit failure, the bound is better for fewer units.
    const std::size_t max_count = result_.has_selection ? result_.selected.size() - 1 : max_units_;
    CoverageBound bound(table_, problem_, weights_, max_count);
    std::size_t steps = detail::bound_steps(bound.entries(), options_, table_);
    while (!is_settled()) {
      const std::size_t count = result_.count_lower_bound;
      steps -= bound.improve(count, target_ - weights_.step(), CoverageAim::reached, steps, control_, until);
      if (bound.weight(count) >= target_) return;
      raise_to(count + 1, BoundProof::dual);
    }
  }

  void raise_by_enumeration(Clock::time_point until) {
    detail::CoverageTable table(table_, problem_, weights_);
    detail::EnumerationLimits limits{detail::allowed_work(detail::enumeration_work, options_, table_), until};
    while (!is_settled()) {
      const std::size_t count = result_.count_lower_bound;
      const auto found = enumerate_coverage(table, weights_, count, target_, detail::EnumerationAim::first,
                                            limits, control_);
      if (!found.is_complete) return;
      result_.solver = {Method::search};
      if (found.selected) {
        offer(*found.selected);
        return;
      }
      raise_to(count + 1, BoundProof::search);
    }
  }

  void solve(const Deadline& end) {
    for (const milp::Backend& backend : milp::backends_of(options_.backend)) {
      CoverageModel model(table_, problem_, weights_);
      const auto known = result_.has_selection ? std::optional(result_.selected.size()) : std::nullopt;
      const auto outcome = model.minimise(target_, known, limited(backend.solve, options_.step_limit),
                                          end.seconds_left(), control_);
      result_.solver = {Method::mip, backend.full_name()};
      if (outcome.selected) offer(*outcome.selected);
      // A solver that contradicts a checked selection is wrong.
      const bool contradicts =
          result_.has_selection &&
          (outcome.is_infeasible || outcome.bound > static_cast<double>(result_.selected.size()));
      if (!contradicts && outcome.bound > 0)
        raise_to(static_cast<std::size_t>(std::min(outcome.bound, static_cast<double>(max_units_ + 1))),
                 BoundProof::solver);
      if (!contradicts && outcome.is_infeasible) {
        is_infeasible_ = true;
        result_.bound_proof = BoundProof::solver;
      }
      if (!outcome.failed && !contradicts) break;
    }
  }

  void finish(bool was_cut_short) {
    result_.status = is_infeasible_                            ? Status::infeasible
                     : is_settled()                            ? Status::optimal
                     : was_cut_short || !result_.has_selection ? Status::stopped
                                                               : Status::feasible;
    if (is_infeasible_) {
      upper_bound_ = std::min(upper_bound_, std::max(0.0, target_ - weights_.step()));
      result_.count_lower_bound = 0;
    }
    result_.reached = result_.has_selection ? table_.rows() - result_.missed.size() : 0;
    result_.weight = {weights_.in_table(reached_), weights_.in_table(weights_.total()),
                      weights_.in_table(upper_bound_)};
  }

  const SignalTable& table_;
  const PlacementProblem& problem_;
  const PlaceOptions& options_;
  const RunControl& control_;
  std::size_t max_units_;
  detail::LabelWeights weights_;
  detail::CoverageSearch search_;
  double target_;
  FewestUnits result_;
  double reached_ = 0, upper_bound_ = 0;
  bool is_infeasible_ = false;
};

}  // namespace

FewestUnits fewest_units(const SignalTable& table, const PlacementProblem& problem, double share,
                         const PlaceOptions& options, const RunControl& control) {
  const auto start = Clock::now();
  const ThreadLimit allowed(control.threads);
  check_problem(table, problem);
  milp::backends_of(options.backend);  // throws for an unknown name
  FewestUnits result = Minimisation(table, problem, share, options, control).run();
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

}  // namespace shelfbeam
