#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/incumbent.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/coverage/coverage_annealing.hpp"
#include "shelfbeam/placement/coverage/coverage_effort.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/coverage/partial_answer.hpp"
#include "shelfbeam/placement/mip/cover_model.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// The search of every goal that may leave labels missed, a step at a time. A goal derives from it. With a
/// step limit the times do not apply.
class PartialSearch {
 public:
  PartialSearch(const Instance& instance, const PlaceOptions& options, const RunControl& control);
  PartialSearch(const PartialSearch&) = delete;
  virtual ~PartialSearch() = default;

  // For run_steps.
  Effort whole() const { return whole_; }
  double value() const { return shown(incumbent_.value()); }
  double bound() const { return shown(incumbent_.bound()); }
  /// Nothing is left to do.
  virtual bool is_settled() const { return incumbent_.is_closed(); }
  bool ends() const { return is_settled() || whole_.is_over(control_); }
  void after(const Effort& effort);
  std::string_view step;
  std::vector<SearchStep> steps;

 protected:
  /// Runs the steps.
  void search();
  /// The parts of every answer; the status is optimal, feasible or stopped.
  void fill(PartialAnswer& answer);

  /// Replaces the incumbent if the selection is allowed and better.
  virtual void offer(const Selection& selected) = 0;
  /// A value of the incumbent in the unit of the answer.
  virtual double shown(double value) const { return value; }
  /// Moves of an annealing in the rest of the time.
  virtual std::uint64_t long_walk() const = 0;
  /// Offers a selection of the first units of a greedy selection of all labels (`order_`).
  virtual void begin(const Effort& effort) = 0;
  /// One annealing; false if no unit can be exchanged.
  virtual bool anneal(const CoverageAnnealing& annealing, const Effort& effort, std::uint32_t seed) = 0;
  /// Raises the bound by CoverageBound.
  virtual void raise_by_multipliers(const Effort& effort) = 0;
  /// Raises the bound by enumerate_coverage, and offers its selections.
  virtual void raise_by_enumeration(const Effort& effort) = 0;
  /// The question for a MIP solver; `cutoff` as in MipKnowledge. Its bound becomes one on the value.
  struct MipQuestion {
    MipGoal goal;
    double cutoff = milp::infinity;
    std::function<double(const CoverModel::Outcome&)> bound;
  };
  virtual MipQuestion mip_question() const = 0;

  void offer_compact(const Selection& selected, const Effort& effort);

  const Instance& instance_;
  const PlaceOptions& options_;
  const RunControl& control_;
  LabelWeights weights_;
  Incumbent incumbent_;  ///< by the count, unless the goal has another value
  SolvedBy solver_ = {Method::greedy};
  std::vector<ColumnId> order_;  ///< of the greedy method

 private:
  void anneal_in_turn(std::uint64_t moves, const Effort& effort, bool repeats);
  void solve(const Effort& effort);
  bool may_improve() const { return anneals_ && !incumbent_.is_closed(); }
  bool has_rest() const { return solves_ || anneals_; }  ///< a step can use the rest of the time

  Effort whole_;
  bool searches_, anneals_, solves_, too_large_;
  bool is_cut_short_ = false;  ///< by a limit or an interruption, or by a MIP solver that settled nothing
};

/// The answer of `search` to a question that may leave labels missed, with the time that it took.
template <class Search>
auto search_partial(const SignalTable& table, const PlacementProblem& problem, const PlaceOptions& options,
                    const RunControl& control, const Search& search) {
  const Stopwatch watch;
  const ThreadLimit allowed(control.threads);
  check_problem(table, problem);
  milp::backends_of(options.backend);  // throws for an unknown name
  auto answer = search(Instance(table, counting(problem)));
  answer.problem = problem;
  answer.problem.combination = Combination::lexicographic;
  answer.seconds = watch.seconds();
  return answer;
}

}  // namespace shelfbeam::detail
