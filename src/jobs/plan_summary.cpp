#include "jobs/plan_summary.hpp"

#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/terminal/plan_text.hpp"

namespace shelfbeam::jobs {

namespace {

// The proven bound on the count behind the answer: that of the certificate if labels are verified.
std::size_t count_bound(const CertifiedPlan& plan) {
  const bool is_verified = plan.certificate && !plan.certificate->none_verified();
  return is_verified ? plan.certificate->count_lower_bound : proven_count(plan.placement);
}

}  // namespace

PlanSummary summary_of(const PlanEnd& end) {
  const Plan& plan = end.plan;
  const Placement& placement = plan.placement;
  PlanSummary summary;
  summary.code = end.code;
  summary.answer = plan_text(plan, end.table, false).answer;
  summary.labels = end.table.rows();
  // Without an answer, units and bound are those of the shop as the file gives it.
  if (end.code != answer_is_no) {
    if (placement.count() > 0) summary.units = placement.count();
    if (const std::size_t bound = count_bound(plan); bound > 0) summary.lower_bound = bound;
  }
  if (placement.price) {
    summary.price = placement.price->to_spend;
    summary.currency = placement.price->currency;
  }
  summary.warnings = plan.warnings;
  return summary;
}

}  // namespace shelfbeam::jobs
