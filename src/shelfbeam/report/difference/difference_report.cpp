#include "shelfbeam/report/difference/difference_report.hpp"

#include <cstddef>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/difference/difference_map.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

constexpr std::size_t max_rows = 50;

std::string table_html(const TextTable& table) {
  std::vector<HtmlTable::Column> columns;
  for (const std::string& head : table.front()) columns.push_back({head, false, true});
  HtmlTable html(columns);
  for (std::size_t k = 1; k < table.size(); ++k) html.add_row(table[k]);
  return html.html();
}

const char* tone_of(const PlanDifference& difference) {
  if (difference.count(LabelChange::lost) > 0 || !difference.figures.after.has_selection) return "no";
  return difference.figures.after.certificate == CertificateState::certified ? "yes" : "open";
}

std::string label_sections(const Words& words, const DifferenceInput& input) {
  std::string html;
  for (const LabelChange change : listed_changes)
    if (const std::size_t count = input.difference.count(change); count > 0)
      html += html_section(fmt::format("labels-{}", to_text(change)),
                           labels_heading(words, change, count, max_rows),
                           table_html(changed_labels(words, input, change, max_rows)));
  return html;
}

}  // namespace

std::string difference_html(const DifferenceReport& report) {
  const Words words = words_of(report.after);
  const DifferenceInput& input = report.input;
  const PlanDifference& difference = input.difference;
  const std::string title =
      words.say("difference.title", printable(report.before_name), printable(report.after_name));
  std::string body = html_header(
      {tone_of(difference), escape(words("difference.kicker")), title, difference_answer(words, input)});
  body += html_section("figures", words.say("difference.section.figures"),
                       table_html(difference_figures(words, input)));
  body += html_section("map", words.say("difference.section.map"), difference_map(input, report.after));
  const TextTable units = changed_units(words, input);
  body +=
      html_section("units", words.say("difference.section.units"),
                   paragraph(unit_counts(words, difference)) + (units.size() > 1 ? table_html(units) : ""));
  body += label_sections(words, input);
  body += html_section("weakest", words.say("difference.section.weakest"),
                       table_html(weakest_labels(words, input)));
  body += html_section("store", words.say("difference.section.store"),
                       difference.store.empty() ? paragraph(words.say("difference.section.no_store"))
                                                : html_list(store_lines(words, difference)));
  return html_page(words, title, "<main>\n" + body + "</main>\n");
}

}  // namespace shelfbeam
