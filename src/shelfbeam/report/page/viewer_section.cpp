#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/text/numbers.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/report/viewer/page_signals.hpp"

namespace shelfbeam {

// The bundle of src/page/report, made by cmake/page.cmake; empty in a build without Node.js or its packages.
namespace embedded {
extern const std::string_view viewer_script;
}  // namespace embedded

namespace {

std::string share_text(const Words& words, double share) {
  return words.significant(100 * share, 2) + "\u00A0%";
}

// The effect of rounded signals on a label's signal.
std::string effect_of_rounding(const ReportData& data, const PageSignals& signals) {
  const PlacementProblem& problem = data.input.plan.placement.problem;
  const std::string largest_error = share_text(data.words, signals.largest_error);
  if (problem.model == CommunicationModel::non_cooperative)
    return data.words.say("view.effect.single", largest_error);
  const LabelRow& label = data.label(signals.max_affected);
  double everything = 0;
  for (std::size_t j = 0; j < data.input.matrix.columns(); ++j)
    everything += data.input.matrix.signal(signals.max_affected, j);
  return data.words.say(problem.redundant ? "view.effect.sum_failure" : "view.effect.sum", largest_error,
                        share_text(data.words, signals.largest_effect),
                        label.requirement > 0 ? share_text(data.words, everything / label.requirement)
                                              : data.words.say("view.effect.its_signal"),
                        data.names.name(signals.max_affected));
}

// The plan itself is evaluated with all entries; only changes in the view have rounding errors.
std::string rounding(const ReportData& data, const PageSignals& signals) {
  const std::string grain = data.words.plain(100 * signals.grain) + "\u00A0%";
  const std::string effect = effect_of_rounding(data, signals);
  if (signals.omitted == 0) return data.words.say("view.rounded", grain, effect);
  return data.words.say("view.rounded_omitted", grain, effect, data.words.grouped(signals.omitted),
                        data.words.grouped(signals.omitted + signals.mean.size()));
}

// The rounding of the view, its effect, and the omitted data.
std::string completeness(const ReportData& data, const PageSignals& signals) {
  std::string text = signals.grain > 0 ? rounding(data, signals) : data.words.say("view.exact");
  if (!signals.error.empty()) {
    const int decimals = signals.grain > 0 ? 0 : 3;
    const std::string digits =
        data.words.percent(rounded_up(std::expm1(0.5 * signals.error_step), decimals + 2), decimals);
    text += " " + (signals.details_from == 0 ? data.words.say("view.errors", digits)
                                             : data.words.say("view.errors_omitted", digits,
                                                              data.words.percent(relevant_share, 0)));
  }
  if (data.input.plan.placement.forbidden_pairs > 0) text += " " + data.words.say("view.pairs");
  return text;
}

}  // namespace

std::string_view viewer_script() {
  return embedded::viewer_script;
}

std::string viewer_section(const ReportData& data, std::string_view script) {
  if (data.levels.empty()) return {};
  if (script.empty())
    return html_section("viewer", data.words.say("view.title"),
                        paragraph(data.words.say("view.missing"), "note"));
  std::vector<double> signals;
  for (std::uint32_t i = 0; i < data.outcome.labels.size(); ++i) signals.push_back(data.shown_signal(i));
  const SignalScale scale(signals);
  const PackedSignals packed = pack_signals(data.input.matrix, data.input.plan.placement, max_signal_bytes);
  const std::string body = fmt::format(
      "<style>#viewer{{{}}}\n@media screen and (prefers-color-scheme:dark){{#viewer{{{}}}}}</style>\n"
      "<script type=\"application/json\" id=\"viewer-texts\">{}</script>\n"
      "<div id=\"viewer-root\"><p class=\"note\">{}</p></div>\n{}"
      "<script type=\"text/plain\" id=\"viewer-store\">{}</script>\n"
      "<script type=\"text/plain\" id=\"viewer-signals\">{}</script>\n"
      "<script>{}</script>\n",
      signal_colours(scale, false), signal_colours(scale, true), data.words.viewer_json(),
      escape(data.words("view.no_script")), paragraph(completeness(data, packed.signals), "note"),
      pack_store(data, scale), packed.base64, script);
  return html_section("viewer", data.words.say("view.title"), body);
}

}  // namespace shelfbeam
