#include "shelfbeam/report/messages/availability.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/end_reason.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/messages/reasons.hpp"
#include "shelfbeam/report/text/numbers.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string confidence_of(const Words& words, const Availability& availability) {
  return words.confidence_text(availability.confidence);
}

bool is_by_price(const Placement& placement) {
  return placement.problem.combination == Combination::spend;
}

// The fewest units on the sampled states, beside the certified ones.
std::string sample_text(const Words& words, const Availability& availability, const Placement& placement) {
  const StateOutcome& sample = availability.sample;
  if (sample.states == 0) return {};
  const double bound = availability.sample_lower_bound;
  const bool by_price = is_by_price(placement), has_bound = bound > 0;
  const std::string states = words.grouped(sample.states);
  std::string text =
      words.say_count(by_price ? "availability.sample_spend" : "availability.sample", sample.units, states);
  if (availability.is_sample_minimum())
    text = words.say_count(by_price ? "availability.sample_cheapest" : "availability.sample_fewest",
                           sample.units, states);
  else if (has_bound && by_price)
    text = words.say_count("availability.sample_spend_at_least", sample.units, states,
                           at_least(words, bound, placement.price));
  else if (has_bound)
    text = words.say_count("availability.sample_at_least", sample.units, states,
                           words.grouped(static_cast<std::size_t>(std::ceil(bound - 1e-6))));
  if (availability.certified && availability.answer().units > sample.units)
    text += " " + words.say_count("availability.price", availability.answer().units - sample.units);
  return text;
}

// "10 of 36 labels reached too rarely, ...": how an outcome breaks the goal.
std::string outcome_text(const Words& words, const Availability& availability, const StateOutcome& outcome) {
  switch (availability.goal.rule) {
    case AvailabilityRule::shop:
      return words.say("availability.outcome.shop", time_share(words, outcome.all_reached()));
    case AvailabilityRule::misses:
      return words.say("availability.outcome.misses", words.fixed(outcome.mean_missed(), 2));
    case AvailabilityRule::labels:
      break;
  }
  return words.say("availability.outcome.labels", words.grouped(outcome.below(availability.required)),
                   words.say_count("noun.label", outcome.missed.size()), time_share(words, outcome.worst()),
                   time_share(words, outcome.all_reached()));
}

// Unless the recommendation says it.
std::string nominal_text(const Words& words, const Availability& availability, const Placement& placement) {
  const StateOutcome& nominal = availability.nominal;
  if (nominal.states == 0 || !states_recommendation(words, availability, placement).empty()) return {};
  if (nominal.keeps_to(availability.goal, availability.required))
    return words.say_count("availability.nominal.enough", nominal.units);
  return words.say_count("availability.nominal.not_enough", nominal.units,
                         outcome_text(words, availability, nominal));
}

std::string addition_text(const Words& words, const Availability& availability) {
  const auto& addition = availability.addition;
  const bool is_verification = availability.nominal.states == 0 && availability.has_answer();
  if (!addition)
    return is_verification && !availability.certified ? words.say("availability.no_addition") : std::string();
  const auto& [x, y, z] = addition->position;
  return words.say("availability.addition", addition->id, words.plain(x), words.plain(y), words.plain(z),
                   words.grouped(addition->without.states),
                   outcome_text(words, availability, addition->without),
                   outcome_text(words, availability, addition->added));
}

std::string assumed_text(const Words& words, const Availability& availability) {
  const auto& [stocking, open_doors] = availability.assumed;
  const auto share = [&](double value) { return words.plain(100 * value, 3) + " %"; };
  std::vector<std::string> values;
  if (stocking) {
    const auto [low, high] = *stocking;
    values.push_back(low == high ? words.say("availability.assumes.level", share(low))
                                 : words.say("availability.assumes.levels", share(low), share(high)));
  }
  if (open_doors) values.push_back(words.say("availability.assumes.doors", share(*open_doors)));
  return values.empty() ? std::string()
                        : words.say("availability.assumed", fmt::format("{}", fmt::join(values, "; ")));
}

std::string left_out_text(const Words& words, const Availability& availability) {
  std::vector<std::string_view> names;
  for (const std::string& cause : availability.without) names.push_back(change_name(words, cause));
  return names.empty() ? std::string()
                       : words.say("availability.left_out", fmt::format("{}", fmt::join(names, ", ")));
}

}  // namespace

std::string time_share(const Words& words, double share) {
  return words.plain(rounded_down(100 * share, 1)) + " %";
}

