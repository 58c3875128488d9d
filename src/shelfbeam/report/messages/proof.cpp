#include "shelfbeam/report/messages/proof.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/reach.hpp"

namespace shelfbeam {

namespace {

std::string what_is_minimised(const Question& question) {
  const ObjectiveWords& words = words_of(question.objective);
  return words.has_share
             ? fmt::format("{} (from {} of the requirement on)", words.sum, percent(question.share, 0))
             : std::string(words.sum);
}

std::string joint_confidence(double confidence) {
  return fmt::format("with joint confidence {:.6g} %", 100 * confidence);
}

// " 3 labels are missed."
std::string other_labels(const Certificate& certificate, Verdict verdict) {
  const std::size_t count = certificate.count(verdict);
  return count == 0 ? "" : fmt::format(" {} {}.", counted(count, "label is", "labels are"), to_text(verdict));
}

// ", and 3 cannot reach all": what is known of fewer units.
std::string fewer_units(const Certificate& certificate, std::size_t count) {
  const std::size_t bound = std::min(certificate.count_lower_bound, count);
  if (bound == 0) return {};
  if (bound < count) return fmt::format(", and at least {} {} needed", bound, bound == 1 ? "is" : "are");
  return fmt::format(", and {} cannot reach all", count == 1 ? "none" : fmt::format("{}", count - 1));
}

std::string what_is_reached(const Placement& placement, const Certificate& certificate) {
  return fmt::format("{} {}{}{}, {}.", units_reach(placement.count()),
                     labels_reached(certificate.count(Verdict::reached), certificate.labels.size()),
                     whichever_fails(placement.question), fewer_units(certificate, placement.count()),
                     joint_confidence(certificate.confidence)) +
         other_labels(certificate, Verdict::missed) + other_labels(certificate, Verdict::undecided);
}

// Of what no selection reaches, others than those that are missed are of no matter.
std::string what_is_out_of_reach(const Certificate& certificate) {
  const std::size_t labels = certificate.labels.size(), missed = certificate.count(Verdict::missed);
  if (missed == 0) return fmt::format("Whether any selection reaches {} is undecided.", all_labels(labels));
  return fmt::format("{}, {}: at least {} cannot be reached.", no_selection_reaches(labels),
                     joint_confidence(certificate.confidence), grouped(missed));
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

bool count_is_proven(const Placement& placement) {
  return placement.count() > 0 && least_count(placement) >= placement.count();
}

std::string units_needed(std::size_t least) {
  return fmt::format("at least {} {} needed", counted(least, "transceiver"), least == 1 ? "is" : "are");
}

std::string terminal_bound(const Placement& placement) {
  const std::size_t least = least_count(placement);
  return least >= placement.count() ? "fewer cannot, proven" : units_needed(least);
}

std::string page_bound(const Placement& placement) {
  const std::size_t least = least_count(placement);
  const std::string needed = fmt::format("{} {} needed", grouped(least), least == 1 ? "is" : "are");
  if (count_is_proven(placement)) return fmt::format("; at least {} (proven).", needed);
  if (placement.status == Status::optimal && placement.question.combination == Combination::weighted)
    return "; no selection has a lower total cost (proven).";
  if (least == 0) return "; how few would do is not known.";
  return fmt::format("; it is proven that at least {} (gap {}).", needed, percent(count_gap(placement)));
}

std::string_view behind_bound(BoundProof proof) {
  constexpr const char* words[] = {
      "what is plain without a search", "a dual solution, added up again from the matrix",
      "exhaustive search, its log checked", "exhaustive search, its log too long to be checked",
      "the word of a MIP solver"};
  return words[static_cast<std::size_t>(proof)];
}

std::string proof_sentence(const Placement& placement) {
  if (placement.status == Status::infeasible || least_count(placement) == 0) return {};
  return fmt::format("What is proven rests on {}.{}", behind_bound(placement.bound_proof),
                     placement.ties_settled
                         ? " Of all selections that are as good this has the largest smallest margin."
                         : "");
}

std::string objective_name(const Question& question) {
  if (question.combination == Combination::weighted)
    return question.objective == Objective::count
               ? "least cost of transceivers"
               : "least cost of transceivers and " + what_is_minimised(question);
  if (question.objective == Objective::count) return "fewest transceivers";
  return fmt::format("fewest transceivers, then {} {}", words_of(question.objective).fewest,
                     what_is_minimised(question));
}

std::string objective_sentence(const Placement& placement) {
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

std::string_view status_name(Status status) {
  constexpr const char* names[] = {"optimal (proven)", "feasible (nothing proven)", "infeasible (proven)",
                                   "stopped early"};
  return names[static_cast<std::size_t>(status)];
}

std::string certificate_sentence(const CertifiedPlan& plan) {
  if (!plan.certificate) return {};
  const Certificate& certificate = *plan.certificate;
  return (plan.placement.has_selection() ? what_is_reached(plan.placement, certificate)
                                         : what_is_out_of_reach(certificate)) +
         (certificate.open.empty() ? "" : fmt::format(" It ended because {}.", certificate.open));
}

std::string sensitivity_sentence(const Sensitivity& sensitivity, std::size_t labels) {
  const std::size_t missed = sensitivity.low.missed.size(), open = sensitivity.low.undecided.size();
  std::string text =
      fmt::format("{} of {} labels are reached ", grouped(labels - missed - open), grouped(labels));
  text += missed + open == 0
              ? "wherever in their ranges the reflectances are"
              : fmt::format("with all reflectances at the low end of their ranges, {} missed, {} undecided",
                            grouped(missed), grouped(open));
  text += fmt::format(", {}; the weakest gets {:.3g} to {:.3g} of its requirement",
                      joint_confidence(sensitivity.confidence), sensitivity.low.least.ratio,
                      sensitivity.high.least.ratio);
  if (!sensitivity.materials.empty() &&
      sensitivity.materials.front().at_lower.least.ratio < sensitivity.as_given.ratio)
    text += fmt::format("; by estimate, '{}' matters most", sensitivity.materials.front().material);
  return text + ".";
}

}  // namespace shelfbeam
