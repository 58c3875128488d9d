#include <fmt/format.h>

#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"

namespace shelfbeam {

std::string report_html(const ReportInput& input) {
  const ReportData data(input);
  const Maps maps(data);
  const std::string name = input.scene.name.empty() ? "Store" : input.scene.name;
  const std::string body = answer_section(data) + key_figures(data) + unreachable_section(data) +
                           viewer_section(data, viewer_script()) + margin_section(data, maps) +
                           reflection_section(data, maps) + sensitivity_section(data) +
                           distribution_section(data) + unit_section(data) + curve_section(data) +
                           weakest_section(data) + facts_section(data);
  return html_page(
      name + " – transceiver placement",
      fmt::format("{}<main>\n{}<footer>Signals are simulated for the store as described; they are "
                  "not measured.</footer>\n</main>\n",
                  maps.definitions(), body),
      maps.colours(false), maps.colours(true));
}

}  // namespace shelfbeam
