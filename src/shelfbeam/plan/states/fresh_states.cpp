#include "shelfbeam/plan/states/fresh_states.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "shelfbeam/placement/scenarios/misses.hpp"
#include "shelfbeam/plan/states/goal_rules.hpp"
#include "shelfbeam/plan/states/state_examination.hpp"
#include "shelfbeam/plan/validation_estimates.hpp"

namespace shelfbeam {

namespace {

// The probability that a plan which would just succeed at the last look, because of one label, seems hopeless
// at a check. An end without success costs no confidence.
constexpr double hopeless_level = 0.01;
constexpr std::uint32_t check_interval = 20;

// The share of states that are counted as missed if the availability is exactly the required one.
double counted_share(double availability) {
  return (1 - StateExamination::verdict_error) * (1 - availability);
}

class Judge {
 public:
  Judge(const AvailabilityGoal& goal, const std::vector<double>& required, const FreshStatesOptions& options)
      : goal_(goal),
        required_(required),
        looks_(options.looks),
        level_(options.level / static_cast<double>(options.looks.size())) {}

  void add(std::size_t missed) {
    missed_.hits += missed > 0 ? 1 : 0;
    missed_.sampled.add(static_cast<double>(missed));
    most_ = std::max(most_, static_cast<double>(missed));
  }

  bool is_certain(const StateOutcome& outcome) const {
    return all(outcome, [&](double required,
                            std::uint32_t misses) { return proves(required, misses, outcome.states); }) &&
           (goal_.rule != AvailabilityRule::misses || upper_mean() <= counted(*goal_.value));
  }

  std::vector<LabelId> undecided(const StateOutcome& outcome) const {
    std::vector<LabelId> labels = most_missed(outcome);
    if (goal_.rule == AvailabilityRule::labels)
      std::erase_if(labels,
                    [&](LabelId i) { return proves(required_[i], outcome.missed[i], outcome.states); });
    return labels;
  }

  // No later look can succeed, or it is improbable.
  bool is_hopeless(const StateOutcome& outcome) const {
    if (goal_.rule == AvailabilityRule::misses)
      return outcome.states >= looks_.front() / 2 && missed_.lower(hopeless_level) > counted(*goal_.value);
    return !all(outcome, [&](double required, std::uint32_t misses) {
      const auto proving = proving_misses(1 - counted_share(required), looks_.back(), level_);
      if (!proving || misses > *proving) return false;
      const double succeeding = 1 - static_cast<double>(*proving) / looks_.back();
      return misses <= widened_misses(succeeding, outcome.states, hopeless_level);
    });
  }

 private:
  bool proves(double required, std::uint32_t misses, std::uint32_t states) const {
    const auto proving = proving_misses(1 - counted_share(required), states, level_);
    return proving && misses <= *proving;
  }
  static double counted(double mean) { return (1 - StateExamination::verdict_error) * mean; }

  double upper_mean() const {
    const double upper = missed_.upper(level_);
    return missed_.is_rare() ? std::max(upper, missed_.rare_upper(level_, most_, *goal_.value)) : upper;
  }

  template <class Test>
  bool all(const StateOutcome& outcome, const Test& test) const {
    if (goal_.rule == AvailabilityRule::shop) return test(*goal_.value, outcome.states_with_miss);
    if (goal_.rule == AvailabilityRule::misses) return true;
    // Few label types have availabilities of their own.
    std::map<double, std::uint32_t> most;
    for (std::size_t i = 0; i < required_.size(); ++i) {
      std::uint32_t& misses = most[required_[i]];
      misses = std::max(misses, outcome.missed[i]);
    }
    return std::all_of(most.begin(), most.end(),
                       [&](const auto& one) { return test(one.first, one.second); });
  }

  const AvailabilityGoal& goal_;
  const std::vector<double>& required_;
  const std::vector<std::uint32_t>& looks_;
  double level_;
  ValidationEstimate missed_;  ///< labels per state
  double most_ = 0;
};

void show(std::vector<ShownState>& shown, std::uint64_t number, const std::vector<LabelId>& missed) {
  constexpr std::size_t first = 4;
  const auto has_fewer = [&](const ShownState& other) { return other.missed.size() < missed.size(); };
  if (shown.size() >= first) {
    if (!std::all_of(shown.begin(), shown.end(), has_fewer)) return;
    shown.resize(first);
  }
  shown.push_back({number, missed});
}

}  // namespace

FreshStates examine(const MissedLabels& missed_in, const AvailabilityGoal& goal,
                    const std::vector<double>& required, const FreshStatesOptions& options,
                    const Deadline& deadline, const RunControl& control) {
  FreshStates result;
  StateOutcome& outcome = result.outcome;
  outcome.missed.assign(required.size(), 0);
  Judge judge(goal, required, options);
  const std::vector<std::uint32_t>& looks = options.looks;
  while (!result.certified && outcome.states < looks.back()) {
    if (control.cancelled() || deadline.has_passed()) {
      result.out_of_time = true;
      break;
    }
    control.report(Task::fresh_states, static_cast<double>(outcome.states) / looks.back(),
                   options.ends_early ? fmt::format("plan {}", options.round) : "");
    const std::uint64_t number = first_fresh_state(options.question, options.round) + outcome.states;
    const auto missed = missed_in(number);
    ++outcome.states;
    for (const LabelId i : missed) ++outcome.missed[i];
    if (!missed.empty()) ++outcome.states_with_miss;
    show(result.shown, number, missed);
    judge.add(missed.size());
    const bool is_look = std::find(looks.begin(), looks.end(), outcome.states) != looks.end();
    if (is_look) result.certified = judge.is_certain(outcome);
    if (options.ends_early && !result.certified && outcome.states % check_interval == 0 &&
        judge.is_hopeless(outcome))
      break;
  }
  if (!result.certified) result.undecided = judge.undecided(outcome);
  return result;
}

}  // namespace shelfbeam
