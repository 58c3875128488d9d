#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/availability.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string plan_table(const Words& words, const Availability& availability,
                       const PlacementProblem& problem) {
  HtmlTable table({{words.say("availability.column.plan"), false},
                   {words.say("availability.column.units")},
                   {words.say("availability.column.states")},
                   {words.say("availability.column.below")},
                   {words.say("availability.column.worst")},
                   {words.say("availability.column.all")},
                   {words.say("availability.column.missed")}});
  const auto add = [&](const std::string& plan, const StateOutcome& outcome) {
    if (outcome.states == 0) return;
    table.add_row({plan, words.grouped(outcome.units), words.grouped(outcome.states),
                   words.grouped(outcome.below(availability.required)), time_share(words, outcome.worst()),
                   time_share(words, outcome.all_reached()), words.fixed(outcome.mean_missed(), 2)});
  };
  add(words.say("availability.plan.nominal"), availability.nominal);
  const char* const sample = !availability.is_sample_minimum() ? "found"
                             : minimises_cost(problem)         ? "cheapest"
                                                               : "fewest";
  add(words.say(fmt::format("availability.plan.sample.{}", sample)), availability.sample);
  for (std::size_t k = 0; k < availability.examined.size(); ++k) {
    const bool is_certified = availability.certified && k + 1 == availability.examined.size();
    add(words.say(is_certified ? "availability.plan.certified" : "availability.plan.examined"),
        availability.examined[k]);
  }
  return table.html() + paragraph(words.say("availability.note"), "note");
}

// "people 80 %, stock 20 %": without causes of less than a hundredth.
std::string causes_of(const Words& words, const LabelAtRisk& label) {
  constexpr double least = 0.005;
  std::vector<std::string> parts;
  for (const CauseShare& cause : label.causes)
    if (cause.share >= least)
      parts.push_back(words.say("availability.cause",
                                words(fmt::format("availability.causes.{}", cause.cause)),
                                words.percent(cause.share, 0), words.percent(cause.deviation, 0)));
  return parts.empty() ? words.say("availability.no_cause") : fmt::format("{}", fmt::join(parts, ", "));
}

std::string risk_table(const ReportData& data, const Availability& availability) {
  if (availability.at_risk.empty()) return {};
  HtmlTable table({{data.words.say("column.label"), false},
                   {data.words.say("availability.column.reached")},
                   {data.words.say("availability.column.required")},
                   {data.words.say("availability.column.causes"), false},
                   {data.words.say("column.id"), false}});
  const StateOutcome& outcome = availability.has_answer()        ? availability.answer()
                                : availability.sample.states > 0 ? availability.sample
                                                                 : availability.nominal;
  for (const LabelAtRisk& label : availability.at_risk)
    table.add_row({data.names.name(label.label), time_share(data.words, outcome.availability(label.label)),
                   time_share(data.words, availability.required[label.label]), causes_of(data.words, label),
                   data.label(label.label).id});
  return fmt::format("<h3>{}</h3>\n", escape(data.words("availability.at_risk"))) + table.html() +
         paragraph(data.words.say("availability.cause_note"), "note");
}

}  // namespace

std::string availability_section(const ReportData& data) {
  const auto& availability = data.input.plan.availability;
  if (!availability) return {};
  const Placement& placement = data.input.plan.placement;
  const auto name = [&](LabelId label) { return data.names.name(label); };
  std::string html =
      paragraph(with_joined_percent(availability_sentence(data.words, *availability, placement, name)));
  if (std::string bound = availability_bound(data.words, *availability, placement); !bound.empty())
    html += paragraph(with_joined_percent(std::move(bound)));
  for (std::string& remark : availability_remarks(data.words, *availability, placement))
    html += paragraph(with_joined_percent(std::move(remark)));
  return html_section(
      "availability", data.words.say("availability.title"),
      html + plan_table(data.words, *availability, placement.problem) + risk_table(data, *availability));
}

}  // namespace shelfbeam
