#include "shelfbeam/report/messages/availability.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/text/catalogue.hpp"

namespace shelfbeam {

namespace {

std::string confidence_of(const Availability& availability) {
  return fmt::format("{:.6g}", 100 * availability.confidence);
}

bool is_by_price(const Placement& placement) {
  return placement.problem.combination == Combination::spend;
}

std::string bound_of(const Availability& availability, const Placement& placement) {
  if (!(availability.lower_bound > 0)) return {};
  if (is_by_price(placement))
    return say("availability.spend_bound", at_least(availability.lower_bound, placement.price),
               confidence_of(availability));
  const auto bound = static_cast<std::size_t>(std::ceil(availability.lower_bound - 1e-6));
  return availability.certified && bound >= placement.count()
             ? say("availability.no_fewer", confidence_of(availability))
             : say_count("availability.bound", bound, confidence_of(availability));
}

// The fewest units on the sampled states, beside the certified ones.
std::string sample_text(const Availability& availability, const Placement& placement) {
  const StateOutcome& sample = availability.sample;
  if (sample.states == 0) return {};
  const bool is_proven = availability.sample_value <= availability.sample_lower_bound * (1 + 1e-9);
  const std::string states = grouped(sample.states);
  std::string text = say_count("availability.sample", sample.units, states);
  if (is_proven)
    text = say_count(is_by_price(placement) ? "availability.sample_cheapest" : "availability.sample_fewest",
                     sample.units, states);
  if (availability.certified && availability.answer().units > sample.units)
    text += " " + say_count("availability.price", availability.answer().units - sample.units);
  return text;
}

std::string nominal_text(const Availability& availability) {
  const StateOutcome& nominal = availability.nominal;
  if (nominal.states == 0) return {};
  const std::size_t below = nominal.below(availability.required);
  return say_count("availability.nominal", nominal.units, grouped(below),
                   say_count("noun.label", nominal.missed.size()), time_share(nominal.worst()),
                   time_share(nominal.all_reached()));
}

std::string addition_text(const Availability& availability) {
  const auto& addition = availability.addition;
  if (!addition) return {};
  const auto& required = availability.required;
  return say("availability.addition", addition->id, plain(addition->position.x), plain(addition->position.y),
             plain(addition->position.z), grouped(addition->without.states),
             say_count("noun.label", addition->without.below(required)),
             grouped(addition->added.below(required)));
}

}  // namespace

std::string time_share(double share) {
  constexpr double tenths = 1000;
  return fmt::format("{:g} %", std::floor(share * tenths + 1e-6) / (tenths / 100));
}

std::string goal_text(const Availability& availability) {
  const AvailabilityGoal& goal = availability.goal;
  if (goal.rule == AvailabilityRule::shop) return say("availability.goal.shop", time_share(*goal.value));
  if (goal.rule == AvailabilityRule::misses) return say("availability.goal.misses", plain(*goal.value));
  const auto [low, high] = std::minmax_element(availability.required.begin(), availability.required.end());
  if (low == availability.required.end()) return say("availability.goal.none");
  return *low == *high ? say("availability.goal.labels", time_share(*low))
                       : say("availability.goal.types", time_share(*low), time_share(*high));
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
    parts.push_back(has_cause ? say("availability.label", name(label),
                                    words(fmt::format("availability.causes.{}", found->causes.front().cause)))
                              : name(label));
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
  if (availability.certified)
    return say("availability.certified", units_reach(placement.count()), goal,
               failure_clause(placement.problem), confidence_of(availability));
  std::string text =
      availability.has_answer()
          ? say_count("availability.open", placement.count(), goal, failure_clause(placement.problem))
          : say("availability.sampled", units_reach(placement.count()), goal,
                failure_clause(placement.problem), grouped(availability.nominal.states));
  if (!availability.has_answer() && availability.sample.states == 0) text = say("availability.nothing", goal);
  if (!availability.open.empty()) text += " " + say("availability.ended", availability.open);
  if (!availability.responsible.empty())
    text +=
        " " + say("availability.responsible", labels_by_cause(availability, availability.responsible, name));
  return text;
}

std::vector<std::string> availability_remarks(const Availability& availability, const Placement& placement) {
  std::vector<std::string> remarks;
  for (std::string text :
       {bound_of(availability, placement), sample_text(availability, placement), nominal_text(availability),
        addition_text(availability), say("availability.scope")})
    if (!text.empty()) remarks.push_back(std::move(text));
  return remarks;
}

}  // namespace shelfbeam
