#include "shelfbeam/report/messages/availability.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/end_reason.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/text/catalogue.hpp"

namespace shelfbeam {

namespace {

std::string confidence_of(const Availability& availability) {
  return confidence_text(availability.confidence);
}

bool is_by_price(const Placement& placement) {
  return placement.problem.combination == Combination::spend;
}

// The fewest units on the sampled states, beside the certified ones.
std::string sample_text(const Availability& availability, const Placement& placement) {
  const StateOutcome& sample = availability.sample;
  if (sample.states == 0) return {};
  const double bound = availability.sample_lower_bound;
  const bool by_price = is_by_price(placement), has_bound = bound > 0;
  const std::string states = grouped(sample.states);
  std::string text =
      say_count(by_price ? "availability.sample_spend" : "availability.sample", sample.units, states);
  if (availability.is_sample_minimum())
    text = say_count(by_price ? "availability.sample_cheapest" : "availability.sample_fewest", sample.units,
                     states);
  else if (has_bound && by_price)
    text = say_count("availability.sample_spend_at_least", sample.units, states,
                     at_least(bound, placement.price));
  else if (has_bound)
    text = say_count("availability.sample_at_least", sample.units, states,
                     grouped(static_cast<std::size_t>(std::ceil(bound - 1e-6))));
  if (availability.certified && availability.answer().units > sample.units)
    text += " " + say_count("availability.price", availability.answer().units - sample.units);
  return text;
}

// "10 of 36 labels reached too rarely, ...": how an outcome breaks the goal.
std::string outcome_text(const Availability& availability, const StateOutcome& outcome) {
  switch (availability.goal.rule) {
    case AvailabilityRule::shop:
      return say("availability.outcome.shop", time_share(outcome.all_reached()));
    case AvailabilityRule::misses:
      return say("availability.outcome.misses", fixed(outcome.mean_missed(), 2));
    case AvailabilityRule::labels:
      break;
  }
  return say("availability.outcome.labels", grouped(outcome.below(availability.required)),
             say_count("noun.label", outcome.missed.size()), time_share(outcome.worst()),
             time_share(outcome.all_reached()));
}

std::string nominal_text(const Availability& availability) {
  const StateOutcome& nominal = availability.nominal;
  if (nominal.states == 0) return {};
  if (nominal.keeps_to(availability.goal, availability.required))
    return say_count("availability.nominal.enough", nominal.units);
  return say_count("availability.nominal.not_enough", nominal.units, outcome_text(availability, nominal));
}

std::string addition_text(const Availability& availability) {
  const auto& addition = availability.addition;
  const bool is_verification = availability.nominal.states == 0 && availability.has_answer();
  if (!addition)
    return is_verification && !availability.certified ? say("availability.no_addition") : std::string();
  const auto& [x, y, z] = addition->position;
  return say("availability.addition", addition->id, plain(x), plain(y), plain(z),
             grouped(addition->without.states), outcome_text(availability, addition->without),
             outcome_text(availability, addition->added));
}

std::string assumed_text(const Availability& availability) {
  const auto& [stocking, open_doors] = availability.assumed;
  const auto share = [](double value) { return fmt::format("{:.3g} %", 100 * value); };
  std::vector<std::string> values;
  if (stocking) {
    const auto [low, high] = *stocking;
    values.push_back(low == high ? say("availability.assumes.level", share(low))
                                 : say("availability.assumes.levels", share(low), share(high)));
  }
  if (open_doors) values.push_back(say("availability.assumes.doors", share(*open_doors)));
  return values.empty() ? std::string()
                        : say("availability.assumed", fmt::format("{}", fmt::join(values, "; ")));
}

}  // namespace

std::string time_share(double share) {
  return fmt::format("{:g} %", rounded_down(100 * share, 1));
}

std::string goal_text(const Availability& availability) {
  const AvailabilityGoal& goal = availability.goal;
  const auto exactly = [](double share) { return fmt::format("{:.6g} %", 100 * share); };
  if (goal.rule == AvailabilityRule::shop) return say("availability.goal.shop", exactly(*goal.value));
  if (goal.rule == AvailabilityRule::misses) return say("availability.goal.misses", plain(*goal.value));
  const auto [low, high] = std::minmax_element(availability.required.begin(), availability.required.end());
  if (low == availability.required.end()) return say("availability.goal.none");
  return *low == *high ? say("availability.goal.labels", exactly(*low))
                       : say("availability.goal.types", exactly(*low), exactly(*high));
}

std::string labels_by_cause(const Availability& availability, const std::vector<std::uint32_t>& labels,
                            const LabelName& name) {
  constexpr std::size_t shown = 5;
  std::vector<std::string> parts;
  for (const std::uint32_t label : labels) {
    if (parts.size() == shown) break;
    const auto found = std::find_if(availability.at_risk.begin(), availability.at_risk.end(),
                                    [&](const LabelAtRisk& one) { return one.label == label; });
    const bool has_cause =
        found != availability.at_risk.end() && !found->causes.empty() && found->causes.front().share > 0;
    std::string text = name(label);
    if (availability.has_answer())
      text = say("availability.label_share", text, time_share(availability.answer().availability(label)));
    parts.push_back(has_cause ? say("availability.label", text,
                                    words(fmt::format("availability.causes.{}", found->causes.front().cause)))
                              : text);
  }
  const std::string list = fmt::format("{}", fmt::join(parts, ", "));
  return labels.size() > shown ? say("summary.and_others", list) : list;
}

std::string availability_sentence(const Availability& availability, const Placement& placement,
                                  const LabelName& name) {
  const std::string goal = goal_text(availability);
  if (!availability.unreachable.empty())
    return say("availability.impossible", goal, labels_by_cause(availability, availability.unreachable, name),
               grouped(availability.nominal.states));
  if (std::isinf(availability.sample_lower_bound))
    return say("availability.impossible_together", goal, grouped(availability.nominal.states));
  if (availability.certified)
    return say("availability.certified", units_reach(placement.count()), goal,
               failure_clause(placement.problem), confidence_of(availability));
  std::string text =
      availability.has_answer()
          ? say_count("availability.open", placement.count(), goal, failure_clause(placement.problem))
          : say("availability.sampled", units_reach(placement.count()), goal,
                failure_clause(placement.problem), grouped(availability.nominal.states));
  if (!availability.has_answer() && availability.sample.states == 0) text = say("availability.nothing", goal);
  if (availability.open) text += " " + say("availability.ended", end_text(*availability.open));
  if (!availability.responsible.empty())
    text +=
        " " + say("availability.responsible", labels_by_cause(availability, availability.responsible, name));
  return text;
}

std::string availability_bound(const Availability& availability, const Placement& placement) {
  if (!(availability.lower_bound > 0)) return {};
  if (is_by_price(placement))
    return say("availability.spend_bound", at_least(availability.lower_bound, placement.price),
               confidence_of(availability));
  const auto bound = static_cast<std::size_t>(std::ceil(availability.lower_bound - 1e-6));
  return availability.certified && bound >= placement.count()
             ? say("availability.no_fewer", confidence_of(availability))
             : say_count("availability.bound", bound, confidence_of(availability));
}

std::vector<std::string> availability_remarks(const Availability& availability, const Placement& placement) {
  std::vector<std::string> remarks;
  for (std::string text :
       {sample_text(availability, placement), nominal_text(availability), addition_text(availability),
        say("availability.scope"), assumed_text(availability)})
    if (!text.empty()) remarks.push_back(std::move(text));
  return remarks;
}

}  // namespace shelfbeam
