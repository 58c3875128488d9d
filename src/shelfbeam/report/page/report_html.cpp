#include <fmt/format.h>

#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/page/page_style.hpp"
#include "shelfbeam/report/page/sections.hpp"

namespace shelfbeam {

std::string report_html(const ReportInput& input) {
  const ReportData data(input);
  const Maps maps(data);
  const std::string name = input.scene.name.empty() ? "Store" : input.scene.name;
  std::string body = answer_section(data) + key_figures(data) + unreachable_section(data) +
                     viewer_section(data, viewer_script()) + margin_section(data, maps) +
                     reflection_section(data, maps) + sensitivity_section(data) + distribution_section(data) +
                     unit_section(data) + curve_section(data) + weakest_section(data) + facts_section(data);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{} – transceiver placement</title>\n<style>\n{}</style>\n</head>\n<body>\n{}<main>\n{}"
      "<footer>Signals are simulated for the store as it is described, not measured.</footer>\n"
      "</main>\n</body>\n</html>\n",
      escape(name), page_style(maps.colours(false), maps.colours(true)), maps.definitions(), body);
}

}  // namespace shelfbeam
