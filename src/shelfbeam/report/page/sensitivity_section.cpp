#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/chart/charts.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

constexpr std::size_t max_materials = 12;
constexpr double lowest_db = -30;  // smaller margins are drawn at this value

double drawn_db(const MinMargin& min_margin) {
  return std::max(margin_db(min_margin.ratio, 1), lowest_db);
}

// Two decimals: materials differ by less than a tenth.
std::string margin(const Words& words, const MinMargin& min_margin) {
  return words.decibels(margin_db(min_margin.ratio, 1), 2);
}

std::string rounded(const Words& words, double reflectance) {
  return words.plain(std::round(1000 * reflectance) / 1000);
}

std::string range_of(const Words& words, const MaterialSensitivity& one) {
  return words.say("sensitivity.range", rounded(words, one.lower), rounded(words, one.upper));
}

std::string signed_percent(const Words& words, double share) {
  const std::string text = words.percent(share);
  return (share > 0 && text != words.percent(0) ? "+" : "") + text;
}

std::string tornado(const ReportData& data, const Sensitivity& sensitivity) {
  TornadoChart chart;
  chart.description = data.words.say("sensitivity.description");
  const auto label = [&](const MinMargin& one) {
    const std::string &called = data.names.name(one.label), &id = data.label(one.label).id;
    return called == id ? id : fmt::format("{}, {}", called, id);
  };
  const auto add = [&](const std::string& name, const MinMargin& low, const MinMargin& high) {
    chart.bars.push_back({name, drawn_db(low), drawn_db(high),
                          data.words.say("sensitivity.bar", name, margin(data.words, low), label(low),
                                         margin(data.words, high), label(high))});
  };
  add(data.words.say("sensitivity.together"), sensitivity.low.min_margin, sensitivity.high.min_margin);
  for (std::size_t k = 0; k < std::min(max_materials, sensitivity.materials.size()); ++k) {
    const MaterialSensitivity& one = sensitivity.materials[k];
    add(data.words.say("sensitivity.one", one.material, range_of(data.words, one)), one.at_lower.min_margin,
        one.at_upper.min_margin);
  }
  chart.middle = drawn_db(sensitivity.as_given);
  chart.middle_text = data.words.say("sensitivity.as_given");
  chart.limit_text = data.words.say("sensitivity.limit");
  chart.x_title = data.words.say("sensitivity.x");
  std::string note = data.words.say("sensitivity.key");
  if (sensitivity.materials.size() > max_materials)
    note += " " + data.words.say("sensitivity.shown", max_materials);
  return html_figure(data.words.say("sensitivity.figure"), tornado_svg(data.words, chart), note);
}

std::string material_table(const ReportData& data, const Sensitivity& sensitivity) {
  HtmlTable table({{data.words.say("sensitivity.column.material"), false},
                   {data.words.say("sensitivity.column.reflectance"), false},
                   {data.words.say("sensitivity.column.low_margin")},
                   {data.words.say("sensitivity.column.label"), false},
                   {data.words.say("column.id"), false},
                   {data.words.say("sensitivity.column.change")},
                   {data.words.say("sensitivity.column.missed")},
                   {data.words.say("sensitivity.column.low_change")},
                   {data.words.say("sensitivity.column.high_margin")},
                   {data.words.say("sensitivity.column.high_change")}});
  for (const MaterialSensitivity& one : sensitivity.materials)
    table.add_row(
        {one.material,
         fmt::format("{} ({}){}", rounded(data.words, one.reflectance), range_of(data.words, one),
                     one.is_assumed ? " *" : ""),
         margin(data.words, one.at_lower.min_margin), data.names.name(one.at_lower.min_margin.label),
         data.label(one.at_lower.min_margin.label).id,
         fmt::format("{} (±\u00A0{})", signed_percent(data.words, one.at_lower.change),
                     data.words.fixed(100 * one.at_lower.change_error, 2)),
         data.words.grouped(one.at_lower.labels_short), signed_percent(data.words, one.at_lower.mean_change),
         margin(data.words, one.at_upper.min_margin), signed_percent(data.words, one.at_upper.mean_change)});
  return table.html();
}

std::string labels(const ReportData& data, const std::vector<LabelId>& rows, std::string_view title) {
  if (rows.empty()) return {};
  std::string list;
  for (const std::string& count : data.names.counts(rows)) list += fmt::format("<li>{}</li> ", escape(count));
  return fmt::format(
      "<details>\n<summary>{}</summary>\n<div class=\"serves\"><ul>{}</ul></div>\n</details>\n",
      escape(data.words.say_count(title, rows.size())), list);
}

std::string notes(const ReportData& data, const Sensitivity& sensitivity) {
  std::string text = data.words.say("sensitivity.note");
  if (sensitivity.watched < data.outcome.labels.size())
    text += " " + data.words.say("sensitivity.watched", data.words.grouped(sensitivity.watched));
  if (std::any_of(sensitivity.materials.begin(), sensitivity.materials.end(),
                  [](const MaterialSensitivity& one) { return one.is_assumed; }))
    text += " " + data.words.say("sensitivity.assumed", data.words.percent(sensitivity.assumed_error, 0));
  if (!sensitivity.kept.empty())
    text += " " + data.words.say("sensitivity.kept", fmt::format("{}", fmt::join(sensitivity.kept, ", ")));
  return paragraph(text, "note");
}

}  // namespace

std::string sensitivity_section(const ReportData& data) {
  const auto& sensitivity = data.input.plan.sensitivity;
  if (!sensitivity || !data.has_selection()) return {};
  const std::string beside = notes(data, *sensitivity) +
                             labels(data, sensitivity->low.missed, "sensitivity.missed") +
                             labels(data, sensitivity->low.undecided, "sensitivity.undecided");
  return html_section("sensitivity", data.words.say("sensitivity.title"),
                      paragraph(with_joined_percent(
                          sensitivity_sentence(data.words, data.input.plan, data.outcome.labels.size()))) +
                          fmt::format("<div class=\"pair\">\n{}<div>\n{}</div>\n</div>\n",
                                      tornado(data, *sensitivity), beside) +
                          material_table(data, *sensitivity));
}

}  // namespace shelfbeam
