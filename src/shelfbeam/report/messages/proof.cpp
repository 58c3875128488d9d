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
#include "shelfbeam/report/text/numbers.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

constexpr double rounding_of_costs = 1e-9;
std::string objective_text(const Words& words, const PlacementProblem& problem) {
  return words.say(fmt::format("objective.sum.{}", to_text(problem.objective)),
                   words.percent(problem.share, 0));
}

std::string joint_confidence(const Words& words, double confidence) {
  return words.say("certificate.confidence", words.confidence_text(confidence));
}

// " 3 labels are missed."
std::string other_labels(const Words& words, std::string_view key, const Certificate& certificate,
                         Verdict verdict) {
  const std::size_t count = certificate.count(verdict);
  return count == 0 ? "" : " " + words.say_count(key, count);
}

// A text that 3 are not enough, for a proven count of 4.
std::string fewer_are_not_enough(const Words& words, std::string_view key, std::size_t count) {
  return count <= 1 ? words.say(fmt::format("{}.any", key)) : words.say_count(key, count - 1);
}

// ", and 3 are not enough", or the certified lower bound on the count or the cost. A selection that is not
// certified to reach all labels may be below the bound.
std::string certified_bound(const Words& words, const CertifiedPlan& plan) {
  const Placement& placement = plan.placement;
  const auto [value, simulated, bound] = value_bounds(plan);
  const bool is_exact = std::abs(bound - value) <= rounding_of_costs * value;
  if (!has_known_prices(placement.problem)) {
    if (bound == 0) return {};
    return is_exact ? fewer_are_not_enough(words, "certificate.fewer", placement.count())
                    : words.say_count("certificate.at_least", static_cast<std::size_t>(bound));
  }
  const bool is_spend = placement.problem.combination == Combination::spend;
  std::string total = !is_spend         ? words.say("certificate.cost", words.plain(value))
                      : placement.price ? words.say("certificate.spend", money(words, value, placement.price))
                                        : std::string();
  if (bound == 0) return total;
  return total + (is_exact ? words.say("certificate.no_cheaper")
                           : words.say("certificate.costs_at_least",
                                       at_least(words, bound, is_spend ? placement.price : std::nullopt)));
}

std::string uncertified_objective(const Words& words, const PlacementProblem& problem) {
  if (!depends_on_signals(problem)) return {};
  return " " + (problem.combination == Combination::weighted
                    ? words.say("certificate.without_cost")
                    : words.say("certificate.without_objective", objective_text(words, problem)));
}

std::string scope(const Words& words, bool is_wanted) {
  return is_wanted ? " " + words.say("certificate.scope") : "";
}

std::string reached_sentence(const Words& words, const CertifiedPlan& plan, bool has_scope) {
  const Placement& placement = plan.placement;
  const Certificate& certificate = *plan.certificate;
  if (certificate.none_verified())
    return words.say("certificate.not_yet", units_reach(words, placement.count()),
                     all_labels(words, certificate.labels.size()), failure_clause(words, placement.problem));
  return words.say("certificate.reached", units_reach(words, placement.count()),
                   labels_reached(words, certificate.count(Verdict::reached), certificate.labels.size()),
                   failure_clause(words, placement.problem), certified_bound(words, plan),
                   joint_confidence(words, certificate.confidence)) +
         other_labels(words, "certificate.missed", certificate, Verdict::missed) +
         other_labels(words, "certificate.undecided", certificate, Verdict::undecided) +
         other_labels(words, "certificate.unverified", certificate, Verdict::unverified) +
         uncertified_objective(words, placement.problem) + scope(words, has_scope);
}

