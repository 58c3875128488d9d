#include "shelfbeam/placement/coverage/max_coverage.hpp"

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/search_step.hpp"
#include "shelfbeam/placement/coverage/coverage_annealing.hpp"
#include "shelfbeam/placement/coverage/coverage_bound.hpp"
#include "shelfbeam/placement/coverage/coverage_effort.hpp"
#include "shelfbeam/placement/coverage/coverage_enumeration.hpp"
#include "shelfbeam/placement/coverage/coverage_model.hpp"
#include "shelfbeam/placement/coverage/coverage_search.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam {

namespace {

using detail::CoverageModel;
using detail::EnumerationAim;
using detail::uses;
using Clock = std::chrono::steady_clock;

// MIP solvers prove optima within a part in 1e6.
constexpr double solver_gap = 2e-6;

class Maximisation {
 public:
  Maximisation(const SignalTable& table, const PlacementProblem& problem, std::size_t units,
               const PlaceOptions& options, const RunControl& control)
      : table_(table),
        problem_(problem),
        options_(options),
        control_(control),
        units_(std::min(units, table.columns())),
        weights_(table),
        search_(table, problem, weights_) {
    reach_.problem = problem;
    reach_.problem.combination = Combination::lexicographic;
    reach_.at_most = units;
    reach_.solver = {Method::greedy};
    reach_.selected = detail::installed_units(table);
    reach_.missed = check_selection(table, problem, reach_.selected).unmet;
    value_ = weights_.without(reach_.missed);
    if (!options.start.empty()) offer(options.start);
    bound_ = weights_.total();
  }

  MaxCoverage run() {
    constexpr double endless_s = 1e8;
    const double limit_s = options_.step_limit ? endless_s : options_.time_limit_s;
    const bool may_ask = uses(options_, SolverChoice::mip);
    const bool fits = CoverageModel::fits(table_, problem_);
    const bool may_solve = may_ask && fits;
    reach_.too_large = may_ask && !fits;
    const bool has_rest = may_solve || may_anneal();  // a step that can use the rest of the time
    const Deadline search_end((has_rest ? 0.3 : 0.5) * limit_s), bound_end((has_rest ? 0.5 : 1) * limit_s),
        enumeration_end((has_rest ? 0.6 : 1) * limit_s), anneal_end((may_solve ? 0.75 : 1) * limit_s),
        end(limit_s);

    if (!options_.start.empty()) search_.start(reach_.selected);
    record("local search", [&] {
      search_.improve_repeatedly(units_, detail::allowed_work(detail::coverage_search_work, options_, table_),
                                 control_, search_end.end());
      offer(search_.selected());
    });
    bool was_cut_short = search_end.has_passed();
    const auto step = [&](std::string_view name, const Deadline& until, const auto& run) {
      if (!until.has_passed() && !control_.cancelled()) record(name, run);
      was_cut_short = was_cut_short || until.has_passed();
    };
    step("multipliers", bound_end, [&] { lower_bound(bound_end.end()); });
    if (bound_ >= weights_.total())  // no time for more
      lower_to(detail::reachable_weight(table_, problem_, weights_), BoundProof::trivial);
    bool is_settled = false;
    if (uses(options_, SolverChoice::search))
      step("tree search", enumeration_end, [&] { is_settled = enumerate(enumeration_end.end()); });
    if (!is_settled && !is_proven() && may_anneal() && reach_.selected.size() == units_)
      step("annealing", anneal_end, [&] { anneal(anneal_end.end()); });
    if (may_solve && !is_settled) record("MIP", [&] { solve(end); });
    was_cut_short = was_cut_short || control_.cancelled() || end.has_passed();
    reach_.status = is_proven()                                   ? Status::optimal
                    : (may_solve && !is_settled) || was_cut_short ? Status::stopped
                                                                  : Status::feasible;
    reach_.reached = table_.rows() - reach_.missed.size();
    if (!has_weights(table_)) {
      reach_.upper_bound = static_cast<std::size_t>(bound_);
      return std::move(reach_);
    }
    const std::vector<bool> can = detail::reachable_labels(table_, problem_);
    reach_.upper_bound = static_cast<std::size_t>(std::count(can.begin(), can.end(), true));
    reach_.weight = CoverageWeight{weights_.in_table(value_), weights_.in_table(weights_.total()),
                                   weights_.in_table(std::max(bound_, value_))};
    return std::move(reach_);
  }

 private:
  bool is_proven() const {
    return bound_ <= value_ + (weights_.are_whole() ? 0 : weights_.step()) || is_closed_by_solver_;
  }

  template <class Run>
  void record(std::string_view name, const Run& run) {
    const auto value = [&] { return weights_.in_table(value_); };
    const auto bound = [&] { return weights_.in_table(bound_); };
    detail::record_step(reach_.steps, name, value, bound, run);
  }

