#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/answer/search_step.hpp"
#include "shelfbeam/placement/coverage/coverage_annealing.hpp"
#include "shelfbeam/placement/coverage/coverage_effort.hpp"
#include "shelfbeam/placement/kernels/walks.hpp"
#include "shelfbeam/placement/mip/cover_model.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/incumbent_report.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

struct CoverageRun {
  std::vector<SearchStep> steps;
  bool is_cut_short = false;  ///< by a limit or an interruption, or by a MIP solver that settled nothing
  bool too_large = false;     ///< for a MIP solver that the options allow
};

/// The search of every goal that may leave labels missed, a step at a time. Goal has
///
///   weights()                               of the labels
///   selected(), value(), bound()            of the incumbent, for progress and the record of steps
///   may_improve(), is_settled()             annealing may improve the incumbent; nothing is left to do
///   begin(effort)                           greedy selection
///   anneal(annealing, effort, seed)         one annealing; false if no unit can be exchanged
///   long_walk                               its moves, in the rest of the time
///   raise_by_multipliers(effort)            CoverageBound
///   raise_by_enumeration(effort)            enumerate_coverage
///   solve(effort)                           the MIP
///
/// With a step limit the times do not apply.
template <class Goal>
class CoverageSchedule {
 public:
  CoverageSchedule(Goal& goal, const Instance& instance, const PlaceOptions& options,
                   const RunControl& control)
      : goal_(goal), instance_(instance), options_(options), control_(control) {}

  CoverageRun run() {
    const bool fits = CoverModel::fits_with_misses(instance_), may_ask = options_.uses(SolverChoice::mip);
    const bool solves = may_ask && fits, searches = options_.uses(SolverChoice::search);
    const bool anneals = searches && CoverageAnnealing::fits(instance_);
    const bool has_rest = solves || anneals;  // a step that can use the rest of the time
    run_.too_large = may_ask && !fits;
    step("greedy", true, has_rest ? 0.3 : 0.5, [&](const Effort& effort) { goal_.begin(effort); });
    // Bounds profit from a good selection.
    step("short annealing", anneals, 0.3,
         [&](const Effort& effort) { anneal(brief_annealing(instance_.table), effort, false); });
    step("multipliers", true, has_rest ? 0.5 : 0.8,
         [&](const Effort& effort) { goal_.raise_by_multipliers(effort); });
    step("tree search", searches, has_rest ? 0.6 : 1,
         [&](const Effort& effort) { goal_.raise_by_enumeration(effort); });
    step("annealing", anneals && goal_.may_improve(), solves ? 0.75 : 1,
         [&](const Effort& effort) { anneal(Goal::long_walk, effort, true); });
    step("MIP", solves, 1, [&](const Effort& effort) {
      goal_.solve(effort);
      run_.is_cut_short = true;
    });
    run_.is_cut_short = run_.is_cut_short || until(1).is_over(control_);
    return std::move(run_);
  }

 private:
  Effort until(double share) const {
    if (options_.step_limit) return {*options_.step_limit};
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
    return for_seconds(share * options_.time_limit_s - spent.count());
  }

  // `share`: of the time limit, at the end of the step.
  template <class Run>
  void step(std::string_view name, bool applies, double share, const Run& run) {
    if (!applies) return;
    const Effort effort = until(share);
    if (!goal_.is_settled() && !effort.is_over(control_))
      record_step(
          run_.steps, name, [&] { return goal_.value(); }, [&] { return goal_.bound(); },
          [&] { run(effort); });
    report_incumbent(control_, instance_.table, goal_.selected(), goal_.value(), goal_.bound());
    control_.report(Task::placing, -1);
    run_.is_cut_short = run_.is_cut_short || effort.seconds_left() <= 0;
  }

  // Once, or with other seeds until the time is up; once if the options limit the steps.
  void anneal(std::uint64_t moves, const Effort& effort, bool repeats) {
    const CoverageAnnealing annealing(instance_, goal_.weights());
    auto seed = static_cast<std::uint32_t>(mix_key(options_.seed, repeats ? 1 : 0));
    while (goal_.may_improve() && !effort.is_over(control_)) {
      const Effort of_one{std::min(moves, effort.steps), effort.until};
      if (!goal_.anneal(annealing, of_one, seed) || !repeats || options_.step_limit) return;
      seed += walks_at_once;
    }
  }

  Goal& goal_;
  const Instance& instance_;
  const PlaceOptions& options_;
  const RunControl& control_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  CoverageRun run_;
};

/// The answer of `search` to a question that may leave labels missed, with the time that it took.
template <class Search>
auto search_partial(const SignalTable& table, const PlacementProblem& problem, const PlaceOptions& options,
                    const RunControl& control, const Search& search) {
  const auto begin = std::chrono::steady_clock::now();
  const ThreadLimit allowed(control.threads);
  check_problem(table, problem);
  milp::backends_of(options.backend);  // throws for an unknown name
  auto answer = search(Instance(table, counting(problem)));
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return answer;
}

}  // namespace shelfbeam::detail
