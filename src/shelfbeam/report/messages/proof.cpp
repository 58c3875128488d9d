#include "shelfbeam/report/messages/proof.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/reach.hpp"

namespace shelfbeam {

namespace {

constexpr double rounding_of_costs = 1e-9;
constexpr std::string_view no_cheaper_selection = "it is proven that no selection costs less";

std::string objective_text(const PlacementProblem& problem) {
  const ObjectiveWords& words = words_of(problem.objective);
  return words.has_share
             ? fmt::format("{} (at least {} of the requirement)", words.sum, percent(problem.share, 0))
             : std::string(words.sum);
}

std::string joint_confidence(double confidence) {
  return fmt::format("with {:.6g} % confidence", 100 * confidence);
}

// " 3 labels are missed."
std::string other_labels(const Certificate& certificate, Verdict verdict) {
  const std::size_t count = certificate.count(verdict);
  return count == 0 ? "" : fmt::format(" {} {}.", counted(count, "label is", "labels are"), to_text(verdict));
}

// "3 are not enough", for a proven count of 4.
std::string fewer_are_not_enough(std::size_t count) {
  if (count <= 1) return "fewer are not enough";
  return fmt::format("{} {} not enough", grouped(count - 1), count == 2 ? "is" : "are");
}

// ", and 3 are not enough", or the certified lower bound on the count or the cost.
std::string certified_bound(const Placement& placement, const Certificate& certificate) {
  if (has_known_prices(placement.problem)) {
    const double cost = placement.objective_value, bound = std::min(certificate.cost_lower_bound, cost);
    const std::string total = fmt::format(" at a total cost of {}", plain(cost));
    if (bound <= 0) return total;
    return total + (bound < cost * (1 - rounding_of_costs)
                        ? fmt::format(", and reaching all labels costs at least {}", plain(bound))
                        : ", and no cheaper selection reaches all labels");
  }
  const std::size_t count = placement.count(), bound = std::min(certificate.count_lower_bound, count);
  if (bound == 0) return {};
  if (bound < count) return fmt::format(", and at least {} {} needed", bound, bound == 1 ? "is" : "are");
  return fmt::format(", and {}", fewer_are_not_enough(count));
}

std::string uncertified_objective(const PlacementProblem& problem) {
  if (!depends_on_signals(problem)) return {};
  return fmt::format(" The certificate does not cover the {}: it depends on simulated signals.",
                     problem.combination == Combination::weighted
                         ? "total cost"
                         : fmt::format("secondary objective ({})", objective_text(problem)));
}

constexpr std::string_view scope_sentence =
    " This confidence covers the sampling error of the simulation only; materials, stock and mounting are "
    "taken as in the store file.";

std::string reached_sentence(const Placement& placement, const Certificate& certificate) {
  if (certificate.none_verified())
    return fmt::format("{} {}{} on the simulated signals, which is not verified yet.",
                       units_reach(placement.count()), all_labels(certificate.labels.size()),
                       failure_clause(placement.problem));
  return fmt::format("{} {}{}{}, {}.", units_reach(placement.count()),
                     labels_reached(certificate.count(Verdict::reached), certificate.labels.size()),
                     failure_clause(placement.problem), certified_bound(placement, certificate),
                     joint_confidence(certificate.confidence)) +
         other_labels(certificate, Verdict::missed) + other_labels(certificate, Verdict::undecided) +
         other_labels(certificate, Verdict::unverified) + uncertified_objective(placement.problem) +
         std::string(scope_sentence);
}

// Without a selection, only missed labels have a meaning: none of the candidates reaches them.
std::string out_of_reach_sentence(const Certificate& certificate) {
  const std::size_t labels = certificate.labels.size(), missed = certificate.count(Verdict::missed);
  if (certificate.none_verified())
    return fmt::format("No selection reaches {} on the simulated signals, which is not verified yet.",
                       all_labels(labels));
  if (missed == 0)
    return fmt::format("It is undecided whether any selection reaches {}.", all_labels(labels));
  return fmt::format("{}, {}: at least {} cannot be reached.{}", no_selection_reaches(labels),
                     joint_confidence(certificate.confidence), grouped(missed), scope_sentence);
}

}  // namespace

std::size_t proven_count(const Placement& placement) {
  if (!std::isfinite(placement.count_lower_bound)) return 0;
  return static_cast<std::size_t>(std::max(0.0, std::ceil(placement.count_lower_bound - 1e-6)));
}

double count_gap(const Placement& placement) {
  const std::size_t count = placement.count(), count_bound = std::min(proven_count(placement), count);
  return count == 0 ? 0 : static_cast<double>(count - count_bound) / static_cast<double>(count);
}

bool count_is_proven(const Placement& placement) {
  return placement.count() > 0 && proven_count(placement) >= placement.count();
}

bool cost_is_proven(const Placement& placement) {
  return placement.status == Status::optimal && placement.problem.combination == Combination::weighted;
}

std::string units_needed(std::size_t count_bound) {
  return fmt::format("at least {} {} needed", counted(count_bound, "transceiver"),
                     count_bound == 1 ? "is" : "are");
}

std::string terminal_bound(const Placement& placement) {
  const std::size_t count_bound = proven_count(placement);
  if (count_bound < placement.count() && cost_is_proven(placement)) return std::string(no_cheaper_selection);
  return count_bound >= placement.count() ? "it is proven that " + fewer_are_not_enough(placement.count())
                                          : units_needed(count_bound);
}

std::string page_bound(const Placement& placement) {
  if (count_is_proven(placement)) return fmt::format("; {}.", terminal_bound(placement));
  if (cost_is_proven(placement)) return fmt::format("; {}.", no_cheaper_selection);
  const std::size_t count_bound = proven_count(placement);
  if (count_bound == 0) return "; no lower bound on the count is proven.";
  return fmt::format("; it is proven that at least {} {} needed (gap {}).", grouped(count_bound),
                     count_bound == 1 ? "is" : "are", percent(count_gap(placement)));
}

std::string_view bound_proof_text(BoundProof proof) {
  constexpr const char* words[] = {
      "counting without a search", "linear programming bound, recomputed from the matrix",
      "exhaustive search, log checked", "exhaustive search, log too long to check",
      "MIP solver, not verified independently"};
  return words[static_cast<std::size_t>(proof)];
}

std::string proof_sentence(const Placement& placement) {
  if (placement.status == Status::infeasible || proven_count(placement) == 0) return {};
  return fmt::format("Method of proof: {}.{}", bound_proof_text(placement.bound_proof),
                     placement.ties_settled
                         ? " Among equally good selections, this one has the largest minimum margin."
                         : "");
}

std::string objective_name(const PlacementProblem& problem) {
  if (problem.combination == Combination::weighted)
    return problem.objective == Objective::count
               ? "lowest cost of transceivers"
               : "lowest cost of transceivers and " + objective_text(problem);
  if (problem.objective == Objective::count) return "fewest transceivers";
  return fmt::format("fewest transceivers, then {} {}", words_of(problem.objective).fewest,
                     objective_text(problem));
}

std::string objective_sentence(const Placement& placement) {
  const PlacementProblem& problem = placement.problem;
  if (problem.objective == Objective::count && problem.combination == Combination::lexicographic) return {};
  if (problem.combination == Combination::lexicographic &&
      (placement.status == Status::feasible || !count_is_proven(placement)))
    return fmt::format(
        "The secondary objective ({}) is not optimised: the number of transceivers comes first.",
        objective_text(problem));
  const std::string value = plain(placement.objective_value);
  const std::string bound = plain(placement.lower_bound);
  const bool proven = placement.status == Status::optimal;
  std::string text;
  if (problem.combination == Combination::weighted)
    text = fmt::format("The total cost is {}{}", value, proven ? ", the proven minimum" : "");
  else
    text = fmt::format("The secondary objective ({}) is {}{}", objective_text(problem), value,
                       proven ? ", the proven minimum for this number of transceivers" : "");
  if (placement.status == Status::stopped)
    text += fmt::format("; the proven lower bound is {} (gap {})", bound, percent(placement.gap()));
  text += placement.unit_costs ? ". Without given costs, each link or signal counts as 1." : ".";
  return text;
}

std::string_view status_name(Status status) {
  constexpr const char* names[] = {"optimal (proven)", "feasible (not proven optimal)", "infeasible (proven)",
                                   "stopped early"};
  return names[static_cast<std::size_t>(status)];
}

std::string certificate_sentence(const CertifiedPlan& plan) {
  if (!plan.certificate) return {};
  const Certificate& certificate = *plan.certificate;
  return (plan.placement.has_selection() ? reached_sentence(plan.placement, certificate)
                                         : out_of_reach_sentence(certificate)) +
         (certificate.open.empty() ? "" : fmt::format(" Verification ended because {}.", certificate.open));
}

std::string sensitivity_sentence(const Sensitivity& sensitivity, std::size_t labels) {
  const std::size_t missed = sensitivity.low.missed.size(), open = sensitivity.low.undecided.size();
  std::string text =
      fmt::format("{} of {} labels are reached ", grouped(labels - missed - open), grouped(labels));
  text += missed + open == 0
              ? "for all reflectances within their ranges"
              : fmt::format("with all reflectances at the low end of their ranges ({} missed, {} undecided)",
                            grouped(missed), grouped(open));
  text += fmt::format(", {}; the smallest signal is {:.3g} to {:.3g} times the requirement",
                      joint_confidence(sensitivity.confidence), sensitivity.low.min_margin.ratio,
                      sensitivity.high.min_margin.ratio);
  if (!sensitivity.materials.empty() &&
      sensitivity.materials.front().at_lower.min_margin.ratio < sensitivity.as_given.ratio)
    text +=
        fmt::format("; '{}' is estimated to have the largest effect", sensitivity.materials.front().material);
  return text + ".";
}

}  // namespace shelfbeam
