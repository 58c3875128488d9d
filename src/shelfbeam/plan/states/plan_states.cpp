#include "shelfbeam/plan/states/plan_states.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/scenarios/place_over_scenarios.hpp"
#include "shelfbeam/placement/scenarios/scenario_annealing.hpp"
#include "shelfbeam/placement/scenarios/scenario_search.hpp"
#include "shelfbeam/plan/answer/value_bounds.hpp"
#include "shelfbeam/plan/question/question_key.hpp"
#include "shelfbeam/plan/rounds.hpp"
#include "shelfbeam/plan/states/assumed_variation.hpp"
#include "shelfbeam/plan/states/causes_alone.hpp"
#include "shelfbeam/plan/states/deciding_labels.hpp"
#include "shelfbeam/plan/states/fresh_states.hpp"
#include "shelfbeam/plan/states/goal_rules.hpp"
#include "shelfbeam/plan/states/reflectance_ends.hpp"
#include "shelfbeam/plan/states/risk_causes.hpp"
#include "shelfbeam/plan/states/sample_placement.hpp"
#include "shelfbeam/plan/states/state_examination.hpp"
#include "shelfbeam/plan/states/state_sample.hpp"
#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/stats/distributions.hpp"

namespace shelfbeam {

namespace {

constexpr std::uint32_t max_state_rounds = 12;
constexpr double share_of_bound = 1.0 / 3;  ///< beyond the sample, of the time limit
constexpr double share_of_causes = 0.2;     ///< of the time limit, beyond it, for the units of single causes
constexpr double share_of_spread = 0.2;     ///< of the time limit, in every round
// A signal exceeds its upper limit with this probability.
constexpr double raise_error = 0.05;

class Planner {
 public:
  Planner(const Store& store, const Scene& scene, const SignalTable& table, const Placement& nominal,
          const StatesOptions& options, ResultLog& log, const RunControl& control)
      : given_scene_(scene),
        given_store_(store),
        scene_(with_reflectances_for_states(store, scene)),
        store_(with_reflectances_for_states(store, store)),
        states_(store_, scene_, options.simulation.seed),
        all_(table),
        options_(options),
        log_(log),
        control_(control),
        sample_(states_, scene_, options_.simulation, {.count = options_.sample, .sampled = options_.sampled},
                log_, control_),
        result_{nominal, {}} {
    Availability& answer = result_.availability;
    answer.goal = options.goal;
    answer.confidence = options.confidence;
    answer.required = required_availabilities(scene, options.goal);
    answer.assumed = assumed_variation(store);
    answer.without = causes_left_out(store);
  }

  PlanOverStates run() {
    if (options_.sampled != nullptr)
      options_.sampled->expect(scene_.store_hash, options_.simulation.seed, scene_.labels.size(),
                               scene_.transceivers.size(), options_.sample);
    Availability& answer = result_.availability;
    const Stopwatch watch;
    answer.open = Rounds::reason_after([&]() -> std::optional<EndReason> {
      place();
      const bool certifies = answer.unreachable.empty() && options_.certifies && !selected_.empty();
      std::optional<EndReason> open;
      if (certifies) open = certify();
      explain();
      return open;
    });
    log_.flush();
    answer.seconds = watch.seconds();
    finish();
    return std::move(result_);
  }

 private:
  const PlacementProblem& problem() const { return result_.placement.problem; }

  MissAllowance allowance(std::span<const LabelId> labels) const {
    return allowance_of(options_.goal, result_.availability.required, labels, options_.sample);
  }

  void stop_if_cancelled() const {
    if (control_.cancelled()) throw Interrupted("the plan was stopped");
  }

