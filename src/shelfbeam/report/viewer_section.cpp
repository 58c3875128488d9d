#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/report/html_table.hpp"
#include "shelfbeam/report/page_signals.hpp"
#include "shelfbeam/report/page_store.hpp"
#include "shelfbeam/report/sections.hpp"

namespace shelfbeam {

// The bundle of src/viewer, made by cmake/viewer.cmake; empty where it could not be made.
namespace embedded {
extern const std::string_view viewer_script;
}  // namespace embedded

namespace {

constexpr const char* heading = "The store in 3-D";

std::vector<double> shown_signals(const ReportData& data) {
  std::vector<double> signals;
  for (const LabelOutcome& label : data.outcome.labels)
    signals.push_back(data.has_selection() ? label.signal : label.best);
  return signals;
}

// What the view leaves out, so that nobody takes its numbers for more than they are.
std::string completeness(const ReportData& data, const PageSignals& signals) {
  const double digits = std::expm1(0.5 * signals.error_step);
  std::string text = fmt::format(
      "Signals are those of signal.h5, to the last bit{}.",
      signals.error.empty() ? ""
                            : fmt::format("; standard errors are rounded by up to {}", percent(digits, 3)));
  if (data.input.placement.forbidden_pairs > 0)
    text += " Candidates that the plan keeps apart can be switched on together here.";
  if (signals.left_out == 0) return text;
  return text +
         fmt::format(
             " To keep the page small, the {} smallest of {} entries are left out and count as 0: each "
             "is below {} of what its label needs, and those of one label, all units on, add up to {} of "
             "it at most (label {}). The plan itself is counted with all of its entries.",
             grouped(signals.left_out), grouped(signals.left_out + signals.mean.size()),
             significant(100 * signals.largest_left_out) + "\u00A0%",
             significant(100 * signals.largest_effect) + "\u00A0%", data.label(signals.most_affected).id);
}

}  // namespace

bool has_viewer() {
  return !embedded::viewer_script.empty();
}

std::string viewer_section(const ReportData& data) {
  if (data.levels.empty()) return {};
  if (!has_viewer())
    return html_section(
        "viewer", heading,
        paragraph(
            "This build of shelfbeam was made without Node.js or its packages, so the 3-D view was left "
            "out. Everything else is here.",
            "note"));
  const SignalScale scale(shown_signals(data));
  const PackedSignals packed = pack_signals(data.input.matrix, data.input.placement, most_signal_bytes);
  const std::string body = fmt::format(
      "<style>#viewer{{{}}}\n@media screen and (prefers-color-scheme:dark){{#viewer{{{}}}}}</style>\n"
      "<div id=\"viewer-root\"><p class=\"note\">The 3-D view needs JavaScript; the plans and tables below "
      "do "
      "not.</p></div>\n{}"
      "<script type=\"text/plain\" id=\"viewer-store\">{}</script>\n"
      "<script type=\"text/plain\" id=\"viewer-signals\">{}</script>\n"
      "<script>{}</script>\n",
      signal_colours(scale, false), signal_colours(scale, true),
      paragraph(completeness(data, packed.signals), "note"), pack_store(data, scale), packed.base64,
      embedded::viewer_script);
  return html_section("viewer", heading, body);
}

}  // namespace shelfbeam
