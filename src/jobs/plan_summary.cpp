#include "jobs/plan_summary.hpp"

#include <cstdint>

#include "shelfbeam/placement/answer/incumbent.hpp"
#include "shelfbeam/plan/answer/value_bounds.hpp"
#include "shelfbeam/report/terminal/plan_text.hpp"

namespace shelfbeam::jobs {

namespace {

// The proven bound on the value behind the answer: that of the certificate if labels are verified.
void add_bound(const CertifiedPlan& plan, PlanSummary& summary) {
  const Placement& placement = plan.placement;
  const ValueBounds bounds = value_bounds(plan);
  const double bound = plan.has_verdicts() ? bounds.certified : bounds.simulated;
  if (!(bound > 0)) return;
  if (!minimises_cost(placement.problem))
    summary.lower_bound = static_cast<std::uint64_t>(bound);
  else if (placement.problem.combination == Combination::spend && placement.price)
    summary.price_lower_bound = bounds.is_minimum(bound) ? placement.price->to_spend : bound;
}

}  // namespace

PlanSummary summary_of(const PlanEnd& end) {
  const Plan& plan = end.plan;
  const Placement& placement = plan.placement;
  PlanSummary summary;
  summary.code = end.code;
  summary.selected = detail::ids_of(end.table, placement.selected);
  const PlanText text = plan_text(plan, end.table, false);
  summary.answer = text.open.empty() ? text.answer : text.answer + " " + text.open;
  summary.basis = text.basis;
  summary.labels = end.table.rows();
  // Without an answer, units and bound are those of the shop as the file gives it.
  if (end.code != answer_is_no) {
    if (placement.count() > 0) summary.units = placement.count();
    add_bound(plan, summary);
  }
  if (placement.price) {
    summary.price = placement.price->to_spend;
    summary.currency = placement.price->currency;
  }
  summary.warnings = plan.warnings;
  return summary;
}

}  // namespace shelfbeam::jobs
