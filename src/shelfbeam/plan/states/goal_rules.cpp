#include "shelfbeam/plan/states/goal_rules.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/order.hpp"

namespace shelfbeam {

void expect_no_goal(const AvailabilityGoal& goal, std::span<const Cause> without) {
  const auto suggestion =
      "omit it, or give the store file a section 'variation' and set the number of states";
  if (!without.empty())
    throw InputError("the choice of changes that are left out",
                     "applies to the states of a shop that changes, but none are examined", suggestion,
                     Setting::without);
  if (!goal.value) return;
  const Setting setting = goal.rule == AvailabilityRule::labels ? Setting::availability
                          : goal.rule == AvailabilityRule::shop ? Setting::all_at_once
                                                                : Setting::mean_missed;
  throw InputError("the goal", "applies to the states of a shop that changes, but none are examined",
                   suggestion, setting);
}

std::vector<double> required_availabilities(const Scene& scene, const AvailabilityGoal& goal) {
  std::vector<double> required;
  required.reserve(scene.labels.size());
  for (const Label& label : scene.labels)
    required.push_back(goal.rule == AvailabilityRule::labels && goal.value
                           ? *goal.value
                           : scene.type_of(label).availability);
  return required;
}

MissAllowance allowance_of(const AvailabilityGoal& goal, const std::vector<double>& required,
                           std::span<const LabelId> labels, std::size_t states,
                           const std::function<std::uint32_t(double)>& misses) {
  MissAllowance allowance;
  switch (goal.rule) {
    case AvailabilityRule::shop:
      allowance.of_shop = misses(*goal.value);
      break;
    case AvailabilityRule::misses:
      allowance.total =
          static_cast<std::uint64_t>(std::floor(*goal.value * static_cast<double>(states) + 1e-9));
      break;
    case AvailabilityRule::labels:
      for (const LabelId i : labels) allowance.of_label.push_back(misses(required[i]));
  }
  return allowance;
}

MissAllowance allowance_of(const AvailabilityGoal& goal, const std::vector<double>& required,
                           std::span<const LabelId> labels, std::size_t states) {
  return allowance_of(goal, required, labels, states,
                      [&](double availability) { return allowed_misses(availability, states); });
}

std::uint32_t states_factor(const AvailabilityGoal& goal, const std::vector<double>& required) {
  if (goal.rule == AvailabilityRule::misses) return 1;
  double availability = goal.rule == AvailabilityRule::shop ? *goal.value : 0;
  if (goal.rule == AvailabilityRule::labels)
    for (const double one : required) availability = std::max(availability, one);
  constexpr double usual = 0.05;
  return static_cast<std::uint32_t>(std::max(1.0, std::ceil(usual / (1 - availability) - 1e-9)));
}

StateOutcome outcome_of(ScenarioMisses misses, std::size_t units, std::uint32_t states) {
  return {units, states, std::move(misses.of_label), misses.of_shop};
}

std::vector<LabelId> most_missed(const StateOutcome& outcome) {
  auto labels =
      numbers_where<LabelId>(outcome.missed.size(), [&](LabelId i) { return outcome.missed[i] > 0; });
  std::stable_sort(labels.begin(), labels.end(),
                   [&](LabelId a, LabelId b) { return outcome.missed[a] > outcome.missed[b]; });
  return labels;
}

std::vector<LabelId> always_missed(const StateOutcome& outcome) {
  return numbers_where<LabelId>(outcome.missed.size(), [&](LabelId i) {
    return outcome.states > 0 && outcome.missed[i] == outcome.states;
  });
}

}  // namespace shelfbeam
