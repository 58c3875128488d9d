#include "shelfbeam/report/messages/headline.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "shelfbeam/report/messages/availability.hpp"
#include "shelfbeam/report/messages/open_bound.hpp"
#include "shelfbeam/report/messages/partial.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

Headline with_selection(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  Headline result;
  const std::size_t labels = data.outcome.labels.size();
  const bool all_met = data.outcome.met == labels;
  const bool is_proven =
      minimises_cost(placement.problem) ? cost_is_proven(placement) : count_is_proven(placement);
  result.tone = !all_met                                           ? Headline::Tone::no
                : placement.status == Status::optimal || is_proven ? Headline::Tone::yes
                                                                   : Headline::Tone::open;
  result.answer = data.words.say(
      "headline.reach", units_reach(data.words, placement.count()),
      labels_reached(data.words, data.outcome.met, labels), failure_clause(data.words, placement.problem),
      placement.min_spacing > 0 ? data.words.say("headline.spacing", data.words.plain(placement.min_spacing))
                                : std::string(),
      all_met && !placement.partial ? page_bound(data.words, placement) : ".");

  std::size_t installed = 0;
  for (const std::uint32_t column : placement.selected)
    installed += data.transceiver(column).installed ? 1 : 0;
  if (installed > 0)
    result.remarks.push_back(installed == placement.count()
                                 ? data.words.say("headline.installed.all")
                                 : data.words.say_count("headline.installed", installed));
  // Over states, `stopped` says that the bound with its confidence is lower than the value.
  if (placement.status == Status::stopped && !data.input.plan.availability)
    result.remarks.push_back(data.words.say("headline.stopped"));
  if (placement.status == Status::feasible && !placement.partial)
    result.remarks.push_back(data.words.say("headline.greedy"));
  return result;
}

Headline infeasible(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  Headline result{Headline::Tone::no, data.words.say("headline.infeasible"), {}};
  if (placement.partial)
    result.answer = partial_sentence(data.words, placement, data.outcome.labels.size());
  else if (!placement.unreachable.empty())
    result.answer = data.words.say("headline.out_of_reach", page_out_of_reach(data));
  else if (const std::string why = conflict_reason(data.words, placement, data.has_options()); !why.empty())
    result.answer = data.words.say("headline.not_together", not_all_together(data.words, why));
  const auto dark = std::count_if(
      placement.unreachable.begin(), placement.unreachable.end(),
      [&](const Unreachable& label) { return label.max_signal <= 0 && !data.is_heard(label.label); });
  if (dark > 0) result.remarks.push_back(dark_labels(data.words, static_cast<std::size_t>(dark)));
  result.remarks.push_back(data.words.say("headline.remedies", maximum_signal_condition(data)));
  return result;
}

Headline nothing_found(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  const std::size_t count_bound = proven_count(placement);
  const std::string_view who = method_without_result(data.words, placement);
  Headline result;
  if (count_bound == 0)
    result.answer =
        who.empty() ? data.words.say("headline.nothing.within") : data.words.say("headline.nothing.by", who);
  else
    result.answer =
        who.empty() ? data.words.say("headline.nothing.within_bound", units_needed(data.words, count_bound))
                    : data.words.say("headline.nothing.by_bound", who, units_needed(data.words, count_bound));
  const std::string_view advice =
      data.words(placement.solver.method == Method::greedy ? "headline.unknown.exact"
                 : who.empty()                             ? "headline.unknown.time"
                                                           : "headline.unknown.mip");
  result.remarks.push_back(
      fmt::format("{} {}", advice, data.words.say("headline.plans", maximum_signal_condition(data))));
  return result;
}

std::string closeness_remark(const ReportData& data) {
  return data.uncertain == 0 ? "" : data.words.say_count("headline.close", data.uncertain);
}

// The certificate becomes the answer; the statement about the simulated matrix becomes a remark.
void lead_with_certificate(const Words& words, const CertifiedPlan& plan, Headline& headline) {
  const Certificate& certificate = *plan.certificate;
  headline.remarks.insert(headline.remarks.begin(), words.say("headline.simulated", headline.answer));
  headline.answer = with_joined_percent(certificate_sentence(words, plan));
  const bool is_settled = plan.placement.has_selection() ? certificate.all_reached() : !certificate.open;
  headline.tone = certificate.count(Verdict::missed) > 0 ? Headline::Tone::no
                  : is_settled                           ? Headline::Tone::yes
                                                         : Headline::Tone::open;
}

// The answer for a shop that changes, instead of that for the shop as the file gives it.
void lead_with_availability(const ReportData& data, Headline& headline) {
  const CertifiedPlan& plan = data.input.plan;
  const Availability& availability = *plan.availability;
  if (std::string bound = availability_bound(data.words, availability, plan.placement); !bound.empty())
    headline.remarks.push_back(with_joined_percent(std::move(bound)));
  for (std::string& remark : availability_remarks(data.words, availability, plan.placement))
    headline.remarks.push_back(with_joined_percent(std::move(remark)));
  headline.answer = with_joined_percent(availability_sentence(
      data.words, availability, plan.placement, [&](LabelId label) { return data.names.name(label); }));
  headline.tone = availability.is_impossible() ? Headline::Tone::no
                  : availability.certified     ? Headline::Tone::yes
                                               : Headline::Tone::open;
}

std::string sampling_remark(const ReportData& data) {
  std::string text = data.words.say("headline.unverified", data.words("certificate.lacking"));
  const SamplingSummary& s = data.sampling;
  if (!s.has_errors) return text + " " + data.words.say("headline.no_errors");
  if (s.relevant > 0)
    text += " " + data.words.say("headline.errors", data.words.percent(relevant_share, 0),
                                 data.words.percent(s.mean), data.words.percent(s.worst));
  if (s.relevant > 0 && s.flagged > 0)
    text += " " +
            data.words.say("headline.flagged", data.words.grouped(s.flagged), data.words.grouped(s.relevant));
  return text;
}

}  // namespace

Headline headline(const ReportData& data) {
  const CertifiedPlan& plan = data.input.plan;
  const Placement& placement = plan.placement;
  Headline result = data.has_selection()                     ? with_selection(data)
                    : placement.status == Status::infeasible ? infeasible(data)
                                                             : nothing_found(data);
  if (plan.availability) lead_with_availability(data, result);
  const auto remark = [&](std::string text) {
    if (!text.empty()) result.remarks.push_back(std::move(text));
  };
  if (data.has_selection()) remark(partial_sentence(data.words, placement, data.outcome.labels.size()));
  if (data.has_selection()) {
    if (std::string close = closeness_remark(data); !close.empty() && !plan.certificate && !plan.availability)
      result.remarks.insert(result.remarks.begin(), std::move(close));
    // Its bound is that of the matrix, regardless of independent samples.
    const std::string objective = objective_sentence(data.words, placement);
    remark(plan.certificate && !objective.empty() ? data.words.say("headline.simulated", objective)
                                                  : objective);
    remark(price_sentence(data.words, placement));
  }
  if (plan.certificate) lead_with_certificate(data.words, plan, result);
  remark(remedy_for(data.words, plan).after(open_bound(data.words, plan)));
  if (const std::string conflicts = conflict_sentence(data.words, placement); !conflicts.empty())
    remark(conflicts + ".");
  if (!plan.availability) remark(proof_sentence(data.words, placement));
  if (!plan.certificate && !plan.availability) remark(sampling_remark(data));
  if (plan.sensitivity)
    remark(with_joined_percent(sensitivity_sentence(data.words, plan, data.outcome.labels.size())));
  return result;
}

}  // namespace shelfbeam
