#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/answer/search_step.hpp"
#include "shelfbeam/placement/coverage/coverage_annealing.hpp"
#include "shelfbeam/placement/coverage/coverage_effort.hpp"
#include "shelfbeam/placement/mip/cover_model.hpp"
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
///   begin(until)                            greedy selection
///   anneal(annealing, effort, seed)         one annealing; false if no unit can be exchanged
///   long_walk                               its moves, in the rest of the time
///   raise_by_multipliers(until)             CoverageBound
///   raise_by_enumeration(until)             enumerate_coverage
///   solve(end)                              the MIP
///
/// With a step limit the times do not apply.
template <class Goal>
class CoverageSchedule {
 public:
  CoverageSchedule(Goal& goal, const Instance& instance, const PlaceOptions& options,
                   const RunControl& control)
      : goal_(goal), instance_(instance), options_(options), control_(control) {}

  CoverageRun run() {
    using Until = std::chrono::steady_clock::time_point;
    const bool fits = CoverModel::fits_with_misses(instance_), may_ask = uses(options_, SolverChoice::mip);
    const bool solves = may_ask && fits, searches = uses(options_, SolverChoice::search);
    const bool anneals = searches && CoverageAnnealing::fits(instance_);
    const bool has_rest = solves || anneals;  // a step that can use the rest of the time
    run_.too_large = may_ask && !fits;
    step("greedy", has_rest ? 0.3 : 0.5, [&](Until until) { goal_.begin(until); });
    // Bounds profit from a good selection.
    if (anneals)
      step("short annealing", 0.3,
           [&](Until until) { anneal({brief_annealing(instance_.table), until}, false); });
    step("multipliers", has_rest ? 0.5 : 0.8, [&](Until until) { goal_.raise_by_multipliers(until); });
    if (searches)
      step("tree search", has_rest ? 0.6 : 1, [&](Until until) { goal_.raise_by_enumeration(until); });
    if (anneals && goal_.may_improve())
      step("annealing", solves ? 0.75 : 1, [&](Until until) { anneal({Goal::long_walk, until}, true); });
    if (solves && !goal_.is_settled() && !at(1).has_passed() && !control_.cancelled()) {
      record_step(run_.steps, "MIP", value(), bound(), [&] { goal_.solve(at(1)); });
      run_.is_cut_short = true;
    }
    run_.is_cut_short = run_.is_cut_short || control_.cancelled() || at(1).has_passed();
    return std::move(run_);
  }

 private:
  auto value() const {
    return [this] { return goal_.value(); };
  }
  auto bound() const {
    return [this] { return goal_.bound(); };
  }

  Deadline at(double share) const {
    constexpr double endless_s = 1e8;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
    return Deadline(options_.step_limit ? endless_s : share * options_.time_limit_s - spent.count());
  }

  template <class Run>
  void step(std::string_view name, double share, const Run& run) {
    const Deadline until = at(share);
    if (!goal_.is_settled() && !until.has_passed() && !control_.cancelled())
      record_step(run_.steps, name, value(), bound(), [&] { run(until.end()); });
    report_incumbent(control_, instance_.table, goal_.selected(), goal_.value(), goal_.bound());
    control_.report(Task::placing, -1);
    run_.is_cut_short = run_.is_cut_short || until.has_passed();
  }

  // Once, or with other seeds until the time is up; once if the options limit the steps.
  void anneal(Effort effort, bool repeats) {
    const CoverageAnnealing annealing(instance_, goal_.weights());
    effort.steps = std::min(effort.steps, options_.step_limit.value_or(effort.steps));
    auto seed = static_cast<std::uint32_t>(mix_key(options_.seed, repeats ? 1 : 0));
    while (goal_.may_improve() && !effort.is_over(control_)) {
      if (!goal_.anneal(annealing, effort, seed) || !repeats || options_.step_limit) return;
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

}  // namespace shelfbeam::detail
