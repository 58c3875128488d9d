#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/chart/charts.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"

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
  return rounded(one.lower) + " to " + rounded(one.upper);
}

std::string signed_percent(double share) {
  const std::string text = percent(share);
  return (share > 0 && text != percent(0) ? "+" : "") + text;
}

std::string tornado(const ReportData& data, const Sensitivity& sensitivity) {
  TornadoChart chart;
  chart.description = "Smallest margin with reflectances at both ends of their ranges";
  const auto add = [&](const std::string& name, const MinMargin& low, const MinMargin& high) {
    chart.bars.push_back(
        {name, drawn_db(low), drawn_db(high),
         fmt::format("{}: {} at the low end (label {}), {} at the high end (label {})", name, margin(low),
                     data.label(low.label).id, margin(high), data.label(high.label).id)});
  };
  add("all together", sensitivity.low.min_margin, sensitivity.high.min_margin);
  for (std::size_t k = 0; k < std::min(max_bars, sensitivity.materials.size()); ++k) {
    const MaterialSensitivity& one = sensitivity.materials[k];
    add(one.material + ", " + range_of(one), one.at_lower.min_margin, one.at_upper.min_margin);
  }
  chart.middle = drawn_db(sensitivity.as_given);
  chart.middle_text = "as in the store file";
  chart.limit_text = "requirement";
  chart.x_title = "smallest margin (dB)";
  std::string note = "Orange: reflectances at the low end of their range, blue: at the high end.";
  if (sensitivity.materials.size() > max_bars)
    note += fmt::format(" Only the {} materials with the largest effect are shown.", max_bars);
  return html_figure("Effect of reflectances on the smallest margin", tornado_svg(chart), note);
}

std::string material_table(const ReportData& data, const Sensitivity& sensitivity) {
  HtmlTable table({{"Material", false},
                   {"Reflectance", false},
                   {"Smallest margin, low end"},
                   {"At label", false},
                   {"Signal change there"},
                   {"Labels missed, low end"},
                   {"Mean signal change, low end"},
                   {"Smallest margin, high end"},
                   {"Mean signal change, high end"}});
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

std::string labels(const ReportData& data, const std::vector<std::uint32_t>& rows, const char* what) {
  if (rows.empty()) return {};
  std::vector<std::string> ids;
  for (const std::uint32_t row : rows) ids.push_back(data.label(row).id);
  std::string list;
  for (const std::string& range : id_ranges(ids)) list += fmt::format("<li>{}</li> ", escape(range));
  return fmt::format(
      "<details>\n<summary>{} {} at the low end</summary>\n<div class=\"serves\"><ul>{}</ul></div>\n"
      "</details>\n",
      counted(ids.size(), "label"), what, list);
}

std::string notes(const ReportData& data, const Sensitivity& sensitivity) {
  std::string text =
      "Each row sets one material to the low and to the high end of its range; all others stay as in the "
      "store file. The material with the smallest margin at its low end comes first. Margins are simulated "
      "for the chosen units with independent samples. The signal change at the label with the smallest "
      "margin is in percent of its requirement, with its standard error; the mean signal change is the "
      "average over the labels. The rows are estimates: the confidence applies only to the two simulations "
      "with all reflectances at the low end and with all at the high end.";
  if (sensitivity.watched < data.outcome.labels.size())
    text += fmt::format(" All rows consider only the {} labels with the smallest margins at the low ends.",
                        grouped(sensitivity.watched));
  if (std::any_of(sensitivity.materials.begin(), sensitivity.materials.end(),
                  [](const MaterialSensitivity& one) { return one.is_assumed; }))
    text += fmt::format(" * No range is given: {} to both sides is assumed, up to a reflectance of 0.99.",
                        percent(sensitivity.assumed_error, 0));
  if (!sensitivity.kept.empty())
    text += fmt::format(" Not varied, because refractive indices determine their reflectance: {}.",
                        fmt::join(sensitivity.kept, ", "));
  return paragraph(text, "note");
}

}  // namespace

std::string sensitivity_section(const ReportData& data) {
  const auto& sensitivity = data.input.plan.sensitivity;
  if (!sensitivity || !data.has_selection()) return {};
  const std::string beside = notes(data, *sensitivity) + labels(data, sensitivity->low.missed, "missed") +
                             labels(data, sensitivity->low.undecided, "undecided");
  return html_section(
      "sensitivity", "If surfaces reflect less or more",
      paragraph(with_joined_percent(sensitivity_sentence(*sensitivity, data.outcome.labels.size()))) +
          fmt::format("<div class=\"pair\">\n{}<div>\n{}</div>\n</div>\n", tornado(data, *sensitivity),
                      beside) +
          material_table(data, *sensitivity));
}

}  // namespace shelfbeam
