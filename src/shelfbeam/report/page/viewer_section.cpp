#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/viewer/page_signals.hpp"

namespace shelfbeam {

// The bundle of src/viewer, made by cmake/viewer.cmake; empty in a build without Node.js or its packages.
namespace embedded {
extern const std::string_view viewer_script;
}  // namespace embedded

namespace {

constexpr const char* heading = "The store in 3-D";

std::string share_text(double share) {
  return significant(100 * share, 2) + "\u00A0%";
}

// The plan itself is evaluated with all entries; only changes in the view have rounding errors.
std::string rounding(const ReportData& data, const PageSignals& signals) {
  const PlacementProblem& problem = data.input.plan.placement.problem;
  std::string text = fmt::format(
      "The plan is evaluated with the exact signals of signal.h5. To keep the page small, single signals in "
      "the 3-D view are rounded to {} of a label's requirement{}: ",
      plain(100 * signals.grain) + "\u00A0%",
      signals.omitted == 0 ? ""
                           : fmt::format(", and the {} smallest of {} are omitted", grouped(signals.omitted),
                                         grouped(signals.omitted + signals.mean.size())));
  const std::string largest_error = share_text(signals.largest_error);
  if (problem.model == CommunicationModel::non_cooperative)
    return text + fmt::format(
                      "with other units on, a label's signal has an error of at most {} of its "
                      "requirement.",
                      largest_error);
  text += fmt::format(
      "each switched unit causes an error of at most {} of a label's requirement{}", largest_error,
      problem.redundant
          ? " (the first unit at most three times this error, because the strongest unit may change)"
          : "");
  const LabelRow& label = data.label(signals.max_affected);
  double everything = 0;
  for (const float mean : data.input.matrix.mean_row(signals.max_affected))
    everything += static_cast<double>(mean);
  return text + fmt::format("; with all units on, the errors add up to at most {} (of {}, label {}).",
                            share_text(signals.largest_effect),
                            label.requirement > 0 ? share_text(everything / label.requirement) : "its signal",
                            label.id);
}

// The rounding of the view, its effect, and the omitted data.
std::string completeness(const ReportData& data, const PageSignals& signals) {
  const double digits = std::expm1(0.5 * signals.error_step);
  std::string text =
      signals.grain > 0 ? rounding(data, signals) : "The 3-D view uses the exact signals of signal.h5.";
  if (!signals.error.empty())
    text += fmt::format(
        " Standard errors are rounded by up to {}{}.", percent(digits, signals.grain > 0 ? 0 : 3),
        signals.details_from == 0
            ? ""
            : fmt::format("; signals below {} of the requirement have no standard error and no direct share",
                          percent(relevant_share, 0)));
  if (data.input.plan.placement.forbidden_pairs > 0)
    text += " In this view, excluded pairs of candidates can be switched on together.";
  return text;
}

}  // namespace

std::string_view viewer_script() {
  return embedded::viewer_script;
}

std::string viewer_section(const ReportData& data, std::string_view script) {
  if (data.levels.empty()) return {};
  if (script.empty())
    return html_section(
        "viewer", heading,
        paragraph(
            "The 3-D view is missing: this build of shelfbeam was made without Node.js or its packages. The "
            "rest of the report is complete.",
            "note"));
  std::vector<double> signals;
  for (std::uint32_t i = 0; i < data.outcome.labels.size(); ++i) signals.push_back(data.shown_signal(i));
  const SignalScale scale(signals);
  const PackedSignals packed = pack_signals(data.input.matrix, data.input.plan.placement, max_signal_bytes);
  const std::string body = fmt::format(
      "<style>#viewer{{{}}}\n@media screen and (prefers-color-scheme:dark){{#viewer{{{}}}}}</style>\n"
      "<div id=\"viewer-root\"><p class=\"note\">The 3-D view requires JavaScript; the plans and tables "
      "below do not.</p></div>\n{}"
      "<script type=\"text/plain\" id=\"viewer-store\">{}</script>\n"
      "<script type=\"text/plain\" id=\"viewer-signals\">{}</script>\n"
      "<script>{}</script>\n",
      signal_colours(scale, false), signal_colours(scale, true),
      paragraph(completeness(data, packed.signals), "note"), pack_store(data, scale), packed.base64, script);
  return html_section("viewer", heading, body);
}

}  // namespace shelfbeam
