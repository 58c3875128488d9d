#include "shelfbeam/report/messages/proof.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/end_reason.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/text/catalogue.hpp"

namespace shelfbeam {

namespace {

constexpr double rounding_of_costs = 1e-9;
std::string objective_text(const PlacementProblem& problem) {
  return say(fmt::format("objective.sum.{}", to_text(problem.objective)), percent(problem.share, 0));
}

std::string joint_confidence(double confidence) {
  return say("certificate.confidence", confidence_text(confidence));
}

// " 3 labels are missed."
std::string other_labels(std::string_view key, const Certificate& certificate, Verdict verdict) {
  const std::size_t count = certificate.count(verdict);
  return count == 0 ? "" : " " + say_count(key, count);
}

// A text that 3 are not enough, for a proven count of 4.
std::string fewer_are_not_enough(std::string_view key, std::size_t count) {
  return count <= 1 ? say(fmt::format("{}.any", key)) : say_count(key, count - 1);
}

// ", and 3 are not enough", or the certified lower bound on the count or the cost. A selection that is not
// certified to reach all labels may be below the bound.
std::string certified_bound(const CertifiedPlan& plan) {
  const Placement& placement = plan.placement;
  const auto [value, simulated, bound] = value_bounds(plan);
  const bool is_exact = std::abs(bound - value) <= rounding_of_costs * value;
  if (!has_known_prices(placement.problem)) {
    if (bound == 0) return {};
    return is_exact ? fewer_are_not_enough("certificate.fewer", placement.count())
                    : say_count("certificate.at_least", static_cast<std::size_t>(bound));
  }
  const bool is_spend = placement.problem.combination == Combination::spend;
  std::string total = !is_spend         ? say("certificate.cost", plain(value))
                      : placement.price ? say("certificate.spend", money(value, placement.price))
                                        : std::string();
  if (bound == 0) return total;
  return total + (is_exact ? say("certificate.no_cheaper")
                           : say("certificate.costs_at_least",
                                 at_least(bound, is_spend ? placement.price : std::nullopt)));
}

std::string uncertified_objective(const PlacementProblem& problem) {
  if (!depends_on_signals(problem)) return {};
  return " " + (problem.combination == Combination::weighted
                    ? say("certificate.without_cost")
                    : say("certificate.without_objective", objective_text(problem)));
}

std::string scope(bool is_wanted) {
  return is_wanted ? " " + say("certificate.scope") : "";
}

std::string reached_sentence(const CertifiedPlan& plan, bool has_scope) {
  const Placement& placement = plan.placement;
  const Certificate& certificate = *plan.certificate;
  if (certificate.none_verified())
    return say("certificate.not_yet", units_reach(placement.count()), all_labels(certificate.labels.size()),
               failure_clause(placement.problem));
  return say("certificate.reached", units_reach(placement.count()),
             labels_reached(certificate.count(Verdict::reached), certificate.labels.size()),
             failure_clause(placement.problem), certified_bound(plan),
             joint_confidence(certificate.confidence)) +
         other_labels("certificate.missed", certificate, Verdict::missed) +
         other_labels("certificate.undecided", certificate, Verdict::undecided) +
         other_labels("certificate.unverified", certificate, Verdict::unverified) +
         uncertified_objective(placement.problem) + scope(has_scope);
}

// Without a selection, only missed labels have a meaning: none of the candidates reaches them.
std::string out_of_reach_sentence(const Certificate& certificate, bool has_scope) {
  const std::size_t labels = certificate.labels.size(), missed = certificate.count(Verdict::missed);
  if (certificate.none_verified()) return say("certificate.none_not_yet", all_labels(labels));
  if (missed == 0) return say("certificate.none_undecided", all_labels(labels));
  return say("certificate.none", all_labels(labels), joint_confidence(certificate.confidence),
             grouped(missed)) +
         scope(has_scope);
}

}  // namespace

double count_gap(const Placement& placement) {
  const std::size_t count = placement.count(), count_bound = std::min(proven_count(placement), count);
  return count == 0 ? 0 : static_cast<double>(count - count_bound) / static_cast<double>(count);
}

bool count_is_proven(const Placement& placement) {
  return placement.count() > 0 && proven_count(placement) >= placement.count();
}

bool is_certified_minimum(const CertifiedPlan& plan) {
  const PlacementProblem& problem = plan.placement.problem;
  const bool is_single =
      problem.combination == Combination::weighted ||
      (problem.combination == Combination::lexicographic && problem.objective == Objective::count);
  const ValueBounds bounds = value_bounds(plan);
  return is_single && plan.certificate && plan.certificate->all_reached() &&
         bounds.is_minimum(bounds.certified);
}

std::string money(double amount, const std::optional<Price>& price) {
  constexpr double hundredths = 100, rounding = 1e-6, max_exact = 1e15;
  const double scaled = std::round(hundredths * amount);
  std::string text;
  if (!(scaled < max_exact) || std::abs(hundredths * amount - scaled) > rounding * std::max(1.0, scaled)) {
    text = plain(amount);
  } else {
    const auto cents = static_cast<std::uint64_t>(scaled);
    text =
        cents % 100 == 0 ? grouped(cents / 100) : fmt::format("{}.{:02}", grouped(cents / 100), cents % 100);
  }
  return price && !price->currency.empty() ? text + " " + price->currency : text;
}

std::string at_least(double bound, const std::optional<Price>& price) {
  const double rounded = rounded_down(bound, 2);
  return money(rounded > 0 ? rounded : bound * (1 - 1e-6), price);
}

std::string price_sentence(const Placement& placement) {
  if (!placement.price) return {};
  const Price& price = *placement.price;
  const std::string total = money(price.total, price);
  if (price.to_spend == price.total) return say("proof.price", total);
  return say("proof.price_both", money(price.to_spend, price), total);
}

std::string units_needed(std::size_t count_bound) {
  return say_count("proof.needed", count_bound);
}

namespace {

std::string spend_bound_text(const Placement& placement) {
  if (placement.status == Status::optimal) return say("proof.no_cheaper_or_fewer");
  if (cost_is_proven(placement)) return say("proof.no_cheaper");
  return say("proof.costs", at_least(placement.lower_bound, placement.price));
}

}  // namespace

std::string terminal_bound(const Placement& placement) {
  const std::size_t count_bound = proven_count(placement);
  if (placement.problem.combination == Combination::spend) return spend_bound_text(placement);
  if (count_bound < placement.count() && cost_is_proven(placement)) return say("proof.no_cheaper");
  return count_bound >= placement.count() ? fewer_are_not_enough("proof.fewer", placement.count())
                                          : units_needed(count_bound);
}

std::string page_bound(const Placement& placement) {
  if (placement.problem.combination == Combination::spend || count_is_proven(placement))
    return say("proof.bound", terminal_bound(placement));
  if (cost_is_proven(placement)) return say("proof.bound", words("proof.no_cheaper"));
  const std::size_t count_bound = proven_count(placement);
  return count_bound == 0 ? say("proof.no_bound")
                          : say_count("proof.gap", count_bound, percent(count_gap(placement)));
}

std::string_view bound_proof_text(BoundProof proof) {
  return words(fmt::format("proof.method.{}", to_text(proof)));
}

std::string proof_sentence(const Placement& placement) {
  if (placement.status == Status::infeasible || proven_count(placement) == 0) return {};
  const std::string method = say("proof.by", bound_proof_text(placement.bound_proof));
  return placement.ties_settled ? fmt::format("{} {}", method, words("proof.ties")) : method;
}

std::string objective_name(const PlacementProblem& problem) {
  if (problem.combination == Combination::weighted)
    return problem.objective == Objective::count ? say("objective.name.cost")
                                                 : say("objective.name.cost_and", objective_text(problem));
  if (problem.combination == Combination::spend) return say("objective.name.spend");
  return say(fmt::format("objective.name.{}", to_text(problem.objective)), percent(problem.share, 0));
}

std::string objective_sentence(const Placement& placement) {
  const PlacementProblem& problem = placement.problem;
  if (problem.objective == Objective::count && problem.combination != Combination::weighted) return {};
  if (problem.combination == Combination::lexicographic &&
      (placement.status == Status::feasible || !count_is_proven(placement)))
    return say("objective.not_optimised", objective_text(problem));
  const bool is_weighted = problem.combination == Combination::weighted;
  const char* const state = placement.status == Status::optimal   ? "proven"
                            : placement.status == Status::stopped ? "stopped"
                                                                  : "plain";
  const std::string key =
      is_weighted ? fmt::format("objective.total.{}", state) : fmt::format("objective.secondary.{}", state);
  const std::string text =
      say(key, is_weighted ? "" : objective_text(problem), plain(placement.objective_value),
          plain_down(placement.lower_bound), percent(placement.gap()));
  return placement.unit_costs ? fmt::format("{} {}", text, words("objective.unit_costs")) : text;
}

std::string solver_text(const SolvedBy& solver) {
  const auto& [method, backend] = solver;
  if (method == Method::mip) return backend.value_or("");
  const std::string name = say(fmt::format("proof.solver.{}", to_text(method)));
  return backend ? say("proof.solver.with", name, *backend) : name;
}

std::string_view status_name(Status status) {
  return words(fmt::format("proof.status.{}", to_text(status)));
}

std::string certificate_sentence(const CertifiedPlan& plan, bool has_scope) {
  if (!plan.certificate) return {};
  const Certificate& certificate = *plan.certificate;
  return (plan.placement.has_selection() ? reached_sentence(plan, has_scope)
                                         : out_of_reach_sentence(certificate, has_scope)) +
         (certificate.open ? " " + say("certificate.ended", end_text(*certificate.open)) : "");
}

std::string sensitivity_sentence(const Sensitivity& sensitivity, std::size_t labels) {
  const std::size_t missed = sensitivity.low.missed.size(), open = sensitivity.low.undecided.size();
  std::string largest;
  if (!sensitivity.materials.empty() &&
      sensitivity.materials.front().at_lower.min_margin.ratio < sensitivity.as_given.ratio)
    largest = say("sensitivity.largest", sensitivity.materials.front().material);
  return say(missed + open == 0 ? "sensitivity.all" : "sensitivity.not_all", grouped(labels - missed - open),
             grouped(labels), joint_confidence(sensitivity.confidence),
             fmt::format("{:.3g}", sensitivity.low.min_margin.ratio),
             fmt::format("{:.3g}", sensitivity.high.min_margin.ratio), largest, grouped(missed),
             grouped(open));
}

}  // namespace shelfbeam