std::string goal_text(const Words& words, const Availability& availability) {
  const AvailabilityGoal& goal = availability.goal;
  const auto exactly = [&](double share) { return words.plain(100 * share) + " %"; };
  if (goal.rule == AvailabilityRule::shop) return words.say("availability.goal.shop", exactly(*goal.value));
  if (goal.rule == AvailabilityRule::misses)
    return words.say("availability.goal.misses", words.plain(*goal.value));
  const auto [low, high] = std::minmax_element(availability.required.begin(), availability.required.end());
  if (low == availability.required.end()) return words.say("availability.goal.none");
  return *low == *high ? words.say("availability.goal.labels", exactly(*low))
                       : words.say("availability.goal.types", exactly(*low), exactly(*high));
}

std::string labels_by_cause(const Words& words, const Availability& availability,
                            const std::vector<LabelId>& labels, const LabelName& name) {
  constexpr std::size_t shown = 5;
  std::vector<std::string> parts;
  for (const LabelId label : labels) {
    if (parts.size() == shown) break;
    const auto found = std::find_if(availability.at_risk.begin(), availability.at_risk.end(),
                                    [&](const LabelAtRisk& one) { return one.label == label; });
    std::string cause = cause_of_loss(words, availability, label), text = name(label);
    if (cause.empty() && found != availability.at_risk.end() && !found->causes.empty() &&
        found->causes.front().share > 0)
      cause = words(fmt::format("availability.causes.{}", found->causes.front().cause));
    if (availability.has_answer())
      text = words.say("availability.label_share", text,
                       time_share(words, availability.answer().availability(label)));
    parts.push_back(cause.empty() ? text : words.say("availability.label", text, cause));
  }
  const std::string list = fmt::format("{}", fmt::join(parts, ", "));
  return labels.size() > shown ? words.say("summary.and_others", list) : list;
}

std::string availability_sentence(const Words& words, const Availability& availability,
                                  const Placement& placement, const LabelName& name) {
  const std::string goal = goal_text(words, availability);
  if (!availability.unreachable.empty())
    return words.say("availability.impossible", goal,
                     labels_by_cause(words, availability, availability.unreachable, name),
                     words.grouped(availability.nominal.states));
  if (std::isinf(availability.sample_lower_bound))
    return words.say("availability.impossible_together", goal, words.grouped(availability.nominal.states));
  if (availability.certified)
    return words.say("availability.certified", units_reach(words, placement.count()), goal,
                     failure_clause(words, placement.problem), confidence_of(words, availability));
  std::string text =
      availability.has_answer()
          ? words.say_count("availability.open", placement.count(), goal,
                            failure_clause(words, placement.problem))
          : words.say("availability.sampled", units_reach(words, placement.count()), goal,
                      failure_clause(words, placement.problem), words.grouped(availability.nominal.states));
  if (!availability.has_answer() && availability.sample.states == 0)
    text = words.say("availability.nothing", goal);
  if (availability.open) text += " " + words.say("availability.ended", end_text(words, *availability.open));
  if (!availability.responsible.empty())
    text += " " + words.say("availability.responsible",
                            labels_by_cause(words, availability, availability.responsible, name));
  return text;
}

std::string availability_bound(const Words& words, const Availability& availability,
                               const Placement& placement) {
  if (!(availability.lower_bound > 0)) return {};
  if (is_by_price(placement))
    return words.say("availability.spend_bound", at_least(words, availability.lower_bound, placement.price),
                     confidence_of(words, availability));
  const auto bound = static_cast<std::size_t>(std::ceil(availability.lower_bound - 1e-6));
  return availability.certified && bound >= placement.count()
             ? words.say("availability.no_fewer", confidence_of(words, availability))
             : words.say_count("availability.bound", bound, confidence_of(words, availability));
}

std::vector<std::string> availability_remarks(const Words& words, const Availability& availability,
                                              const Placement& placement) {
  const auto& without = availability.without;
  const char* const scope = std::find(without.begin(), without.end(), "reflectance") == without.end()
                                ? "availability.scope"
                                : "availability.scope_as_given";
  std::vector<std::string> remarks;
  for (std::string text :
       {sample_text(words, availability, placement), nominal_text(words, availability, placement),
        addition_text(words, availability), words.say(scope), left_out_text(words, availability),
        assumed_text(words, availability)})
    if (!text.empty()) remarks.push_back(std::move(text));
  return remarks;
}

}  // namespace shelfbeam
