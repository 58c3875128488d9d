#include "shelfbeam/placement/coverage/partial_search.hpp"

#include <algorithm>
#include <utility>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/placement/answer/search_step.hpp"
#include "shelfbeam/placement/coverage/least_useful.hpp"
#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/kernels/walks.hpp"

namespace shelfbeam::detail {

PartialSearch::PartialSearch(const Instance& instance, const PlaceOptions& options, const RunControl& control)
    : instance_(instance),
      options_(options),
      control_(control),
      weights_(instance.table),
      incumbent_(instance.bounds, 0) {}

void PartialSearch::search(PartialAnswer& answer) {
  const bool fits = CoverModel::fits_with_misses(instance_), may_ask = options_.uses(SolverChoice::mip);
  const bool solves = may_ask && fits, searches = options_.uses(SolverChoice::search);
  const bool anneals = searches && CoverageAnnealing::fits(instance_);
  const bool has_rest = solves || anneals;  // a step that can use the rest of the time
  step("greedy", true, has_rest ? 0.3 : 0.5, [&](const Effort& effort) {
    order_ = greedy_order(instance_, weights_.of_labels(), {.until = effort.until}, control_);
    begin(effort);
  });
  // Bounds profit from a good selection.
  step("short annealing", anneals, 0.3,
       [&](const Effort& effort) { anneal_in_turn(brief_annealing(instance_.table), effort, false); });
  step("multipliers", true, has_rest ? 0.5 : 0.8,
       [&](const Effort& effort) { raise_by_multipliers(effort); });
  step("tree search", searches, has_rest ? 0.6 : 1,
       [&](const Effort& effort) { raise_by_enumeration(effort); });
  step("annealing", anneals && !incumbent_.is_closed(), solves ? 0.75 : 1,
       [&](const Effort& effort) { anneal_in_turn(long_walk(), effort, true); });
  step("MIP", solves, 1, [&](const Effort& effort) {
    solve(effort);
    is_cut_short_ = true;
  });
  is_cut_short_ = is_cut_short_ || until(1).is_over(control_) || !incumbent_.has_selection();
  answer.selected = incumbent_.selected();
  if (incumbent_.has_selection()) {
    answer.missed = instance_.check(answer.selected).unmet;
    answer.reached = instance_.rows() - answer.missed.size();
  }
  answer.bound_proof = incumbent_.proof();
  answer.status = incumbent_.is_closed() ? Status::optimal
                  : is_cut_short_        ? Status::stopped
                                         : Status::feasible;
  answer.too_large = may_ask && !fits;
  answer.solver = std::move(solver_);
  answer.steps = std::move(steps_);
}

Effort PartialSearch::until(double share) const {
  if (options_.step_limit) return {*options_.step_limit};
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
  return for_seconds(share * options_.time_limit_s - spent.count());
}

// `share`: of the time limit, at the end of the step.
template <class Run>
void PartialSearch::step(std::string_view name, bool applies, double share, const Run& run) {
  if (!applies) return;
  const Effort effort = until(share);
  const auto value = [&] { return shown(incumbent_.value()); };
  const auto bound = [&] { return shown(incumbent_.bound()); };
  step_ = name;
  if (!is_settled() && !effort.is_over(control_))
    record_step(steps_, name, value, bound, [&] { run(effort); });
  report_incumbent(control_, instance_.table, incumbent_.selected(), value(), bound());
  control_.report(Task::placing, -1);
  is_cut_short_ = is_cut_short_ || effort.seconds_left() <= 0;
}

// Once, or with other seeds until the time is up; once if the options limit the steps.
void PartialSearch::anneal_in_turn(std::uint64_t moves, const Effort& effort, bool repeats) {
  const CoverageAnnealing annealing(instance_, weights_);
  auto seed = static_cast<std::uint32_t>(mix_key(options_.seed, repeats ? 1 : 0));
  while (!incumbent_.is_closed() && !effort.is_over(control_)) {
    if (!anneal(annealing, {std::min(moves, effort.steps), effort.until}, seed)) return;
    if (!repeats || options_.step_limit) return;
    seed += walks_at_once;
  }
}

// The next back end if one fails or contradicts a checked selection.
void PartialSearch::solve(const Effort& effort) {
  for (const milp::Backend& backend : milp::backends_of(options_.backend)) {
    const MipQuestion question = mip_question();
    CoverModel model(instance_, backend.solve, effort, control_, {.cutoff = question.cutoff},
                     weights_.of_labels());
    const CoverModel::Outcome outcome = model.minimise(question.goal);
    solver_ = {Method::mip, backend.full_name()};
    if (outcome.selected) offer(*outcome.selected);
    const double bound = question.bound(outcome);
    const bool contradicts = incumbent_.contradicts(bound);
    incumbent_.raise(bound, BoundProof::solver, step_);
    if (!outcome.failed && !contradicts) break;
  }
}

void PartialSearch::offer_compact(const Selection& selected, const Effort& effort) {
  offer(without_useless(instance_, weights_, selected, {.until = effort.until}, control_));
}

}  // namespace shelfbeam::detail
