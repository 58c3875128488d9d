#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "shelfbeam/report/data/report.hpp"

#include "unit/report/markup.hpp"
#include "unit/report/sample_store.hpp"

namespace shelfbeam::test {

struct Supermarket {
  Scene scene = make_scene(sample_store::supermarket());
  SignalMatrix matrix = sample_store::matrix_of(scene);
  CertifiedPlan plan{sample_store::cover(matrix)};
  Placement& placement = plan.placement;
  ReportInput input{scene, matrix, plan};
};

// A certificate with every verdict: every 50th label is missed, every 50th undecided.
inline void certify(Supermarket& s) {
  Certificate& certificate = s.plan.certificate.emplace();
  certificate.confidence = 0.95;
  certificate.labels.resize(s.matrix.rows());
  for (std::size_t i = 0; i < certificate.labels.size(); ++i) {
    certificate.labels[i].requirement = s.matrix.labels[i].requirement;
    certificate.labels[i].verdict = i % 50 == 7    ? Verdict::missed
                                    : i % 50 == 23 ? Verdict::undecided
                                                   : Verdict::reached;
  }
  certificate.count_lower_bound = s.placement.count() - 1;
  certificate.bound_labels = 37;
  certificate.rounds = 3;
  certificate.seconds = 12.5;
  certificate.open = {.cause = EndCause::labels_cost, .labels = 19, .seconds = 700};
}

// A problem of the page. It must be well-formed and self-contained, with valid references and unique ids. The
// requests of the page's script are tested in a browser.
inline std::string fault(const std::string& page) {
  const std::string html = without_scripts(page);
  const Markup markup = read_markup(html);
  if (!markup.problem.empty()) return markup.problem;
  for (const char* word : {"http:", "https:", "url(", "@import", "<link"})
    if (html.find(word) != std::string::npos) return std::string("holds ") + word;
  for (std::size_t at = 0; (at = html.find(" src=", at)) != std::string::npos; ++at)
    if (!std::string_view(html).substr(at).starts_with(" src=\"data:image/"))
      return "holds a source elsewhere";
  std::set<std::string> ids;
  for (const auto& element : markup.elements)
    if (const auto id = element.attributes.find("id"); id != element.attributes.end())
      if (!ids.insert(id->second).second) return "id twice: " + id->second;
  for (const auto& element : markup.elements)
    if (const auto href = element.attributes.find("href"); href != element.attributes.end())
      if (href->second.empty() || href->second[0] != '#' || !ids.contains(href->second.substr(1)))
        return "dangling: " + href->second;
  return {};
}

// The report without scripts.
inline std::string static_report(const ReportInput& input) {
  return without_scripts(report_html(input));
}

// Tables and facts as separate texts, so that "8" does not match a part of another number.
inline std::multiset<std::string> pieces(const std::string& html) {
  std::multiset<std::string> result;
  const std::string text = read_markup(without_scripts(html)).text;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end > begin) result.insert(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return result;
}

}  // namespace shelfbeam::test
