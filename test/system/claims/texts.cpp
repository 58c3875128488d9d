#include "system/claims/texts.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/report/messages/headline.hpp"
#include "shelfbeam/report/messages/known_values.hpp"
#include "shelfbeam/report/messages/open_bound.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/recommendation.hpp"
#include "shelfbeam/report/messages/summary.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/terminal/placement_text.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam::test {

namespace {

std::string between(std::string_view html, std::string_view begin, std::string_view end) {
  const std::size_t from = html.find(begin) + begin.size();
  return std::string(html.substr(from, html.find(end, from) - from));
}

// The facts of a placement and of its certificate as lines "Placement: Transceivers: 4", without those that
// claim nothing.
std::vector<Text> facts_of(const ReportData& data) {
  const std::set<std::string> names{
      "Transceivers",   "Gap of the count", "Objective value", "Gap of the objective", "Joint confidence",
      "Labels reached", "Missed",           "Undecided",       "Not verified yet",     "Proven from"};
  std::vector<Text> lines;
  const std::string html = facts_section(data);
  std::string title;
  for (std::size_t at = 0; (at = std::min(html.find("<h3>", at), html.find("<dt>", at))) != std::string::npos;
       ++at) {
    const std::string_view rest = std::string_view(html).substr(at);
    if (rest.starts_with("<h3>")) {
      title = between(rest, "<h3>", "</h3>");
      continue;
    }
    const std::string name = between(rest, "<dt>", "</dt>");
    if (title != "Placement" && title != "Certificate from independent samples") continue;
    if (names.contains(name) || name.starts_with("Lower bound"))
      lines.push_back({fmt::format("{}: {}: {}\n", title, name, between(rest, "<dd>", "</dd>"))});
  }
  return lines;
}

// The cells of the page's table of alternatives: "Alternatives, This plan, Units: 4".
std::vector<Text> alternatives_of(const ReportInput& input) {
  std::vector<Text> cells;
  const std::string page = report_html(input);
  const std::size_t at = page.find("<h2>Alternatives</h2>");
  if (at == std::string::npos) return cells;
  const std::string table = between(std::string_view(page).substr(at), "<table", "</table>");
  std::vector<std::string> heads;
  std::string choice;
  std::size_t column = 0;
  for (std::size_t k = 0; (k = table.find('<', k)) != std::string::npos; ++k) {
    const std::string_view rest = std::string_view(table).substr(k);
    if (rest.starts_with("<tr")) column = 0;
    if (rest.starts_with("<th") && !rest.starts_with("<thead")) heads.push_back(between(rest, ">", "</th>"));
    if (!rest.starts_with("<td")) continue;
    const std::string cell = between(rest, ">", "</td>");
    if (column == 0) choice = cell;
    if (column > 0 && cell != "–")
      cells.push_back({fmt::format("Alternatives, {}, {}: {}\n", choice, heads.at(column), cell)});
    ++column;
  }
  return cells;
}

}  // namespace

std::vector<Text> texts_of(const PlannedStore& store) {
  const CertifiedPlan& plan = store.plan;
  const Subject examined = plan.certificate ? Subject::certificate : Subject::signals;
  std::vector<Text> texts{
      {certificate_sentence(english(), plan), Subject::certificate},
      {open_bound(english(), plan)},
      {remedy_for(english(), plan).after("")},
      {describe(plan.alternatives, plan.placement, store.table, plan.has_known_thresholds())}};
  if (plan.availability) {
    texts.push_back({availability_answer(*plan.availability, plan.placement, store.table)});
    texts.push_back({availability_details(*plan.availability, plan.placement, store.table)});
  } else {
    texts.push_back({describe(plan.placement, store.table)});
  }
  const ReportInput input{store.scene, store.matrix, plan};
  const ReportData data(input);
  const Headline line = headline(data);
  texts.push_back({line.answer, examined});
  for (const std::string& remark : line.remarks) texts.push_back({remark});
  const Summary summary = summary_of(data);
  texts.push_back({summary.verdict});
  texts.push_back({summary.assumed});
  texts.push_back({basis_of(english(), plan)});
  texts.push_back({recommendation(data)});
  texts.push_back({summary.answer});
  for (const auto& list : {summary.remarks, summary.achieves, summary.risks})
    for (const std::string& sentence : list) texts.push_back({sentence});
  for (Text& fact : facts_of(data)) texts.push_back(std::move(fact));
  if (!plan.alternatives.empty())
    for (Text& cell : alternatives_of(input)) texts.push_back(std::move(cell));
  return texts;
}

}  // namespace shelfbeam::test
