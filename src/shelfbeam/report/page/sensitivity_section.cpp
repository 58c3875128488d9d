#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/chart/charts.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/text/catalogue.hpp"

namespace shelfbeam {

namespace {

constexpr std::size_t max_bars = 12;
constexpr double lowest_db = -30;  // smaller margins are drawn at this value

double drawn_db(const MinMargin& min_margin) {
  return std::max(margin_db(min_margin.ratio, 1), lowest_db);
}

// Two decimals: materials differ by less than a tenth.
std::string margin(const MinMargin& min_margin) {
  return decibels(margin_db(min_margin.ratio, 1), 2);
}

std::string rounded(double reflectance) {
  return plain(std::round(1000 * reflectance) / 1000);
}

std::string range_of(const MaterialSensitivity& one) {
  return say("sensitivity.range", rounded(one.lower), rounded(one.upper));
}

std::string signed_percent(double share) {
  const std::string text = percent(share);
  return (share > 0 && text != percent(0) ? "+" : "") + text;
}

std::string tornado(const ReportData& data, const Sensitivity& sensitivity) {
  TornadoChart chart;
  chart.description = say("sensitivity.description");
  const auto add = [&](const std::string& name, const MinMargin& low, const MinMargin& high) {
    chart.bars.push_back({name, drawn_db(low), drawn_db(high),
                          say("sensitivity.bar", name, margin(low), data.label(low.label).id, margin(high),
                              data.label(high.label).id)});
  };
  add(say("sensitivity.together"), sensitivity.low.min_margin, sensitivity.high.min_margin);
  for (std::size_t k = 0; k < std::min(max_bars, sensitivity.materials.size()); ++k) {
    const MaterialSensitivity& one = sensitivity.materials[k];
    add(say("sensitivity.one", one.material, range_of(one)), one.at_lower.min_margin,
        one.at_upper.min_margin);
  }
  chart.middle = drawn_db(sensitivity.as_given);
  chart.middle_text = say("sensitivity.as_given");
  chart.limit_text = say("sensitivity.limit");
  chart.x_title = say("sensitivity.x");
  std::string note = say("sensitivity.key");
  if (sensitivity.materials.size() > max_bars) note += " " + say("sensitivity.shown", max_bars);
  return html_figure(say("sensitivity.figure"), tornado_svg(chart), note);
}

std::string material_table(const ReportData& data, const Sensitivity& sensitivity) {
  HtmlTable table({{say("sensitivity.column.material"), false},
                   {say("sensitivity.column.reflectance"), false},
                   {say("sensitivity.column.low_margin")},
                   {say("sensitivity.column.label"), false},
                   {say("sensitivity.column.change")},
                   {say("sensitivity.column.missed")},
                   {say("sensitivity.column.low_change")},
                   {say("sensitivity.column.high_margin")},
                   {say("sensitivity.column.high_change")}});
  for (const MaterialSensitivity& one : sensitivity.materials)
    table.add_row(
        {one.material,
         fmt::format("{} ({}){}", rounded(one.reflectance), range_of(one), one.is_assumed ? " *" : ""),
         margin(one.at_lower.min_margin), data.label(one.at_lower.min_margin.label).id,
         fmt::format("{} (±\u00A0{})", signed_percent(one.at_lower.change),
                     fixed(100 * one.at_lower.change_error, 2)),
         grouped(one.at_lower.labels_short), signed_percent(one.at_lower.mean_change),
         margin(one.at_upper.min_margin), signed_percent(one.at_upper.mean_change)});
  return table.html();
}

std::string labels(const ReportData& data, const std::vector<std::uint32_t>& rows, std::string_view title) {
  if (rows.empty()) return {};
  std::vector<std::string> ids;
  ids.reserve(rows.size());
  for (const std::uint32_t row : rows) ids.push_back(data.label(row).id);
  std::string list;
  for (const std::string& range : id_ranges(ids)) list += fmt::format("<li>{}</li> ", escape(range));
  return fmt::format(
      "<details>\n<summary>{}</summary>\n<div class=\"serves\"><ul>{}</ul></div>\n</details>\n",
      escape(say_count(title, ids.size())), list);
}

std::string notes(const ReportData& data, const Sensitivity& sensitivity) {
  std::string text = say("sensitivity.note");
  if (sensitivity.watched < data.outcome.labels.size())
    text += " " + say("sensitivity.watched", grouped(sensitivity.watched));
  if (std::any_of(sensitivity.materials.begin(), sensitivity.materials.end(),
                  [](const MaterialSensitivity& one) { return one.is_assumed; }))
    text += " " + say("sensitivity.assumed", percent(sensitivity.assumed_error, 0));
  if (!sensitivity.kept.empty())
    text += " " + say("sensitivity.kept", fmt::format("{}", fmt::join(sensitivity.kept, ", ")));
  return paragraph(text, "note");
}

}  // namespace

std::string sensitivity_section(const ReportData& data) {
  const auto& sensitivity = data.input.plan.sensitivity;
  if (!sensitivity || !data.has_selection()) return {};
  const std::string beside = notes(data, *sensitivity) +
                             labels(data, sensitivity->low.missed, "sensitivity.missed") +
                             labels(data, sensitivity->low.undecided, "sensitivity.undecided");
  return html_section(
      "sensitivity", say("sensitivity.title"),
      paragraph(with_joined_percent(sensitivity_sentence(*sensitivity, data.outcome.labels.size()))) +
          fmt::format("<div class=\"pair\">\n{}<div>\n{}</div>\n</div>\n", tornado(data, *sensitivity),
                      beside) +
          material_table(data, *sensitivity));
}

}  // namespace shelfbeam
