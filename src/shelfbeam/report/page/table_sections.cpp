#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"

namespace shelfbeam {

namespace {

// "down", or the tilt of the axis and its direction; then the roll about the axis.
std::string direction(const Vec3& axis, double roll_deg) {
  constexpr double degree = std::numbers::pi / 180;
  const double tilt = std::atan2(std::hypot(axis.x, axis.y), -axis.z) / degree;
  const double towards = std::atan2(axis.y, axis.x) / degree;
  std::string text = tilt < 0.05     ? "down"
                     : tilt > 179.95 ? "up"
                                     : fmt::format("{}° towards {}°", fixed(tilt, 1),
                                                   fixed(towards < -0.05 ? towards + 360 : towards, 1));
  if (roll_deg != 0) text += fmt::format(", roll {}°", plain(roll_deg));
  return text;
}

std::string served_labels(const ReportData& data) {
  std::string list;
  for (std::size_t k = 0; k < data.outcome.units.size(); ++k) {
    const UnitOutcome& unit = data.outcome.units[k];
    std::vector<std::string> ids;
    for (const std::uint32_t row : data.outcome.served_by(k)) ids.push_back(data.label(row).id);
    const char* const how = unit.reaches_alone > 0 ? "reaches alone:"
                            : ids.empty()          ? "is strongest for no label"
                                                   : "reaches no label alone; is strongest for";
    list += fmt::format("<dt>{}: {} <span>{}{}</span></dt><dd><ul>", k + 1,
                        escape(data.transceiver(unit.column).id), how,
                        ids.empty() ? "" : " " + counted(ids.size(), "label"));
    for (const std::string& range : id_ranges(ids)) list += fmt::format("<li>{}</li> ", escape(range));
    list += "</ul></dd>\n";
  }
  return fmt::format(
      "<details>\n<summary>Labels served by each unit</summary>\n"
      "<dl class=\"serves\">\n{}</dl>\n</details>\n",
      list);
}

}  // namespace

std::string unit_section(const ReportData& data) {
  if (!data.has_selection()) return {};
  std::map<std::string_view, double> roll_deg;
  for (const Transceiver& unit : data.input.scene.transceivers) roll_deg.emplace(unit.id, unit.roll_deg);
  HtmlTable table({{"No."},
                   {"Unit", false},
                   {"x (m)"},
                   {"y (m)"},
                   {"Height (m)"},
                   {"Reaches alone"},
                   {"Strongest for"},
                   {"Needed by"},
                   {"Type", false},
                   {"Direction", false}});
  for (std::size_t k = 0; k < data.outcome.units.size(); ++k) {
    const UnitOutcome& unit = data.outcome.units[k];
    const TransceiverColumn& transceiver = data.transceiver(unit.column);
    table.add_row({grouped(k + 1), transceiver.id + (transceiver.installed ? " (installed)" : ""),
                   fixed(transceiver.position.x, 2), fixed(transceiver.position.y, 2),
                   fixed(transceiver.position.z, 2), grouped(unit.reaches_alone), grouped(unit.strongest_for),
                   grouped(unit.needed_by), transceiver.type,
                   direction(transceiver.axis, roll_deg[transceiver.id])});
  }
  return html_section(
      "units", "The chosen units",
      table.html() +
          paragraph(
              "Reaches alone: labels that the unit reaches without other units. Strongest for: labels that "
              "receive their largest signal from the unit. Needed by: labels that would be missed without "
              "the unit. A direction other than down is a tilt from down towards an angle in the floor "
              "plan, 0° along x and 90° along y.",
              "note") +
          served_labels(data));
}

std::string weakest_section(const ReportData& data) {
  if (!data.has_selection()) return {};
  constexpr std::size_t max_rows = 20;
  const std::size_t rows = std::min(max_rows, data.outcome.by_margin.size());
  const auto& certificate = data.input.plan.certificate;
  const std::string in_unit = fmt::format(" ({})", data.unit.name);
  std::vector<HtmlTable::Column> columns{{"Label", false},
                                         {"Margin"},
                                         {"Signal" + in_unit},
                                         {"Requirement" + in_unit},
                                         {"Strongest unit", false},
                                         {"Standard error of this unit's signal" + in_unit},
                                         {"x (m)"},
                                         {"y (m)"},
                                         {"Height (m)"},
                                         {"Type", false}};
  if (certificate) columns.push_back({"Verdict", false});
  HtmlTable table(columns);
  for (std::size_t k = 0; k < rows; ++k) {
    const std::uint32_t row = data.outcome.by_margin[k];
    const LabelOutcome& outcome = data.outcome.labels[row];
    const LabelRow& label = data.label(row);
    std::string strongest = "–", error = "–";
    if (outcome.strongest) {
      strongest = fmt::format("{}: {}", data.unit_number(*outcome.strongest),
                              data.transceiver(*outcome.strongest).id);
      const std::size_t entry = data.input.matrix.at(row, *outcome.strongest);
      if (data.sampling.has_errors)
        error = data.unit.number(static_cast<double>(data.input.matrix.standard_error[entry]));
      if (data.input.matrix.is_flagged(entry)) error += " (not reliable)";
    }
    std::vector<std::string> cells{label.id,
                                   decibels(outcome.margin()),
                                   data.unit.number(outcome.signal),
                                   data.unit.number(outcome.requirement),
                                   strongest,
                                   error,
                                   fixed(label.position.x, 2),
                                   fixed(label.position.y, 2),
                                   fixed(label.position.z, 2),
                                   label.type};
    if (certificate) cells.emplace_back(to_text(certificate->labels[row].verdict));
    table.add_row(cells);
  }
  return html_section("weakest",
                      rows == 1 ? "The label" : fmt::format("The {} labels with the smallest margin", rows),
                      table.html() + paragraph("labels.csv lists all labels.", "note"));
}

}  // namespace shelfbeam
