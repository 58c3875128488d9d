#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/place/place_text.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

// "down", or the tilt of the axis and its direction; then the roll about the axis.
std::string direction(const Words& words, const Vec3& axis, double roll_deg) {
  constexpr double degree = std::numbers::pi / 180;
  const double tilt = std::atan2(std::hypot(axis.x, axis.y), -axis.z) / degree;
  const double towards = std::atan2(axis.y, axis.x) / degree;
  const std::string text = tilt < 0.05 ? words.say("units.down")
                           : tilt > 179.95
                               ? words.say("units.up")
                               : words.say("units.tilted", words.fixed(tilt, 1),
                                           words.fixed(towards < -0.05 ? towards + 360 : towards, 1));
  return roll_deg == 0 ? text : words.say("units.rolled", text, words.plain(roll_deg));
}

std::string served_labels(const ReportData& data) {
  std::string list;
  for (std::size_t k = 0; k < data.outcome.units.size(); ++k) {
    const UnitOutcome& unit = data.outcome.units[k];
    const std::vector<LabelId> labels = data.outcome.served_by(k);
    const std::string how = unit.reaches_alone > 0 ? data.words.say_count("units.serves.alone", labels.size())
                            : labels.empty()       ? data.words.say("units.serves.none")
                                             : data.words.say_count("units.serves.strongest", labels.size());
    list += fmt::format("<dt>{}: {} <span>{}</span></dt><dd><ul>", k + 1,
                        escape(data.transceiver(unit.column).id), escape(how));
    for (const std::string& count : data.names.counts(labels))
      list += fmt::format("<li>{}</li> ", escape(count));
    list += "</ul></dd>\n";
  }
  return fmt::format("<details>\n<summary>{}</summary>\n<dl class=\"serves\">\n{}</dl>\n</details>\n",
                     escape(data.words("units.serves.title")), list);
}

std::string verdict_text(const Words& words, Verdict verdict) {
  constexpr const char* names[] = {"reached", "missed", "undecided", "unverified"};
  return words.say(fmt::format("weakest.verdicts.{}", names[static_cast<std::size_t>(verdict)]));
}

}  // namespace

std::string unit_section(const ReportData& data, const Maps& maps) {
  if (!data.has_selection()) return {};
  HtmlTable table({{data.words.say("units.number")},
                   {data.words.say("units.unit"), false},
                   {data.words.say("units.place"), false, true},
                   {data.words.say("column.x")},
                   {data.words.say("column.y")},
                   {data.words.say("column.height")},
                   {data.words.say("units.alone")},
                   {data.words.say("units.strongest")},
                   {data.words.say("units.needed")},
                   {data.words.say("column.type"), false},
                   {data.words.say("units.direction"), false}});
  for (std::size_t k = 0; k < data.outcome.units.size(); ++k) {
    const UnitOutcome& unit = data.outcome.units[k];
    const TransceiverColumn& transceiver = data.transceiver(unit.column);
    const MountedUnit& mounted = maps.sheet()[k];
    table.add_row({data.words.grouped(k + 1),
                   transceiver.installed ? data.words.say("units.installed", transceiver.id)
                   : transceiver.pinned  ? data.words.say("units.pinned", transceiver.id)
                                         : transceiver.id,
                   place_text(data.words, mounted.place), data.words.fixed(transceiver.position.x, 2),
                   data.words.fixed(transceiver.position.y, 2), data.words.fixed(transceiver.position.z, 2),
                   data.words.grouped(unit.reaches_alone), data.words.grouped(unit.strongest_for),
                   data.words.grouped(unit.needed_by), transceiver.type,
                   direction(data.words, transceiver.axis, mounted.roll_deg)});
  }
  return html_section("units", data.words.say("units.title"),
                      table.html() + paragraph(data.words.say("units.note"), "note") + served_labels(data));
}

std::string weakest_section(const ReportData& data) {
  if (!data.has_selection()) return {};
  constexpr std::size_t max_rows = 20;
  const std::size_t rows = std::min(max_rows, data.outcome.by_margin.size());
  const auto& certificate = data.input.plan.certificate;
  const std::string& unit = data.unit.name;
  std::vector<HtmlTable::Column> columns{{data.words.say("column.label"), false},
                                         {data.words.say("weakest.margin")},
                                         {data.words.say("weakest.signal", unit)},
                                         {data.words.say("weakest.requirement", unit)},
                                         {data.words.say("weakest.strongest"), false},
                                         {data.words.say("weakest.error", unit)},
                                         {data.words.say("column.x")},
                                         {data.words.say("column.y")},
                                         {data.words.say("column.height")},
                                         {data.words.say("column.type"), false},
                                         {data.words.say("column.id"), false}};
  if (certificate) columns.push_back({data.words.say("weakest.verdict"), false});
  HtmlTable table(columns);
  for (std::size_t k = 0; k < rows; ++k) {
    const LabelId row = data.outcome.by_margin[k];
    const LabelOutcome& outcome = data.outcome.labels[row];
    const LabelRow& label = data.label(row);
    std::string strongest = "–", error = "–";
    if (outcome.strongest) {
      strongest = fmt::format("{}: {}", data.unit_number(*outcome.strongest),
                              data.transceiver(*outcome.strongest).id);
      const std::size_t entry = data.input.matrix.at(row, *outcome.strongest);
      if (data.sampling.has_errors)
        error = data.unit.number(static_cast<double>(data.input.matrix.standard_error[entry]));
      if (data.input.matrix.is_flagged(entry)) error = data.words.say("weakest.unreliable", error);
    }
    std::vector<std::string> cells{data.names.name(row),
                                   data.words.decibels(outcome.margin()),
                                   data.unit.number(outcome.signal),
                                   data.unit.number(outcome.requirement),
                                   strongest,
                                   error,
                                   data.words.fixed(label.position.x, 2),
                                   data.words.fixed(label.position.y, 2),
                                   data.words.fixed(label.position.z, 2),
                                   label.type,
                                   label.id};
    if (certificate) cells.push_back(verdict_text(data.words, certificate->labels[row].verdict));
    table.add_row(cells);
  }
  return html_section("weakest", data.words.say_count("weakest.title", rows),
                      table.html() + paragraph(data.words.say("weakest.note"), "note"));
}

}  // namespace shelfbeam
