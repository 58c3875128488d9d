#include <fmt/format.h>

#include "shelfbeam/report/mounting/mounting_sheet.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string_view arrow(Side side) {
  constexpr const char* arrows[] = {"←", "→", "↓", "↑"};
  return arrows[static_cast<std::size_t>(side)];
}

std::string cell(const std::string& html, const char* css_class = "") {
  return fmt::format("<td{}>{}</td>", *css_class == '\0' ? "" : fmt::format(" class=\"{}\"", css_class),
                     html);
}

std::string distance(const Words& words, const Reference& reference) {
  return escape(words.say("mounting.distance", centimetres(reference.distance), arrow(reference.side),
                          name_of(words, reference)));
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
  const std::string text = words.say("mounting.cm", height_cm(unit));
  const auto below = cm_below_ceiling(scene, unit);
  return below ? fmt::format("{}<br><small>{}</small>", text, words.say("mounting.below_ceiling", *below))
               : text;
}

std::string remark(const Words& words, const MountedUnit& unit) {
  const char* const key = unit.installed ? "mounting.installed" : unit.pinned ? "mounting.pinned" : nullptr;
  return key == nullptr ? "" : fmt::format("<br><small>({})</small>", words(key));
}

std::string row(const Scene& scene, const MountedUnit& unit) {
  const Words words = words_of(scene);
  return "<tr>" + cell(fmt::format("<b>{}</b>", unit.number), "n") +
         cell(unit.installed ? "–" : "<span class=\"tick-box\"></span>") +
         cell(distance(words, unit.references[0])) + cell(distance(words, unit.references[1])) +
         cell(height(scene, unit), "n") + cell(picture(unit) + escape(direction_of(words, unit))) +
         cell(escape(unit.type)) + cell(escape(unit.id) + remark(words, unit)) + "</tr>\n";
}

}  // namespace

std::string mounting_section(const ReportData& data, const Maps& maps) {
  const std::vector<MountedUnit> units = mounting_sheet(data.input);
  if (units.empty()) return {};
  std::string head;
  for (const char* key : {"number", "done", "across", "along", "height", "direction", "type", "unit"})
    head += fmt::format("<th scope=\"col\">{}</th>", data.words(fmt::format("mounting.{}", key)));
  std::string rows;
  for (const MountedUnit& unit : units) rows += row(data.input.scene, unit);
  return html_section(
      "mounting", data.words.say("mounting.title"),
      (data.input.plan.is_verified() ? "" : paragraph(data.words.say("certificate.lacking"), "uncertified")) +
          paragraph(data.words.say("mounting.intro")) + maps.overview(data.words.say("mounting.drawing")) +
          fmt::format(
              "<div class=\"scroll\" tabindex=\"0\"><table class=\"sheet\">\n<thead><tr>{}</tr></thead>\n"
              "<tbody>\n{}</tbody></table></div>\n",
              head, rows) +
          paragraph(data.words.say("mounting.files"), "note"));
}

}  // namespace shelfbeam
