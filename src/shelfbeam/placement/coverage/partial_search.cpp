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
      incumbent_(instance.bounds, 0),
      whole_(options.step_limit ? Effort{*options.step_limit} : for_seconds(options.time_limit_s)),
      searches_(options.uses(SolverChoice::search)),
      anneals_(searches_ && CoverageAnnealing::fits(instance)),
      solves_(options.uses(SolverChoice::mip) && CoverModel::fits_with_misses(instance)),
      too_large_(options.uses(SolverChoice::mip) && !solves_) {}

void PartialSearch::search() {
  using S = PartialSearch;
  constexpr auto has_rest = [](const S& s) { return s.has_rest(); };
  constexpr auto has_no_rest = [](const S& s) { return !s.has_rest(); };
  constexpr auto anneals = [](const S& s) { return s.anneals_; };
  constexpr auto searches_and_rests = [](const S& s) { return s.searches_ && s.has_rest(); };
  constexpr auto only_searches = [](const S& s) { return s.searches_ && !s.has_rest(); };
  constexpr auto improves_first = [](const S& s) { return s.may_improve() && s.solves_; };
  constexpr auto improves_last = [](const S& s) { return s.may_improve() && !s.solves_; };
  constexpr auto begin = [](S& s, const Effort& e) {
    s.order_ = greedy_order(s.instance_, s.weights_.of_labels(), {.until = e.until}, s.control_);
    s.begin(e);
  };
  constexpr auto anneal_briefly = [](S& s, const Effort& e) {
    s.anneal_in_turn(brief_annealing(s.instance_.table), e, false);
  };
  constexpr auto bound = [](S& s, const Effort& e) { s.raise_by_multipliers(e); };
  constexpr auto enumerate = [](S& s, const Effort& e) { s.raise_by_enumeration(e); };
  constexpr auto anneal_long = [](S& s, const Effort& e) { s.anneal_in_turn(s.long_walk(), e, true); };
  static constexpr Step<S> schedule[] = {
      // name, condition, share of the time left, function, maximum steps, maximum seconds
      {"greedy", has_rest, 0.3, begin},
      {"greedy", has_no_rest, 0.5, begin},
      // Bounds profit from a good selection.
      {"short annealing", anneals, 0.3, anneal_briefly},
      {"multipliers", has_rest, 0.4, bound},
      {"multipliers", has_no_rest, 0.6, bound},
      {"tree search", searches_and_rests, 0.2, enumerate},
      {"tree search", only_searches, 1, enumerate},
      {"annealing", improves_first, 0.4, anneal_long},
      {"annealing", improves_last, 1, anneal_long},
      {"MIP", [](const S& s) { return s.solves_; }, 1, [](S& s, const Effort& e) { s.solve(e); }},
  };
  run_steps(schedule, *this);
}

void PartialSearch::fill(PartialAnswer& answer) {
  is_cut_short_ = is_cut_short_ || whole_.is_over(control_) || !incumbent_.has_selection();
  answer.selected = incumbent_.selected();
  if (incumbent_.has_selection()) {
    answer.missed = instance_.check(answer.selected).unmet;
    answer.reached = instance_.rows() - answer.missed.size();
  }
  answer.bound_proof = incumbent_.proof();
  answer.status = incumbent_.is_closed() ? Status::optimal
                  : is_cut_short_        ? Status::stopped
                                         : Status::feasible;
  answer.too_large = too_large_;
  answer.solver = std::move(solver_);
  answer.steps = std::move(steps);
}

void PartialSearch::after(const Effort& effort) {
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
  is_cut_short_ = true;
  for (const milp::Backend& backend : milp::backends_of(options_.backend)) {
    const MipQuestion question = mip_question();
    CoverModel model(instance_, backend.solve, effort, control_, {.cutoff = question.cutoff},
                     weights_.of_labels());
    const CoverModel::Outcome outcome = model.minimise(question.goal);
    solver_ = {Method::mip, backend.full_name()};
    if (outcome.selected) offer(*outcome.selected);
    const double bound = question.bound(outcome);
    const bool contradicts = incumbent_.contradicts(bound);
    incumbent_.raise(bound, BoundProof::solver, step);
    if (!outcome.failed && !contradicts) break;
  }
}

void PartialSearch::offer_compact(const Selection& selected, const Effort& effort) {
  offer(without_useless(instance_, weights_, selected, {.until = effort.until}, control_));
}

}  // namespace shelfbeam::detail
