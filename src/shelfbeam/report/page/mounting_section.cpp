#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/report/mounting/mounting_sheet.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/place/place_text.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string_view arrow(Side side) {
  constexpr const char* arrows[] = {"←", "→", "↓", "↑"};
  return arrows[static_cast<std::size_t>(side)];
}

std::string small(const std::string& text) {
  return fmt::format("<br><small>{}</small>", escape(text));
}

// The arrow shows the side of a wall.
std::string distance(const Words& words, const Reference& reference) {
  const bool is_wall = reference.kind == Reference::Kind::wall;
  return escape(words.say("mounting.distance", centimetres(reference.distance), arrow(reference.side),
                          is_wall ? words.say("mounting.any_wall") : name_of(words, reference)));
}

// A dot for a unit that points straight down or up, otherwise an arrow in plan.
std::string picture(const MountedUnit& unit) {
  const bool is_upright = unit.tilt_deg < min_tilt_deg || unit.tilt_deg > 180 - min_tilt_deg;
  return fmt::format("<svg class=\"aimed\" viewBox=\"-12 -12 24 24\" aria-hidden=\"true\">{}</svg>",
                     is_upright
                         ? "<circle r=\"9\"/><circle class=\"dot\" r=\"3\"/>"
                         : fmt::format("<path transform=\"rotate({:.0f})\" d=\"M-10 0h18m-7 -6l7 6l-7 6\"/>",
                                       -unit.towards_deg));
}

std::string height(const Scene& scene, const MountedUnit& unit) {
  const Words words = words_of(scene);
  const long cm = height_cm(unit);
  const std::string text = needs_lift(unit) ? words.say("mounting.lift", cm) : words.say("mounting.cm", cm);
  const auto below = cm_below_ceiling(scene, unit);
  return escape(text) + (below ? small(words.say("mounting.below_ceiling", *below)) : "");
}

std::string remark(const Words& words, const MountedUnit& unit) {
  const char* const key = unit.installed ? "mounting.installed" : unit.pinned ? "mounting.pinned" : nullptr;
  return key == nullptr ? "" : small(fmt::format("({})", words(key)));
}

std::string or_dash(const std::string& text) {
  return text.empty() ? "–" : escape(text);
}

bool has_tolerance(const MountedUnit& unit) {
  return unit.tolerance > 0;
}

std::string introduction(const Words& words, const std::vector<MountedUnit>& units) {
  std::string text = words.say("mounting.intro");
  if (std::any_of(units.begin(), units.end(), has_tolerance)) text += " " + words.say("mounting.tolerances");
  const auto high = static_cast<std::size_t>(std::count_if(units.begin(), units.end(), needs_lift));
  if (high > 0) text += " " + words.say_count("mounting.lifts", high, words.plain(ladder_reach));
  return text;
}

struct SheetColumn {
  const char* key;
  const char* css_class;
  const char* arrows = nullptr;  // in the place of the heading, on a telephone
};
constexpr SheetColumn number_column{"number", "n"}, done_column{"done", ""}, place_column{"place", "w"},
    across_column{"across", "", "← →"}, along_column{"along", "", "↑ ↓"}, tolerance_column{"tolerance", "n"},
    height_column{"height", "n"}, direction_column{"direction", "a"}, type_column{"type", ""},
    unit_column{"unit", ""};

using SheetCells = std::vector<std::pair<SheetColumn, std::string>>;

SheetCells cells_of(const Scene& scene, const MountedUnit& unit, bool has_tolerances) {
  const Words words = words_of(scene);
  SheetCells cells{{number_column, fmt::format("<b>{}</b>", unit.number)},
                   {done_column, unit.installed ? "–" : "<span class=\"tick-box\"></span>"},
                   {place_column, or_dash(place_text(words, unit.place))},
                   {across_column, distance(words, unit.references[0])},
                   {along_column, distance(words, unit.references[1])}};
  if (has_tolerances)
    cells.emplace_back(
        tolerance_column,
        or_dash(has_tolerance(unit) ? words.say("mounting.cm", centimetres(unit.tolerance)) : ""));
  cells.emplace_back(height_column, height(scene, unit));
  cells.emplace_back(direction_column, picture(unit) + escape(direction_of(words, unit)));
  cells.emplace_back(type_column, escape(unit.type));
  cells.emplace_back(unit_column, escape(unit.id) + remark(words, unit));
  return cells;
}

std::string heading(const Words& words, const SheetColumn& column) {
  return escape(words(fmt::format("mounting.{}", column.key)));
}

// On a telephone a row is a card, in which each cell has its heading.
std::string row(const Words& words, const SheetCells& cells) {
  std::string html;
  for (const auto& [column, text] : cells)
    html +=
        fmt::format("<td data-label=\"{}\"{}><div>{}</div></td>",
                    column.arrows != nullptr ? std::string(column.arrows) : heading(words, column),
                    *column.css_class == '\0' ? "" : fmt::format(" class=\"{}\"", column.css_class), text);
  return "<tr>" + html + "</tr>\n";
}

std::string sheet(const ReportData& data, const std::vector<MountedUnit>& units) {
  const bool has_tolerances = std::any_of(units.begin(), units.end(), has_tolerance);
  std::string head, rows;
  for (const auto& [column, text] : cells_of(data.input.scene, units.front(), has_tolerances))
    head += fmt::format("<th scope=\"col\">{}</th>", heading(data.words, column));
  for (const MountedUnit& unit : units)
    rows += row(data.words, cells_of(data.input.scene, unit, has_tolerances));
  return fmt::format(
      "<div class=\"scroll\" tabindex=\"0\"><table class=\"cards sheet\">\n<thead><tr>{}</tr></thead>\n"
      "<tbody>\n{}</tbody></table></div>\n",
      head, rows);
}

// The types of the sheet with their order numbers, fixings and pictures.
std::string type_cards(const ReportData& data, const std::vector<MountedUnit>& units) {
  std::set<std::string_view> names;
  for (const MountedUnit& unit : units) names.insert(unit.type);
  std::string cards;
  for (const std::string_view name : names) {
    const TransceiverType* const type = unit_type(data.input.scene, name);
    if (type == nullptr || (type->order_number.empty() && type->fixing.empty() && type->picture.empty()))
      continue;
    cards += "<div class=\"kind\">";
    if (!type->picture.empty())
      cards += fmt::format("<img alt=\"{}\" src=\"{}\">",
                           escape(data.words.say("mounting.picture", type->name)), escape(type->picture));
    cards += fmt::format("<div><b>{}</b>", escape(type->name));
    if (!type->order_number.empty()) cards += small(data.words.say("mounting.order", type->order_number));
    if (!type->fixing.empty()) cards += small(data.words.say("mounting.fixing", type->fixing));
    cards += "</div></div>\n";
  }
  return cards.empty() ? cards : "<div class=\"kinds\">\n" + cards + "</div>\n";
}

}  // namespace

std::string mounting_section(const ReportData& data, const Maps& maps) {
  const std::vector<MountedUnit>& units = maps.sheet();
  if (units.empty()) return {};
  return html_section(
      "mounting", data.words.say("mounting.title"),
      (data.input.plan.is_verified() ? "" : paragraph(data.words.say("certificate.lacking"), "uncertified")) +
          paragraph(introduction(data.words, units)) + type_cards(data, units) +
          maps.overview(data.words.say("mounting.drawing")) + sheet(data, units) +
          paragraph(data.words.say("mounting.files"), "note"));
}

}  // namespace shelfbeam
