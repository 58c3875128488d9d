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
  if (placement.question.redundant) result.answer += ", even when any one of them fails";
  if (placement.min_spacing > 0)
    result.answer +=
        fmt::format(", every new one at least {} m from all others", plain(placement.min_spacing));
  result.answer += all_met ? page_bound(placement) : ".";

  std::size_t installed = 0;
  for (const std::uint32_t column : placement.selected)
    installed += data.transceiver(column).installed ? 1 : 0;
  if (installed > 0)
    result.remarks.push_back(installed == placement.count() ? "All of them are already installed."
                             : installed == 1               ? "One of them is already installed."
                                              : grouped(installed) + " of them are already installed.");
  if (placement.status == Status::stopped)
    result.remarks.push_back(fmt::format("The search stopped after {} before everything was proven.",
                                         time_text(placement.seconds)));
  if (placement.status == Status::feasible)
    result.remarks.push_back(
        "This selection was built step by step; whether fewer would do was not searched for.");
  return result;
}

Headline infeasible(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  Headline result{Headline::Tone::no, "No selection can do it.", {}};
  if (!placement.unreachable.empty())
    result.answer = fmt::format("No selection can do it: {}.", page_out_of_reach(data));
  else if (const std::string why = why_exclusive(placement, data.has_options()); !why.empty())
    result.answer = fmt::format("No selection can do it: each label {}.", not_all_at_once(why));
  const auto dark =
      std::count_if(placement.unreachable.begin(), placement.unreachable.end(),
                    [&](const Unreachable& label) { return label.most <= 0 && !data.is_heard(label.label); });
  if (dark > 0) result.remarks.push_back(dark_labels(static_cast<std::size_t>(dark)));
  result.remarks.push_back(fmt::format(
      "What helps: candidates in more places, stronger units, or labels that need less signal. The plans "
      "below show what each label would get {}.",
      everything_on(data)));
  return result;
}

Headline nothing_found(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  const std::size_t least = least_count(placement);
  const std::string_view who = who_gave_up(placement);
  Headline result;
  result.answer = who.empty() ? fmt::format("No selection was found within {}", time_text(placement.seconds))
                              : fmt::format("{} found no selection", who);
  result.answer += least == 0 ? "." : fmt::format("; it is proven that {}.", units_needed(least));
  result.remarks.push_back(
      fmt::format("The question is open: {} may find one. The plans below show what each label would get {}.",
                  placement.solver == "greedy" ? "an exact search"
                  : who.empty()                ? "more time"
                                               : "a MIP solver",
                  everything_on(data)));
  return result;
}

std::string closeness_remark(const ReportData& data) {
  if (data.uncertain == 0) return {};
  const bool one = data.uncertain == 1;
  return fmt::format(
      "At least {} so close to {} that other random samples could turn the verdict: within two standard "
      "errors, counting only that of the largest contribution. More samples would tell.",
      one ? "one label lies" : counted(data.uncertain, "label") + " lie",
      one ? "its requirement" : "their requirements");
}

// What fresh samples say comes first; what the matrix says then is a remark.
void put_certificate_first(const CertifiedPlan& plan, Headline& headline) {
  const Certificate& certificate = *plan.certificate;
  headline.remarks.insert(headline.remarks.begin(),
                          {std::string(certificate_scope), "On the simulated matrix: " + headline.answer});
  headline.answer = with_joined_percent(certificate_sentence(plan));
  headline.tone = certificate.count(Verdict::missed) > 0 ? Headline::Tone::no
                  : certificate.open.empty()             ? Headline::Tone::yes
                                                         : Headline::Tone::open;
}

std::string sampling_remark(const ReportData& data) {
  std::string text =
      "The statement holds for the simulated signal matrix; its sampling error is not part of the proof.";
  const SamplingSummary& s = data.sampling;
  if (!s.has_errors)
    text += " The matrix carries no standard errors.";
  else if (s.relevant > 0)
    text += fmt::format(
        " Entries of at least {} of a label's requirement have a relative standard error of {} on average "
        "and {} at worst (errors of one label's entries are correlated, so this is per entry, not of "
        "sums).{}",
        percent(relevant_share, 0), percent(s.mean), percent(s.worst),
        s.flagged > 0
            ? fmt::format(" {} of {} such errors cannot be trusted.", grouped(s.flagged), grouped(s.relevant))
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
  if (plan.certificate) put_certificate_first(plan, result);
  if (const std::string apart = kept_apart(placement); !apart.empty()) remark(apart + ".");
  remark(proof_sentence(placement));
  if (!plan.certificate) remark(sampling_remark(data));
  if (plan.sensitivity)
    remark(with_joined_percent(sensitivity_sentence(*plan.sensitivity, data.outcome.labels.size())));
  return result;
}

}  // namespace shelfbeam