  /// Accepts a selection that is better than the incumbent.
  void offer(const std::vector<std::uint32_t>& selected) {
    Check check = check_selection(table_, problem_, selected);
    const double value = weights_.without(check.unmet);
    const bool better = value > value_ || (value == value_ && selected.size() < reach_.selected.size());
    if (!check.allowed() || selected.size() > reach_.at_most || !better) return;
    reach_.selected = selected;
    reach_.missed = std::move(check.unmet);
    value_ = value;
  }

  void lower_to(double bound, BoundProof proof) {
    if (bound >= bound_) return;
    bound_ = bound;
    reach_.bound_proof = proof;
  }

  void lower_bound(Clock::time_point until) {
    CoverageBound bound(table_, problem_, weights_, units_);
    bound_ = bound.weight(units_);
    bound.improve(units_, value_, CoverageAim::lowest, detail::bound_steps(bound.entries(), options_, table_),
                  control_, until);
    lower_to(bound.weight(units_), BoundProof::dual);
  }

  /// Proves the value, then looks for fewer units of the same value; false if the work was not enough.
  bool enumerate(Clock::time_point until) {
    detail::CoverageTable table(table_, problem_, weights_);
    detail::EnumerationLimits limits{detail::allowed_work(detail::enumeration_work, options_, table_), until};
    const auto examine = [&](std::size_t units, double weight, EnumerationAim aim) {
      auto found = enumerate_coverage(table, weights_, units, weight, aim, limits, control_);
      if (found.selected) offer(*found.selected);
      return found;
    };
    if (!is_proven()) {
      if (!examine(units_, value_ + weights_.step(), EnumerationAim::best).is_complete) return false;
      lower_to(value_, BoundProof::search);
      reach_.solver = {Method::search};
      search_.start(reach_.selected);
      search_.improve(units_, 0, control_, until);
      offer(search_.selected());
    }
    while (reach_.selected.size() > table.installed().size()) {
      const std::size_t size = reach_.selected.size();
      const auto fewer = examine(size - 1, value_, EnumerationAim::first);
      if (!fewer.is_complete) return reach_.bound_proof == BoundProof::search;
      if (reach_.selected.size() == size) break;
    }
    reach_.solver = {Method::search};
    return true;
  }

  bool may_anneal() const {
    return uses(options_, SolverChoice::search) && detail::can_anneal_coverage(table_);
  }

  /// Annealing for more weight, again and again until the time is up.
  void anneal(Clock::time_point until) {
    constexpr std::uint64_t moves = 4'000'000;
    detail::anneal_repeatedly(
        table_, reach_.problem, options_, moves, until, control_, [&] { return is_proven(); },
        [&](const auto& instance, const auto& matrix, const detail::Effort& effort, std::uint32_t seed) {
          const auto found = detail::anneal_coverage(instance, matrix, weights_, value_, reach_.selected,
                                                     effort, seed, control_);
          if (!found) return;
          offer(*found);
          reach_.solver = {Method::search};
        });
  }

  void solve(const Deadline& end) {
    for (const milp::Backend& backend : milp::backends_of(options_.backend)) {
      CoverageModel model(table_, problem_, weights_);
      const auto outcome =
          model.maximise(units_, value_, reach_.selected.size(), limited(backend.solve, options_.step_limit),
                         end.seconds_left(), control_);
      reach_.solver = {Method::mip, backend.full_name()};
      if (outcome.selected) offer(*outcome.selected);
      const double allowed = weights_.are_whole() ? 0 : solver_gap * weights_.total();
      const bool contradicts = outcome.bound < value_ - allowed;
      if (!contradicts) lower_to(std::max(outcome.bound, value_), BoundProof::solver);
      if (!contradicts && !weights_.are_whole() && outcome.bound <= value_ + allowed) {
        is_closed_by_solver_ = true;
        reach_.bound_proof = BoundProof::solver;
      }
      if (!outcome.failed && !contradicts) break;
    }
  }

  const SignalTable& table_;
  const PlacementProblem& problem_;
  const PlaceOptions& options_;
  const RunControl& control_;
  std::size_t units_;
  detail::LabelWeights weights_;
  detail::CoverageSearch search_;
  MaxCoverage reach_;
  double value_ = 0, bound_ = 0;      ///< weights of the selection and of its upper bound
  bool is_closed_by_solver_ = false;  ///< within its gap, for weights that are not whole
};

}  // namespace

MaxCoverage maximise_coverage(const SignalTable& table, const PlacementProblem& problem, std::size_t units,
                              const PlaceOptions& options, const RunControl& control) {
  const auto start = Clock::now();
  const ThreadLimit allowed(control.threads);
  check_problem(table, problem);
  milp::backends_of(options.backend);  // throws for an unknown name
  if (const std::size_t installed = detail::installed_units(table).size(); installed > units)
    throw InputError("number of units",
                     fmt::format("is {}, but {} units are installed or pinned", units, installed),
                     "use at least this number", Setting::units);
  MaxCoverage reach = Maximisation(table, problem, units, options, control).run();
  reach.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return reach;
}

}  // namespace shelfbeam