  void place() {
    Availability& answer = result_.availability;
    deciding_.emplace(sample_, all_, problem(), result_.placement.selected);
    answer.nominal_bound = proven_count(result_.placement);
    answer.nominal =
        outcome_of(deciding_->misses_of_start(), result_.placement.selected.size(), options_.sample);
    const Deadline deadline((1 - share_of_bound) * options_.place.time_limit_s);
    SamplePlacement found = place_on_sample(
        *deciding_, problem(), [&](auto labels) { return allowance(labels); }, options_.place, deadline,
        control_);
    allowance_ = allowance(deciding_->labels());
    answer.sample_lower_bound = found.lower_bound;
    answer.unreachable = std::move(found.unreachable);
    if (found.selected.empty()) return;
    selected_ = answer.sample_selected = std::move(found.selected);
    answer.sample = outcome_of(std::move(found.misses), selected_.size(), options_.sample);
    answer.sample_value = found.value;
    if (options_.goal.rule == AvailabilityRule::labels && !problem().redundant) raise_bound();
    stop_if_cancelled();
  }

  // A selection that keeps to the goal misses a label, by raised signals, in at most (1 - availability) +
  // raise_error of the states, and its misses exceed the allowance of any label with the level of the bound.
  // With unit failure, the limits of many sums would have to hold at once, so there is no such bound.
  void raise_bound() {
    const std::span labels = deciding_->labels();
    // All labels share the level, because the states themselves choose the deciding ones.
    const double level = (1 - options_.confidence) / 2 / static_cast<double>(all_.rows());
    const auto widened = [&](double availability) {
      return widened_misses(std::max(0.0, availability - raise_error), options_.sample, level);
    };
    const MissAllowance wide =
        allowance_of(options_.goal, result_.availability.required, labels, options_.sample, widened);
    PlaceOptions place = options_.place;
    place.time_limit_s *= share_of_bound;
    const double enough = result_.availability.sample_lower_bound;
    const double errors = student_quantile(1 - raise_error, sample_.batches() - 1);
    result_.availability.lower_bound = std::min(
        bound_over_scenarios(raised(deciding_->table(), errors), problem(), wide, enough, place, control_),
        enough);
  }

  // Returns the reason why the plan is not certified.
  std::optional<EndReason> certify() {
    Availability& answer = result_.availability;
    // The other statement is the bound.
    const std::uint64_t question =
        question_key(question_key(options_.simulation.seed, all_, problem()),
                     {scene_, options_.goal, answer.required, options_.confidence, options_.sample});
    Rounds rounds(options_.confidence, 2, {options_.budget_s}, question, control_);
    const std::uint32_t factor = states_factor(options_.goal, answer.required);
    Selection named = selected_;
    while (rounds.round() < max_state_rounds) {
      if (rounds.round() > 0) {
        named = with_another(rounds);
        stop_if_cancelled();
        if (named.size() == selected_.size())
          return EndReason{rounds.left() > 0 ? EndCause::no_unit : EndCause::time_limit};
      }
      rounds.next();
      const Scene units = with_units(scene_, named);
      const StateExamination examination(states_, units, problem(), options_.simulation, log_, control_);
      FreshStatesOptions of_round{.question = question, .round = rounds.round(), .level = rounds.level()};
      for (std::uint32_t& look : of_round.looks) look *= factor;
      FreshStates fresh = examine([&](std::uint64_t k) { return examination.missed(k); }, options_.goal,
                                  answer.required, of_round, Deadline(rounds.left()), control_);
      if (fresh.outcome.states > 0) {
        selected_ = named;
        fresh.outcome.units = named.size();
        answer.examined.push_back(std::move(fresh.outcome));
        answer.shown = std::move(fresh.shown);
        answer.responsible = std::move(fresh.undecided);
      }
      answer.certified = fresh.certified;
      if (fresh.certified) return {};
      stop_if_cancelled();
      if (fresh.out_of_time) return EndReason{EndCause::time_limit};
    }
    return EndReason{EndCause::plans_failed};
  }

