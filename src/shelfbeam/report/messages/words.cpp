#include "shelfbeam/report/messages/words.hpp"

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

std::string what_is_forbidden(const Placement& placement) {
  if (placement.min_spacing > 0) return fmt::format("units must be {:.6g} m apart", placement.min_spacing);
  return placement.forbidden_pairs > 0 ? "some pairs must not be chosen together" : "";
}

}  // namespace

std::string_view behind_bound(BoundProof proof) {
  switch (proof) {
    case BoundProof::trivial:
      return "what is plain without a search";
    case BoundProof::dual:
      return "a dual solution, added up again from the matrix";
    case BoundProof::log:
      return "exhaustive search, its log checked";
    case BoundProof::search:
      return "exhaustive search, its log too long to be checked";
    case BoundProof::solver:
      return "the word of a MIP solver";
  }
  return {};
}

std::string kept_apart(const Placement& placement) {
  const std::string forbidden = what_is_forbidden(placement);
  if (forbidden.empty()) return {};
  const std::size_t pairs = placement.forbidden_pairs;
  return fmt::format("{} {} kept apart: {}", counted(pairs, "pair of candidates", "pairs of candidates"),
                     pairs == 1 ? "is" : "are", forbidden);
}

std::string why_exclusive(const Placement& placement, bool has_options) {
  const std::string options = has_options ? "a mounting point holds one unit" : "";
  const std::string forbidden = what_is_forbidden(placement);
  return options + (options.empty() || forbidden.empty() ? "" : " and ") + forbidden;
}

std::string_view why_nothing(const Question& question, bool is_heard) {
  if (!is_heard) return "no light arrives at all: is it inside something, or facing into it?";
  if (question.redundant) return "light arrives from one place only, and the unit there may fail";
  return "light arrives only from candidates that an installed unit rules out";
}

namespace {

std::string units(std::size_t count) {
  return fmt::format("{} transceiver{}", count, count == 1 ? "" : "s");
}

std::string named(const Certificate& certificate, Verdict verdict, std::string_view what) {
  const std::size_t count = certificate.count(verdict);
  return count == 0 ? "" : fmt::format(" {} {} {}.", count, count == 1 ? "label is" : "labels are", what);
}

std::string confidence_of(const Certificate& certificate) {
  return fmt::format("{:.6g} %", 100 * certificate.confidence);
}

std::string what_is_reached(const Placement& placement, const Certificate& certificate) {
  const std::size_t labels = certificate.labels.size(), count = placement.count();
  const std::size_t bound = std::min(certificate.count_lower_bound, count);
  const std::string confidence = confidence_of(certificate);
  std::string text = fmt::format("{} {} ", units(count), count == 1 ? "reaches" : "reach");
  text += certificate.all_reached()
              ? fmt::format("all {} labels", labels)
              : fmt::format("{} of {} labels", certificate.count(Verdict::reached), labels);
  if (placement.question.redundant) text += ", whichever unit fails";
  if (bound == count && count > 0)
    text += fmt::format(", and {} cannot reach all, with joint confidence {}.",
                        count == 1 ? "none" : fmt::format("{}", count - 1), confidence);
  else if (bound > 0)
    text += fmt::format(", and at least {} {} needed, with joint confidence {}.", bound,
                        bound == 1 ? "is" : "are", confidence);
  else
    text += fmt::format(", with joint confidence {}.", confidence);
  return text + named(certificate, Verdict::missed, "missed") +
         named(certificate, Verdict::undecided, "undecided");
}

// Of what no selection reaches, others than those that are missed are of no matter.
std::string what_is_out_of_reach(const Certificate& certificate) {
  const std::size_t labels = certificate.labels.size(), missed = certificate.count(Verdict::missed);
  if (missed == 0) return fmt::format("Whether any selection reaches all {} labels is undecided.", labels);
  return fmt::format(
      "No selection reaches all {} labels, with joint confidence {}: at least {} cannot be reached.", labels,
      confidence_of(certificate), missed);
}

}  // namespace

std::string statement(const CertifiedPlan& plan) {
  if (!plan.certificate) return {};
  const Certificate& certificate = *plan.certificate;
  return (plan.placement.has_selection() ? what_is_reached(plan.placement, certificate)
                                         : what_is_out_of_reach(certificate)) +
         (certificate.open.empty() ? "" : fmt::format(" It ended because {}.", certificate.open));
}

std::string statement(const Sensitivity& sensitivity, std::size_t labels) {
  const std::size_t missed = sensitivity.low.missed.size(), open = sensitivity.low.undecided.size();
  const std::string confidence = fmt::format("joint confidence {:.6g} %", 100 * sensitivity.confidence);
  std::string text =
      missed + open == 0
          ? fmt::format("{0} of {0} labels are reached wherever in their ranges the reflectances are", labels)
          : fmt::format(
                "{} of {} labels are reached with all reflectances at the low end of their ranges, "
                "{} missed, {} undecided",
                labels - missed - open, labels, missed, open);
  text += fmt::format(", with {}; the weakest gets {:.3g} to {:.3g} of its requirement", confidence,
                      sensitivity.low.least.ratio, sensitivity.high.least.ratio);
  if (!sensitivity.materials.empty() &&
      sensitivity.materials.front().at_lower.least.ratio < sensitivity.as_given.ratio)
    text += fmt::format("; by estimate, '{}' matters most", sensitivity.materials.front().material);
  return text + ".";
}

}  // namespace shelfbeam
