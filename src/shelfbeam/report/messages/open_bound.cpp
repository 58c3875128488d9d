#include "shelfbeam/report/messages/open_bound.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/plan/answer/value_bounds.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

bool has_open_labels(const CertifiedPlan& plan) {
  return plan.certificate && !plan.certificate->all_reached();
}

// The bound that counts: a certified one, unless nothing is certified about the value.
double proven_bound(const CertifiedPlan& plan) {
  const ValueBounds bounds = value_bounds(plan);
  const bool is_covered = !minimises_cost(plan.placement.problem) || has_known_prices(plan.placement.problem);
  return plan.has_verdicts() && is_covered ? bounds.certified : bounds.simulated;
}

bool has_open_bound(const CertifiedPlan& plan) {
  return plan.placement.has_selection() && !plan.availability && !plan.placement.partial &&
         !(plan.has_verdicts() && has_open_labels(plan)) &&
         !value_bounds(plan).is_minimum(proven_bound(plan));
}

// "whether fewer transceivers are enough is open: 8 to 11", for a pattern of keys by kind of value.
std::string range(const Words& words, std::string_view pattern, const Placement& placement, double bound,
                  std::size_t installed) {
  const auto of_kind = [&](std::string_view kind, const std::string& low, const std::string& high) {
    return words.say(fmt::format(fmt::runtime(pattern), kind), low, high);
  };
  if (placement.problem.combination == Combination::spend)
    return of_kind("cheaper", at_least(words, bound, placement.price),
                   money(words, placement.objective_value, placement.price));
  if (placement.problem.combination == Combination::weighted)
    return of_kind("sum", at_least(words, bound, std::nullopt),
                   money(words, placement.objective_value, std::nullopt));
  const double low = std::max(0.0, std::round(bound) - static_cast<double>(installed));
  return of_kind(installed > 0 ? "fewer_new" : "fewer", words.grouped(static_cast<std::uint64_t>(low)),
                 words.grouped(placement.count() - installed));
}

Remedy longer_search(const Words& words, const CertifiedPlan& plan) {
  if (plan.placement.status == Status::feasible) return {words.say("open.remedy.exact"), {Setting::solver}};
  return {words.say("open.remedy.search"), {Setting::time_limit}};
}

// The search has to prove more, too, before a certificate can.
Remedy larger_budget(const Words& words, const CertifiedPlan& plan) {
  const ValueBounds bounds = value_bounds(plan);
  const bool is_alone = has_open_labels(plan) || bounds.is_minimum(bounds.simulated) ||
                        plan.placement.status == Status::feasible;
  if (is_alone) return {words.say("open.remedy.budget"), {Setting::budget}};
  return {words.say("open.remedy.both"), {Setting::budget, Setting::time_limit}};
}

}  // namespace

std::string open_bound(const Words& words, const CertifiedPlan& plan, std::size_t installed) {
  if (!has_open_bound(plan)) return {};
  const Placement& placement = plan.placement;
  const double bound = proven_bound(plan);
  if (!plan.has_verdicts())
    return words.say("open.uncertified", range(words, "open.range.{}", placement, bound, installed));
  const ValueBounds bounds = value_bounds(plan);
  const char* const pattern = bounds.is_minimum(bounds.simulated) ? "open.only_signals.{}" : "open.range.{}";
  return words.say_count("open.certified", plan.certificate->labels.size(),
                         range(words, pattern, placement, bound, installed));
}

Remedy remedy_for(const Words& words, const CertifiedPlan& plan) {
  const bool is_bound = has_open_bound(plan);
  if (!is_bound && !has_open_labels(plan)) return {};
  if (!plan.certificate || !plan.certificate->open) return is_bound ? longer_search(words, plan) : Remedy();
  switch (plan.certificate->open->cause) {
    case EndCause::budget:
    case EndCause::labels_cost:
    case EndCause::proof_cost:
    case EndCause::cheaper:
    case EndCause::other:
      return larger_budget(words, plan);
    case EndCause::time_limit:
    case EndCause::weak_bound:
    case EndCause::no_placement:
      return longer_search(words, plan);
    case EndCause::labels_near:
    case EndCause::signals_near:
      return {words.say("open.remedy.near"), {}};
    case EndCause::interrupted:
    case EndCause::conflicts:
    case EndCause::no_unit:
    case EndCause::plans_failed:
      break;
  }
  return {};
}

}  // namespace shelfbeam
