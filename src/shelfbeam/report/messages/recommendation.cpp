#include "shelfbeam/report/messages/recommendation.hpp"

#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reasons.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

std::string recommendation(const ReportData& data) {
  const CertifiedPlan& plan = data.input.plan;
  if (plan.availability)
    return with_joined_percent(states_recommendation(data.words, *plan.availability, plan.placement));
  const std::size_t labels = data.outcome.labels.size();
  const bool is_confirmed = !plan.has_verdicts() || plan.certificate->count(Verdict::reached) == labels;
  if (!data.has_selection() || plan.placement.partial || data.outcome.met < labels || labels == 0 ||
      !is_confirmed)
    return {};
  const Words& words = data.words;
  const LabelOutcome& weakest = data.outcome.labels[data.outcome.by_margin.front()];
  if (!(weakest.requirement > 0)) return {};
  if (!plan.has_known_thresholds()) return words.say("recommendation.confirm");
  const double margin = weakest.ratio();
  const std::string now = words.significant(margin);
  if (margin * (1 - close_share) >= 1) return words.say("recommendation.ample", now);
  const auto& more = plan.alternatives.one_more;
  if (!more) return words.say("recommendation.only", now);
  const std::string then = words.significant(more->smallest_margin);
  if (more->smallest_margin < worthwhile_gain * margin) return words.say("recommendation.this", now, then);
  const Placement& placement = plan.placement;
  const std::string price =
      more->price && placement.price
          ? words.say("recommendation.price",
                      money(words, more->price->to_spend - placement.price->to_spend, more->price))
          : std::string();
  return words.say("recommendation.more", words.grouped(more->selected.size()), price, now, then);
}

}  // namespace shelfbeam