  // Adds the unit that helps most, also at labels that only fresh states have shown to be at risk.
  Selection with_another(const Rounds& rounds) {
    const std::vector<LabelId>& undecided = result_.availability.responsible;
    deciding_->add_if(
        [&](LabelId i) { return std::find(undecided.begin(), undecided.end(), i) != undecided.end(); });
    allowance_ = allowance(deciding_->labels());
    const ScenarioSearch search(deciding_->table(), problem(), allowance_, detail::for_seconds(rounds.left()),
                                control_);
    // The sampled states may not show the risk of the fresh ones.
    std::vector<LabelId> rows;
    rows.reserve(undecided.size());
    for (const LabelId i : undecided) rows.push_back(deciding_->row_of(i));
    Selection more = search.with_another(selected_, rows);
    ScenarioAnnealing annealing(deciding_->table(), problem(), allowance_);
    const double seconds = std::min(rounds.left(), share_of_spread * options_.place.time_limit_s);
    return annealing.spread(std::move(more), detail::for_seconds(seconds), control_);
  }

  void explain() {
    Availability& answer = result_.availability;
    if (!answer.unreachable.empty()) answer.responsible = answer.unreachable;
    const std::vector<LabelId> risky = !answer.unreachable.empty() ? answer.unreachable
                                       : answer.has_answer()       ? most_missed(answer.answer())
                                       : answer.sample.states > 0  ? most_missed(answer.sample)
                                                                   : most_missed(answer.nominal);
    const Scene units = with_units(scene_, selected_.empty() ? result_.placement.selected : selected_);
    answer.at_risk = risk_causes(states_, units, risky, problem(), options_.simulation, log_, control_);
    explain_need();
  }

  // The reasons for more units than the shop as the file gives it needs.
  void explain_need() {
    Availability& answer = result_.availability;
    const CausesAlone causes(given_store_, given_scene_, all_, problem(), answer, options_.simulation,
                             options_.sample, log_, control_);
    PlaceOptions place = options_.place;
    place.time_limit_s *= share_of_causes;
    causes.examine(result_.placement.selected, place, answer);
    const Selection every = all_numbers<ColumnId>(all_.columns());
    const bool is_impossible = !answer.unreachable.empty();
    if (is_impossible)
      answer.lost = causes.lost(
          always_missed(outcome_of(deciding_->misses(every), every.size(), options_.sample)), every);
    else if (answer.has_answer() || answer.sample.states > 0)
      answer.lost =
          causes.lost(always_missed(answer.has_answer() ? answer.answer() : answer.sample), selected_);
  }

  // The selection with the bound that holds for it.
  void finish() {
    if (selected_.empty()) return;
    Placement& placement = result_.placement;
    const Availability& answer = result_.availability;
    placement.selected = selected_;
    placement.objective_value = scenario_value(deciding_->table(), placement.problem, selected_);
    placement.lower_bound = answer.lower_bound;
    placement.count_lower_bound =
        placement.problem.combination == Combination::spend ? 0 : answer.lower_bound;
    placement.bound_proof = BoundProof::search;
    placement.ties_settled = false;
    placement.status = answer.certified && placement.gap() <= 0 ? Status::optimal : Status::stopped;
    placement.solver = {Method::states};
    if (placement.price) placement.price = price_of(all_, selected_);
  }

  const Scene& given_scene_;
  const Store& given_store_;
  Scene scene_;
  Store store_;
  StoreStates states_;
  const SignalTable& all_;
  const StatesOptions& options_;
  ResultLog& log_;
  const RunControl& control_;
  StateSample sample_;
  PlanOverStates result_;
  std::optional<DecidingLabels> deciding_;
  MissAllowance allowance_;
  Selection selected_;
};

}  // namespace

PlanOverStates plan_over_states(const Store& store, const Scene& scene, const SignalTable& table,
                                const Placement& nominal, const StatesOptions& options, ResultLog& log,
                                const RunControl& control) {
  return Planner(store, scene, table, nominal, options, log, control).run();
}

}  // namespace shelfbeam
