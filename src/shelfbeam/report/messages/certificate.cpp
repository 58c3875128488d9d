#include "shelfbeam/report/messages/certificate.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/messages/reach.hpp"

namespace shelfbeam {

namespace {

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
