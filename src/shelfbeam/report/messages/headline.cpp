#include "shelfbeam/report/messages/headline.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"

namespace shelfbeam {

namespace {

std::string time_text(double seconds) {
  return significant(seconds, 2) + "\u00A0s";
}

Headline with_selection(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  Headline result;
  const std::size_t labels = data.outcome.labels.size();
  const bool all_met = data.outcome.met == labels;
  result.tone = !all_met                                                            ? Headline::Tone::no
                : placement.status == Status::optimal || count_is_proven(placement) ? Headline::Tone::yes
                                                                                    : Headline::Tone::open;
  result.answer = units_reach(placement.count()) + " " + labels_reached(data.outcome.met, labels);
  result.answer += failure_clause(placement.problem);
  if (placement.min_spacing > 0)
    result.answer +=
        fmt::format(", with every new unit at least {} m from all others", plain(placement.min_spacing));
  result.answer += all_met ? page_bound(placement) : ".";

  std::size_t installed = 0;
  for (const std::uint32_t column : placement.selected)
    installed += data.transceiver(column).installed ? 1 : 0;
  if (installed > 0)
    result.remarks.push_back(installed == placement.count() ? "All units are already installed."
                             : installed == 1               ? "One unit is already installed."
                                              : grouped(installed) + " units are already installed.");
  if (placement.status == Status::stopped)
    result.remarks.push_back(fmt::format("The search stopped after {}, before the proof was complete.",
                                         time_text(placement.seconds)));
  if (placement.status == Status::feasible)
    result.remarks.push_back(
        "The greedy method chose this selection; it does not search for smaller selections.");
  return result;
}

Headline infeasible(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  Headline result{Headline::Tone::no, "No selection reaches all labels.", {}};
  if (!placement.unreachable.empty())
    result.answer = fmt::format("No selection reaches all labels: {}.", page_out_of_reach(data));
  else if (const std::string why = conflict_reason(placement, data.has_options()); !why.empty())
    result.answer = fmt::format("No selection reaches all labels: each label {}.", not_all_together(why));
  const auto dark = std::count_if(
      placement.unreachable.begin(), placement.unreachable.end(),
      [&](const Unreachable& label) { return label.max_signal <= 0 && !data.is_heard(label.label); });
  if (dark > 0) result.remarks.push_back(dark_labels(static_cast<std::size_t>(dark)));
  result.remarks.push_back(fmt::format(
      "Possible remedies: more mounting points, stronger units, or labels with a lower requirement. The "
      "floor plans below show the signal that each label would receive {}.",
      maximum_signal_condition(data)));
  return result;
}

Headline nothing_found(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  const std::size_t count_bound = proven_count(placement);
  const std::string_view who = method_without_result(placement);
  Headline result;
  result.answer = who.empty() ? fmt::format("No selection was found within {}", time_text(placement.seconds))
                              : fmt::format("{} found no selection", who);
  result.answer += count_bound == 0 ? "." : fmt::format("; it is proven that {}.", units_needed(count_bound));
  result.remarks.push_back(
      fmt::format("It is unknown whether a feasible selection exists; {} may find a selection. The floor "
                  "plans below show the signal that each label would receive {}.",
                  placement.solver == "greedy" ? "an exact search"
                  : who.empty()                ? "more time"
                                               : "a MIP solver",
                  maximum_signal_condition(data)));
  return result;
}

std::string closeness_remark(const ReportData& data) {
  if (data.uncertain == 0) return {};
  const bool one = data.uncertain == 1;
  return fmt::format(
      "At least {} so close to {} that other random samples could change the result: the distance is less "
      "than two standard errors of the largest single signal. Use more samples to decide.",
      one ? "one label is" : counted(data.uncertain, "label") + " are",
      one ? "its requirement" : "their requirements");
}

// The certificate becomes the answer; the statement about the simulated matrix becomes a remark.
void lead_with_certificate(const CertifiedPlan& plan, Headline& headline) {
  const Certificate& certificate = *plan.certificate;
  headline.remarks.insert(headline.remarks.begin(), "On the simulated matrix: " + headline.answer);
  headline.answer = with_joined_percent(certificate_sentence(plan));
  headline.tone = certificate.count(Verdict::missed) > 0 ? Headline::Tone::no
                  : certificate.open.empty()             ? Headline::Tone::yes
                                                         : Headline::Tone::open;
}

std::string sampling_remark(const ReportData& data) {
  std::string text =
      "Not verified yet: this statement applies to the simulated signals; their sampling error is not part "
      "of the proof.";
  const SamplingSummary& s = data.sampling;
  if (!s.has_errors)
    text += " The matrix contains no standard errors.";
  else if (s.relevant > 0)
    text += fmt::format(
        " Single signals of at least {} of a label's requirement have a relative standard error of {} on "
        "average and at most {}. The errors of one label's signals are correlated, so these figures do not "
        "apply to sums.{}",
        percent(relevant_share, 0), percent(s.mean), percent(s.worst),
        s.flagged > 0
            ? fmt::format(" {} of these {} errors are not reliable.", grouped(s.flagged), grouped(s.relevant))
            : "");
  return text;
}

}  // namespace

Headline headline(const ReportData& data) {
  const CertifiedPlan& plan = data.input.plan;
  const Placement& placement = plan.placement;
  Headline result = data.has_selection()                     ? with_selection(data)
                    : placement.status == Status::infeasible ? infeasible(data)
                                                             : nothing_found(data);
  const auto remark = [&](std::string text) {
    if (!text.empty()) result.remarks.push_back(std::move(text));
  };
  if (data.has_selection()) {
    if (std::string close = closeness_remark(data); !close.empty() && !plan.certificate)
      result.remarks.insert(result.remarks.begin(), std::move(close));
    remark(objective_sentence(placement));
  }
  if (plan.certificate) lead_with_certificate(plan, result);
  if (const std::string conflicts = conflict_sentence(placement); !conflicts.empty()) remark(conflicts + ".");
  remark(proof_sentence(placement));
  if (!plan.certificate) remark(sampling_remark(data));
  if (plan.sensitivity)
    remark(with_joined_percent(sensitivity_sentence(*plan.sensitivity, data.outcome.labels.size())));
  return result;
}

}  // namespace shelfbeam