// Without a selection, only missed labels have a meaning: none of the candidates reaches them.
std::string out_of_reach_sentence(const Words& words, const Certificate& certificate, bool has_scope) {
  const std::size_t labels = certificate.labels.size(), missed = certificate.count(Verdict::missed);
  if (certificate.none_verified()) return words.say("certificate.none_not_yet", all_labels(words, labels));
  if (missed == 0) return words.say("certificate.none_undecided", all_labels(words, labels));
  return words.say("certificate.none", all_labels(words, labels),
                   joint_confidence(words, certificate.confidence), words.grouped(missed)) +
         scope(words, has_scope);
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

std::string money(const Words& words, double amount, const std::optional<Price>& price) {
  constexpr double hundredths = 100, rounding = 1e-6, max_exact = 1e15;
  const double scaled = std::round(hundredths * amount);
  std::string text;
  if (!(scaled < max_exact) || std::abs(hundredths * amount - scaled) > rounding * std::max(1.0, scaled)) {
    text = words.plain(amount);
  } else {
    const auto cents = static_cast<std::uint64_t>(scaled);
    text = words.grouped(cents / 100);
    if (cents % 100 != 0) text += words.fixed(static_cast<double>(cents % 100) / 100, 2).substr(1);
  }
  return price && !price->currency.empty() ? text + " " + price->currency : text;
}

std::string at_least(const Words& words, double bound, const std::optional<Price>& price) {
  const double rounded = rounded_down(bound, 2);
  return money(words, rounded > 0 ? rounded : bound * (1 - 1e-6), price);
}

std::string price_sentence(const Words& words, const Placement& placement) {
  if (!placement.price) return {};
  const Price& price = *placement.price;
  const std::string total = money(words, price.total, price);
  if (price.to_spend == price.total) return words.say("proof.price", total);
  return words.say("proof.price_both", money(words, price.to_spend, price), total);
}

std::string units_needed(const Words& words, std::size_t count_bound) {
  return words.say_count("proof.needed", count_bound);
}

namespace {

std::string spend_bound_text(const Words& words, const Placement& placement) {
  if (placement.status == Status::optimal) return words.say("proof.no_cheaper_or_fewer");
  if (cost_is_proven(placement)) return words.say("proof.no_cheaper");
  return words.say("proof.costs", at_least(words, placement.lower_bound, placement.price));
}

}  // namespace

std::string terminal_bound(const Words& words, const Placement& placement) {
  const std::size_t count_bound = proven_count(placement);
  if (placement.problem.combination == Combination::spend) return spend_bound_text(words, placement);
  if (count_bound < placement.count() && cost_is_proven(placement)) return words.say("proof.no_cheaper");
  return count_bound >= placement.count() ? fewer_are_not_enough(words, "proof.fewer", placement.count())
                                          : units_needed(words, count_bound);
}

std::string page_bound(const Words& words, const Placement& placement) {
  if (placement.problem.combination == Combination::spend || count_is_proven(placement))
    return words.say("proof.bound", terminal_bound(words, placement));
  if (cost_is_proven(placement)) return words.say("proof.bound", words("proof.no_cheaper"));
  const std::size_t count_bound = proven_count(placement);
  return count_bound == 0 ? words.say("proof.no_bound")
                          : words.say_count("proof.gap", count_bound, words.percent(count_gap(placement)));
}

std::string_view bound_proof_text(const Words& words, BoundProof proof) {
  return words(fmt::format("proof.method.{}", to_text(proof)));
}

std::string proof_sentence(const Words& words, const Placement& placement) {
  if (placement.status == Status::infeasible || proven_count(placement) == 0) return {};
  const std::string method = words.say("proof.by", bound_proof_text(words, placement.bound_proof));
  return placement.ties_settled ? fmt::format("{} {}", method, words("proof.ties")) : method;
}

std::string objective_name(const Words& words, const PlacementProblem& problem) {
  if (problem.combination == Combination::weighted)
    return problem.objective == Objective::count
               ? words.say("objective.name.cost")
               : words.say("objective.name.cost_and", objective_text(words, problem));
  if (problem.combination == Combination::spend) return words.say("objective.name.spend");
  return words.say(fmt::format("objective.name.{}", to_text(problem.objective)),
                   words.percent(problem.share, 0));
}

std::string objective_sentence(const Words& words, const Placement& placement) {
  const PlacementProblem& problem = placement.problem;
  if (problem.objective == Objective::count && problem.combination != Combination::weighted) return {};
  if (problem.combination == Combination::lexicographic &&
      (placement.status == Status::feasible || !count_is_proven(placement)))
    return words.say("objective.not_optimised", objective_text(words, problem));
  const bool is_weighted = problem.combination == Combination::weighted;
  const char* const state = placement.status == Status::optimal   ? "proven"
                            : placement.status == Status::stopped ? "stopped"
                                                                  : "plain";
  const std::string key =
      is_weighted ? fmt::format("objective.total.{}", state) : fmt::format("objective.secondary.{}", state);
  const std::string text = words.say(key, is_weighted ? "" : objective_text(words, problem),
                                     words.plain(placement.objective_value),
                                     words.plain_down(placement.lower_bound), words.percent(placement.gap()));
  return placement.unit_costs ? fmt::format("{} {}", text, words("objective.unit_costs")) : text;
}

std::string solver_text(const Words& words, const SolvedBy& solver) {
  const auto& [method, backend] = solver;
  if (method == Method::mip) return backend.value_or("");
  const std::string name = words.say(fmt::format("proof.solver.{}", to_text(method)));
  return backend ? words.say("proof.solver.with", name, *backend) : name;
}

std::string_view status_name(const Words& words, Status status) {
  return words(fmt::format("proof.status.{}", to_text(status)));
}

std::string certificate_sentence(const Words& words, const CertifiedPlan& plan, bool has_scope) {
  if (!plan.certificate) return {};
  const Certificate& certificate = *plan.certificate;
  return (plan.placement.has_selection() ? reached_sentence(words, plan, has_scope)
                                         : out_of_reach_sentence(words, certificate, has_scope)) +
         (certificate.open ? " " + words.say("certificate.ended", end_text(words, *certificate.open)) : "");
}

std::string sensitivity_sentence(const Words& words, const CertifiedPlan& plan, std::size_t labels) {
  const Sensitivity& sensitivity = *plan.sensitivity;
  const std::size_t missed = sensitivity.low.missed.size(), open = sensitivity.low.undecided.size();
  std::string largest;
  if (!sensitivity.materials.empty() &&
      sensitivity.materials.front().at_lower.min_margin.ratio < sensitivity.as_given.ratio)
    largest = words.say("sensitivity.largest", sensitivity.materials.front().material);
  std::string margin;
  if (plan.has_known_thresholds())
    margin = words.say("sensitivity.margin", words.plain(sensitivity.low.min_margin.ratio, 3),
                       words.plain(sensitivity.high.min_margin.ratio, 3));
  return words.say(missed + open == 0 ? "sensitivity.all" : "sensitivity.not_all",
                   words.grouped(labels - missed - open), words.grouped(labels),
                   joint_confidence(words, sensitivity.confidence), margin, largest, words.grouped(missed),
                   words.grouped(open));
}

}  // namespace shelfbeam
