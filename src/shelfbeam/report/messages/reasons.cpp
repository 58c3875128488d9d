#include "shelfbeam/report/messages/reasons.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

bool is_verification(const Availability& availability) {
  return availability.nominal.states == 0;
}

// "5 (at least 4)".
std::string units_text(const Words& words, std::size_t units, double bound) {
  const auto least = static_cast<std::size_t>(std::ceil(bound - 1e-6));
  return least == 0 || least >= units
             ? words.grouped(units)
             : words.say("reasons.at_least", words.grouped(units), words.grouped(least));
}

std::string units_alone(const Words& words, const CauseAlone& cause, bool has_bound) {
  if (!cause.unreachable.empty()) return words.say_count("reasons.out_of_reach", cause.unreachable.size());
  if (std::isinf(cause.lower_bound)) return words.say("reasons.impossible");
  if (cause.units == 0) return words.say("reasons.unknown");
  return units_text(words, cause.units, has_bound ? cause.lower_bound : 0);
}

// "Dark surfaces alone take 60 labels, people 12": those that take any, the largest first.
std::string shares(const Words& words, const Availability& availability) {
  std::vector<CauseAlone> causes = availability.alone;
  std::erase_if(causes, [](const CauseAlone& one) { return one.taken.empty(); });
  std::stable_sort(causes.begin(), causes.end(),
                   [](const CauseAlone& a, const CauseAlone& b) { return a.taken.size() > b.taken.size(); });
  if (availability.alone.empty()) return {};
  if (causes.empty()) return " " + words.say("reasons.only_together");
  std::vector<std::string> parts;
  parts.reserve(causes.size());
  for (const CauseAlone& one : causes)
    parts.push_back(words.say(
        "reasons.share", change_name(words, one.cause),
        parts.empty() ? words.say_count("noun.label", one.taken.size()) : words.grouped(one.taken.size())));
  std::set<LabelId> taken;
  for (const CauseAlone& one : causes) taken.insert(one.taken.begin(), one.taken.end());
  std::string text = " " + words.say("reasons.shares", fmt::format("{}", fmt::join(parts, ", ")));
  const std::size_t all = availability.nominal.below(availability.required);
  if (all > taken.size()) text += " " + words.say_count("reasons.rest", all - taken.size());
  return text;
}

}  // namespace

std::string_view change_name(const Words& words, const std::string& cause) {
  return words(fmt::format("reasons.changes.{}", cause));
}

std::vector<ReasonRow> reason_rows(const Words& words, const Availability& availability,
                                   const Placement& placement) {
  std::vector<ReasonRow> rows;
  if (availability.alone.empty()) return rows;
  const bool verifies = is_verification(availability),
             has_bound = placement.problem.combination != Combination::spend;
  rows.push_back({words.say("reasons.given"), words.grouped(availability.missed_as_given),
                  units_text(words, availability.nominal.units,
                             has_bound ? static_cast<double>(availability.nominal_bound) : 0)});
  for (const CauseAlone& cause : availability.alone)
    rows.push_back({std::string(change_name(words, cause.cause)), words.grouped(cause.taken.size()),
                    units_alone(words, cause, has_bound)});
  if (verifies && !availability.has_answer()) return rows;
  const StateOutcome& all = verifies ? availability.answer() : availability.nominal;
  std::string units = words.say("reasons.unknown");
  if (availability.is_impossible())
    units = availability.unreachable.empty()
                ? words.say("reasons.impossible")
                : words.say_count("reasons.out_of_reach", availability.unreachable.size());
  else if (availability.has_answer() || availability.sample.states > 0)
    units = units_text(words, placement.count(), has_bound ? availability.lower_bound : 0);
  rows.push_back(
      {words.say("reasons.together"), words.grouped(all.below(availability.required)), std::move(units)});
  return rows;
}

std::string reasons_note(const Words& words, const Availability& availability) {
  const auto most =
      std::max_element(availability.alone.begin(), availability.alone.end(),
                       [](const CauseAlone& a, const CauseAlone& b) { return a.states < b.states; });
  const std::size_t states = most == availability.alone.end() ? 0 : most->states;
  return is_verification(availability)
             ? words.say("reasons.note_mounted", words.grouped(states))
             : words.say_count("reasons.note", availability.nominal.units, words.grouped(states));
}

std::string states_recommendation(const Words& words, const Availability& availability,
                                  const Placement& placement) {
  if (is_verification(availability) || availability.is_impossible() ||
      !(availability.has_answer() || availability.sample.states > 0))
    return {};
  const StateOutcome& nominal = availability.nominal;
  const std::string plan = words.say_count(
      availability.certified ? "recommendation.states.certified" : "recommendation.states.open",
      placement.count());
  if (nominal.keeps_to(availability.goal, availability.required))
    return plan + " " + words.say("recommendation.states.enough");
  const std::string effect =
      availability.goal.rule == AvailabilityRule::labels
          ? words.say_count("recommendation.states.labels", nominal.below(availability.required))
          : words.say("recommendation.states.goal");
  return plan + " " + words.say_count("recommendation.states.nominal", nominal.units, effect) +
         shares(words, availability);
}

std::string cause_of_loss(const Words& words, const Availability& availability, LabelId label) {
  const auto found = std::find_if(availability.lost.begin(), availability.lost.end(),
                                  [&](const LostLabel& one) { return one.label == label; });
  if (found == availability.lost.end()) return {};
  if (found->causes.empty()) return words.say("reasons.several");
  std::vector<std::string_view> names;
  for (const std::string& cause : found->causes) names.push_back(change_name(words, cause));
  return fmt::format("{}", fmt::join(names, words.say("reasons.or")));
}

std::string lost_sentence(const Words& words, const Availability& availability,
                          const std::function<std::string(LabelId)>& name) {
  constexpr std::size_t shown = 5;
  if (availability.lost.empty()) return {};
  std::vector<std::string> parts;
  for (const LostLabel& one : availability.lost)
    if (parts.size() < shown)
      parts.push_back(
          words.say("availability.label", name(one.label), cause_of_loss(words, availability, one.label)));
  const std::string list = fmt::format("{}", fmt::join(parts, ", "));
  return words.say("reasons.lost",
                   availability.lost.size() > shown ? words.say("summary.and_others", list) : list);
}

}  // namespace shelfbeam
