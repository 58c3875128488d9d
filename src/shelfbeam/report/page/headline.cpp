#include "shelfbeam/report/page/headline.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/report/messages/words.hpp"

namespace shelfbeam {

namespace {

std::string what_is_minimised(const Question& question) {
  switch (question.objective) {
    case Objective::count:
      return "transceivers";
    case Objective::links:
      return "links";
    case Objective::effective_links:
      return fmt::format("effective links (from {} of the requirement on)", percent(question.share, 0));
    case Objective::signal:
      return "signal";
  }
  return {};
}

std::string time_text(double seconds) {
  return significant(seconds, 2) + "\u00A0s";
}

bool count_is_proven(const Placement& placement) {
  return placement.count() > 0 && least_count(placement) >= placement.count();
}

// "; at least 5 are needed (proven)" and its less certain relatives.
std::string bound_clause(const Placement& placement) {
  const std::size_t least = least_count(placement);
  const std::string needed = fmt::format("{} {} needed", grouped(least), least == 1 ? "is" : "are");
  if (count_is_proven(placement)) return fmt::format("; at least {} (proven).", needed);
  if (placement.status == Status::optimal && placement.question.combination == Combination::weighted)
    return "; no selection has a lower total cost (proven).";
  if (least == 0) return "; how few would do is not known.";
  return fmt::format("; it is proven that at least {} (gap {}).", needed, percent(count_gap(placement)));
}

std::string reached_labels(const ReportData& data) {
  const std::size_t all = data.outcome.labels.size();
  if (data.outcome.met == all) return all == 1 ? "the only label" : "all " + counted(all, "label");
  return fmt::format("{} of {}", grouped(data.outcome.met), counted(all, "label"));
}

std::string candidates_text(const ReportData& data) {
  const std::size_t n = data.input.matrix.columns();
  const Question& question = data.input.plan.placement.question;
  if (question.model == CommunicationModel::non_cooperative)
    return question.redundant ? "each by two units at once, of which one may fail"
                              : fmt::format("even by the best of {}", counted(n, "candidate"));
  if (data.has_options())
    return fmt::format("even with the best option of {} on",
                       data.mounting_points == 1
                           ? "the only mounting point"
                           : fmt::format("all {} mounting points", grouped(data.mounting_points)));
  return n == 1 ? "even with the only candidate on"
                : fmt::format("even with all {} candidates on", grouped(n));
}

Headline with_selection(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  Headline result;
  const bool all_met = data.outcome.met == data.outcome.labels.size();
  result.tone = !all_met                                                            ? Headline::Tone::no
                : placement.status == Status::optimal || count_is_proven(placement) ? Headline::Tone::yes
                                                                                    : Headline::Tone::open;
  result.answer = fmt::format("{} {} {}", counted(placement.count(), "transceiver"),
                              placement.count() == 1 ? "reaches" : "reach", reached_labels(data));
  if (placement.question.redundant) result.answer += ", even when any one of them fails";
  if (placement.min_spacing > 0)
    result.answer +=
        fmt::format(", every new one at least {} m from all others", plain(placement.min_spacing));
  result.answer += all_met ? bound_clause(placement) : ".";

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
  const std::size_t lost = placement.unreachable.size(), all = data.outcome.labels.size();
  if (lost > 0)
    result.answer = fmt::format("No selection can do it: {} of {} cannot be reached, {}.", grouped(lost),
                                counted(all, "label"), candidates_text(data));
  else if (const std::string why = why_exclusive(placement, data.has_options()); !why.empty())
    result.answer = fmt::format(
        "No selection can do it: each label could be reached, but not all of them at once, because {}.", why);
  const auto dark =
      std::count_if(placement.unreachable.begin(), placement.unreachable.end(),
                    [&](const Unreachable& label) { return label.most <= 0 && !data.is_heard(label.label); });
  if (dark > 0)
    result.remarks.push_back(
        dark == 1 ? "At one of them no light arrives at all: is it inside something, or facing into it?"
                  : fmt::format("At {} of them no light arrives at all: are they inside something, or facing "
                                "into it?",
                                grouped(static_cast<std::uint64_t>(dark))));
  result.remarks.push_back(fmt::format(
      "What helps: candidates in more places, stronger units, or labels that need less signal. The plans "
      "below show what each label would get {}.",
      data.everything_on()));
  return result;
}

Headline nothing_found(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  const std::size_t least = least_count(placement);
  const bool greedy = placement.solver == "greedy";
  const bool gave_up = greedy || placement.solver == "search";
  Headline result;
  result.answer =
      fmt::format("{}{}.",
                  greedy    ? "The greedy method found no selection"
                  : gave_up ? "The search found no selection"
                            : fmt::format("No selection was found within {}", time_text(placement.seconds)),
                  least == 0 ? ""
                             : fmt::format("; it is proven that at least {} {} needed", grouped(least),
                                           least == 1 ? "transceiver is" : "transceivers are"));
  result.remarks.push_back(
      fmt::format("The question is open: {} may find one. The plans below show what each label would get {}.",
                  greedy    ? "an exact search"
                  : gave_up ? "a MIP solver"
                            : "more time",
                  data.everything_on()));
  return result;
}

std::string objective_remark(const Placement& placement) {
  const Question& question = placement.question;
  if (question.objective == Objective::count && question.combination == Combination::lexicographic) return {};
  if (question.combination == Combination::lexicographic &&
      (placement.status == Status::feasible || !count_is_proven(placement)))
    return fmt::format("The second aim, the least sum over {}, was not searched for: the number comes first.",
                       what_is_minimised(question));
  const std::string value = plain(placement.objective_value);
  const std::string bound = plain(placement.lower_bound);
  const bool proven = placement.status == Status::optimal;
  std::string text;
  if (question.combination == Combination::weighted)
    text = fmt::format("The total cost is {}{}", value, proven ? ", the least possible (proven)" : "");
  else
    text = fmt::format("Among selections of this size the aim was the least sum over {}: {}{}",
                       what_is_minimised(question), value, proven ? ", the least possible (proven)" : "");
  if (placement.status == Status::stopped)
    text += fmt::format("; at least {} is proven (gap {})", bound, percent(placement.gap()));
  text += placement.unit_costs ? ". No costs were given, so each counts 1." : ".";
  return text;
}

std::string proof_remark(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  if (placement.status == Status::infeasible || least_count(placement) == 0) return {};
  return fmt::format("What is proven rests on {}.{}", behind_bound(placement.bound_proof),
                     placement.ties_settled
                         ? " Of all selections that are as good this has the largest smallest margin."
                         : "");
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
  headline.answer = with_joined_percent(statement(plan));
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

std::size_t least_count(const Placement& placement) {
  if (!std::isfinite(placement.count_lower_bound)) return 0;
  return static_cast<std::size_t>(std::max(0.0, std::ceil(placement.count_lower_bound - 1e-6)));
}

double count_gap(const Placement& placement) {
  const std::size_t count = placement.count(), least = std::min(least_count(placement), count);
  return count == 0 ? 0 : static_cast<double>(count - least) / static_cast<double>(count);
}

std::string model_name(CommunicationModel model) {
  return model == CommunicationModel::cooperative ? "cooperative" : "non-cooperative";
}

std::string objective_name(const Question& question) {
  if (question.combination == Combination::weighted)
    return question.objective == Objective::count
               ? "least cost of transceivers"
               : "least cost of transceivers and " + what_is_minimised(question);
  if (question.objective == Objective::count) return "fewest transceivers";
  return fmt::format("fewest transceivers, then {} {}",
                     question.objective == Objective::signal ? "least" : "fewest",
                     what_is_minimised(question));
}

std::string status_name(Status status) {
  switch (status) {
    case Status::optimal:
      return "optimal (proven)";
    case Status::feasible:
      return "feasible (nothing proven)";
    case Status::infeasible:
      return "infeasible (proven)";
    case Status::stopped:
      return "stopped early";
  }
  return {};
}

Headline headline(const ReportData& data) {
  const CertifiedPlan& plan = data.input.plan;
  const Placement& placement = plan.placement;
  Headline result = data.has_selection()                     ? with_selection(data)
                    : placement.status == Status::infeasible ? infeasible(data)
                                                             : nothing_found(data);
  if (data.has_selection()) {
    if (std::string remark = closeness_remark(data); !remark.empty() && !plan.certificate)
      result.remarks.insert(result.remarks.begin(), std::move(remark));
    if (std::string remark = objective_remark(placement); !remark.empty())
      result.remarks.push_back(std::move(remark));
  }
  if (plan.certificate) put_certificate_first(plan, result);
  if (const std::string apart = kept_apart(placement); !apart.empty()) result.remarks.push_back(apart + ".");
  if (std::string remark = proof_remark(data); !remark.empty()) result.remarks.push_back(std::move(remark));
  if (!plan.certificate) result.remarks.push_back(sampling_remark(data));
  if (plan.sensitivity)
    result.remarks.push_back(with_joined_percent(statement(*plan.sensitivity, data.outcome.labels.size())));
  return result;
}

}  // namespace shelfbeam
