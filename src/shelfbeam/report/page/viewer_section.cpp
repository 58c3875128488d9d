#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/viewer/page_signals.hpp"

namespace shelfbeam {

// The bundle of src/viewer, made by cmake/viewer.cmake; empty where it could not be made.
namespace embedded {
extern const std::string_view viewer_script;
}  // namespace embedded

namespace {

constexpr const char* heading = "The store in 3-D";

std::string share_text(double share) {
  return significant(100 * share, 2) + "\u00A0%";
}

// The plan is counted with all of its entries; how far from them is what the reader switches.
std::string rounding(const ReportData& data, const PageSignals& signals) {
  const Question& question = data.input.plan.placement.question;
  std::string text = fmt::format(
      "The plan is counted with the signals of signal.h5, to the last bit. To keep the page small, single "
      "signals are rounded to {} of what a label needs{}: ",
      plain(100 * signals.grain) + "\u00A0%",
      signals.left_out == 0
          ? ""
          : fmt::format(", and the {} smallest of {} are left out", grouped(signals.left_out),
                        grouped(signals.left_out + signals.mean.size())));
  const std::string most = share_text(signals.largest_error);
  if (question.model == CommunicationModel::non_cooperative)
    return text + fmt::format("with other units on, a label's signal may be off by {} of its need.", most);
  text += fmt::format(
      "each unit that is switched may put a label's signal off by {} of its need{}", most,
      question.redundant ? " (the first by three times that, as the strongest may be another)" : "");
  const LabelRow& label = data.label(signals.most_affected);
  double everything = 0;
  for (const float mean : data.input.matrix.mean_row(signals.most_affected))
    everything += static_cast<double>(mean);
  return text +
         fmt::format(", all units on, all their errors added, by {} at most (of {}, label {}).",
                     share_text(signals.largest_effect),
                     label.requirement > 0 ? share_text(everything / label.requirement) : "what it gets",
                     label.id);
}

// What the view leaves out, so that nobody takes its numbers for more than they are.
std::string completeness(const ReportData& data, const PageSignals& signals) {
  const double digits = std::expm1(0.5 * signals.error_step);
  std::string text =
      signals.grain > 0 ? rounding(data, signals) : "Signals are those of signal.h5, to the last bit.";
  if (!signals.error.empty())
    text += fmt::format(
        " Standard errors are rounded by up to {}{}.", percent(digits, signals.grain > 0 ? 0 : 3),
        signals.details_from == 0
            ? ""
            : fmt::format("; those of signals below {} of a need are not here, nor their direct shares",
                          percent(relevant_share, 0)));
  if (data.input.plan.placement.forbidden_pairs > 0)
    text += " Candidates that the plan keeps apart can be switched on together here.";
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
            "This build of shelfbeam was made without Node.js or its packages, so the 3-D view was left "
            "out. Everything else is here.",
            "note"));
  std::vector<double> signals;
  for (std::uint32_t i = 0; i < data.outcome.labels.size(); ++i) signals.push_back(data.shown_signal(i));
  const SignalScale scale(signals);
  const PackedSignals packed = pack_signals(data.input.matrix, data.input.plan.placement, most_signal_bytes);
  const std::string body = fmt::format(
      "<style>#viewer{{{}}}\n@media screen and (prefers-color-scheme:dark){{#viewer{{{}}}}}</style>\n"
      "<div id=\"viewer-root\"><p class=\"note\">The 3-D view needs JavaScript; the plans and tables below "
      "do "
      "not.</p></div>\n{}"
      "<script type=\"text/plain\" id=\"viewer-store\">{}</script>\n"
      "<script type=\"text/plain\" id=\"viewer-signals\">{}</script>\n"
      "<script>{}</script>\n",
      signal_colours(scale, false), signal_colours(scale, true),
      paragraph(completeness(data, packed.signals), "note"), pack_store(data, scale), packed.base64, script);
  return html_section("viewer", heading, body);
}

}  // namespace shelfbeam
