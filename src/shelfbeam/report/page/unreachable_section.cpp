#include <algorithm>

#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string shortfall(const ReportData& data, const Unreachable& label) {
  if (label.max_signal <= 0)
    return std::string(
        no_signal_reason(data.words, data.input.plan.placement.problem, data.is_heard(label.label)));
  const double db = -margin_db(label.max_signal, label.requirement);
  return data.words.fixed(db, db < 0.095 ? 2 : 1) + "\u00A0dB";
}

std::string maximum_signal_note(const ReportData& data) {
  const PlacementProblem& problem = data.input.plan.placement.problem;
  if (problem.model == CommunicationModel::cooperative)
    return data.words.say("unreachable.together", maximum_signal_condition(data));
  return data.words.say(problem.redundant ? "unreachable.single_failure" : "unreachable.single");
}

}  // namespace

std::string unreachable_section(const ReportData& data) {
  const auto& unreachable = data.input.plan.placement.unreachable;
  if (unreachable.empty()) return {};
  constexpr std::size_t max_rows = 100;
  std::vector<Unreachable> worst = unreachable;
  std::stable_sort(worst.begin(), worst.end(), [](const Unreachable& a, const Unreachable& b) {
    return margin_db(a.max_signal, a.requirement) < margin_db(b.max_signal, b.requirement);
  });
  HtmlTable table({{data.words.say("column.label"), false},
                   {data.words.say("column.x")},
                   {data.words.say("column.y")},
                   {data.words.say("column.height")},
                   {data.words.say("unreachable.requirement", data.unit.name)},
                   {data.words.say("unreachable.maximum", data.unit.name)},
                   {data.words.say("unreachable.shortfall"), true, true},
                   {data.words.say("column.id"), false}});
  for (std::size_t k = 0; k < std::min(worst.size(), max_rows); ++k) {
    const LabelRow& label = data.label(worst[k].label);
    table.add_row({data.names.name(worst[k].label), data.words.fixed(label.position.x, 2),
                   data.words.fixed(label.position.y, 2), data.words.fixed(label.position.z, 2),
                   data.unit.number(worst[k].requirement), data.unit.number(worst[k].max_signal),
                   shortfall(data, worst[k]), label.id});
  }
  std::string html = paragraph(maximum_signal_note(data)) + table.html();
  if (worst.size() > max_rows)
    html += paragraph(data.words.say("unreachable.note", max_rows, data.words.grouped(worst.size())), "note");
  return html_section("unreachable", data.words.say("unreachable.title"), html);
}

}  // namespace shelfbeam
