#include <fmt/format.h>

#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

std::string report_html(const ReportInput& input) {
  const Words words = words_of(input.scene);
  const ReportData data(input);
  const Maps maps(data);
  const std::string name = input.scene.name.empty() ? words.say("summary.store") : input.scene.name;
  const std::string body = summary_section(data, maps) + mounting_section(data, maps) +
                           warning_section(data) + unreachable_section(data) + availability_section(data) +
                           margin_section(data, maps) + viewer_section(data, viewer_script()) +
                           weakest_section(data) + fixture_section(data) + unit_section(data, maps) +
                           curve_section(data) + sensitivity_section(data) + reflection_section(data, maps) +
                           distribution_section(data) + facts_section(data);
  return html_page(words, words.say("page.title", name),
                   fmt::format("{}<main>\n{}<footer>{}</footer>\n</main>\n", maps.definitions(), body,
                               escape(words("page.footer"))),
                   maps.colours(false), maps.colours(true));
}

}  // namespace shelfbeam
