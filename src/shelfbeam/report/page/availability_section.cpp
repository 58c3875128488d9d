#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/availability.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/text/catalogue.hpp"

namespace shelfbeam {

namespace {

std::string plan_table(const Availability& availability, const PlacementProblem& problem) {
  HtmlTable table({{say("availability.column.plan"), false},
                   {say("availability.column.units")},
                   {say("availability.column.states")},
                   {say("availability.column.below")},
                   {say("availability.column.worst")},
                   {say("availability.column.all")},
                   {say("availability.column.missed")}});
  const auto add = [&](const std::string& plan, const StateOutcome& outcome) {
    if (outcome.states == 0) return;
    table.add_row({plan, grouped(outcome.units), grouped(outcome.states),
                   grouped(outcome.below(availability.required)), time_share(outcome.worst()),
                   time_share(outcome.all_reached()), fixed(outcome.mean_missed(), 2)});
  };
  add(say("availability.plan.nominal"), availability.nominal);
  const char* const sample = !availability.is_sample_minimum() ? "found"
                             : minimises_cost(problem)         ? "cheapest"
                                                               : "fewest";
  add(say(fmt::format("availability.plan.sample.{}", sample)), availability.sample);
  for (std::size_t k = 0; k < availability.examined.size(); ++k) {
    const bool is_certified = availability.certified && k + 1 == availability.examined.size();
    add(say(is_certified ? "availability.plan.certified" : "availability.plan.examined"),
        availability.examined[k]);
  }
  return table.html() + paragraph(say("availability.note"), "note");
}

// "people 80 %, stock 20 %": without causes of less than a hundredth.
std::string causes_of(const LabelAtRisk& label) {
  constexpr double least = 0.005;
  std::vector<std::string> parts;
  for (const CauseShare& cause : label.causes)
    if (cause.share >= least)
      parts.push_back(say("availability.cause", words(fmt::format("availability.causes.{}", cause.cause)),
                          percent(cause.share, 0), percent(cause.deviation, 0)));
  return parts.empty() ? say("availability.no_cause") : fmt::format("{}", fmt::join(parts, ", "));
}

std::string risk_table(const ReportData& data, const Availability& availability) {
  if (availability.at_risk.empty()) return {};
  HtmlTable table({{say("column.label"), false},
                   {say("availability.column.reached")},
                   {say("availability.column.required")},
                   {say("availability.column.causes"), false}});
  const StateOutcome& outcome = availability.has_answer()        ? availability.answer()
                                : availability.sample.states > 0 ? availability.sample
                                                                 : availability.nominal;
  for (const LabelAtRisk& label : availability.at_risk)
    table.add_row({data.label(label.label).id, time_share(outcome.availability(label.label)),
                   time_share(availability.required[label.label]), causes_of(label)});
  return fmt::format("<h3>{}</h3>\n", escape(words("availability.at_risk"))) + table.html() +
         paragraph(say("availability.cause_note"), "note");
}

}  // namespace

std::string availability_section(const ReportData& data) {
  const auto& availability = data.input.plan.availability;
  if (!availability) return {};
  const Placement& placement = data.input.plan.placement;
  const auto name = [&](std::uint32_t label) { return data.label(label).id; };
  std::string html = paragraph(with_joined_percent(availability_sentence(*availability, placement, name)));
  if (std::string bound = availability_bound(*availability, placement); !bound.empty())
    html += paragraph(with_joined_percent(std::move(bound)));
  for (std::string& remark : availability_remarks(*availability, placement))
    html += paragraph(with_joined_percent(std::move(remark)));
  return html_section("availability", say("availability.title"),
                      html + plan_table(*availability, placement.problem) + risk_table(data, *availability));
}

}  // namespace shelfbeam
