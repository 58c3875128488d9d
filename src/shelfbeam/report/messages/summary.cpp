#include "shelfbeam/report/messages/summary.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/report/messages/availability.hpp"
#include "shelfbeam/report/messages/known_values.hpp"
#include "shelfbeam/report/messages/open_bound.hpp"
#include "shelfbeam/report/messages/partial.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/proof_remarks.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/messages/reasons.hpp"
#include "shelfbeam/report/messages/recommendation.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

using Tone = Headline::Tone;

std::string verdict_of(const ReportData& data, Tone tone) {
  if ((data.input.plan.certificate && data.has_selection()) || data.input.plan.availability)
    return tone == Tone::yes ? verified_words(data.words, data.input.plan)
                             : data.words.say(fmt::format("verdict.certified.{}", key_of(tone)));
  if (tone == Tone::yes && data.uncertain > 0)
    return data.words.say_count("verdict.uncertified.uncertain", data.uncertain);
  const Tone shown = tone == Tone::open && data.has_selection() ? Tone::yes : tone;
  return data.words.say(fmt::format("verdict.uncertified.{}", key_of(shown)));
}

class SummaryWriter {
 public:
  explicit SummaryWriter(const ReportData& data)
      : data_(data),
        words_(data.words),
        plan_(data.input.plan),
        placement_(plan_.placement),
        verified_(plan_.has_verdicts()) {}

  Summary with_selection() {
    summary_.answer = answer();
    if (!plan_.availability || !plan_.availability->is_impossible()) add_price();
    if (plan_.availability) {
      add_availability(*plan_.availability);
      return std::move(summary_);
    }
    if (placement_.partial) summary_.remarks.push_back(partial_sentence(words_, placement_, labels()));
    ProofRemarks proof = proof_remarks(data_);
    if (!proof.bound.empty()) summary_.remarks.push_back(std::move(proof.bound));
    summary_.remarks.push_back(std::move(proof.confirmation));
    if (!plan_.sensitivity) summary_.remarks.push_back(words_.say("summary.not_examined"));
    add_achievements();
    add_risks();
    return std::move(summary_);
  }

  Summary without_selection() {
    const bool is_infeasible = placement_.status == Status::infeasible;
    summary_.answer = is_infeasible ? obstacle() : words_.say("summary.none.not_found");
    if (const std::size_t bound = proven_count(placement_); !is_infeasible && bound > 0)
      summary_.remarks.push_back(words_.say_count("summary.none.bound", bound));
    std::vector<LabelId> rows, dark;
    for (const Unreachable& label : placement_.unreachable) {
      rows.push_back(label.label);
      if (label.max_signal <= 0 && !data_.is_heard(label.label)) dark.push_back(label.label);
    }
    if (!rows.empty()) summary_.remarks.push_back(words_.say("summary.none.labels", data_.names.list(rows)));
    if (!dark.empty()) summary_.remarks.push_back(dark_labels(words_, dark.size()));
    summary_.remarks.push_back(words_.say(is_infeasible ? "summary.none.remedies" : "summary.none.unknown"));
    if (is_infeasible) summary_.remarks.push_back(confirmation_of_obstacle());
    return std::move(summary_);
  }

 private:
  std::size_t labels() const { return data_.outcome.labels.size(); }
  std::size_t reached() const {
    return verified_ ? plan_.certificate->count(Verdict::reached) : data_.outcome.met;
  }
  std::vector<LabelId> with(Verdict verdict) const {
    std::vector<LabelId> rows;
    for (std::uint32_t i = 0; i < labels(); ++i)
      if (verified_ ? plan_.certificate->labels[i].verdict == verdict
                    : verdict == Verdict::missed && !data_.outcome.labels[i].met)
        rows.push_back(i);
    return rows;
  }

  std::string answer() const {
    const std::size_t fresh = new_units(data_), installed = placement_.count() - fresh;
    const auto& availability = plan_.availability;
    const bool is_enough = availability ? availability->certified : reached() == labels();
    std::string mount =
        fresh > 0 ? words_.say_count("summary.answer.mount", fresh)
                  : words_.say_count(is_enough ? "summary.answer.nothing" : "summary.answer.keep", installed);
    if (fresh > 0 && installed > 0) mount = words_.say_count("summary.answer.beside", installed, mount);
    const std::string failure =
        placement_.problem.redundant ? words_.say("summary.answer.even_if") : std::string();
    if (availability)
      return with_joined_percent(
          availability->is_impossible()
              ? availability_sentence(words_, *availability, placement_, label_name())
              : words_.say(availability->certified ? "summary.answer.often" : "summary.answer.not_confirmed",
                           mount, goal_text(words_, *availability), failure));
    if (!is_enough)
      return words_.say(verified_ ? "summary.answer.confirmed" : "summary.answer.reaches", mount,
                        words_.grouped(reached()), words_.say_count("noun.label", labels()), failure);
    return words_.say(labels() == 1 ? "summary.answer.reaches_all.one" : "summary.answer.reaches_all.many",
                      mount, words_.grouped(labels()), failure);
  }

  std::string obstacle() const {
    if (placement_.partial) return partial_sentence(words_, placement_, labels());
    if (!placement_.unreachable.empty())
      return words_.say("summary.none.out_of_reach", page_out_of_reach(data_));
    const std::string why = conflict_reason(words_, placement_, data_.has_options());
    return why.empty() ? words_.say("summary.none.infeasible")
                       : words_.say("summary.none.not_together", not_all_together(words_, why));
  }

  std::string confirmation_of_obstacle() const {
    if (!verified_) return words_.say("summary.unchecked", words_("certificate.lacking"));
    const std::size_t missed = plan_.certificate->count(Verdict::missed);
    return missed == 0 ? words_.say("summary.none.undecided")
                       : words_.say_count("summary.none.checked", missed,
                                          confidence_percent(words_, plan_.certificate->confidence));
  }

  void add_price() {
    const std::size_t fresh = new_units(data_);
    if (!placement_.price || fresh == 0) return;
    const Price& price = *placement_.price;
    const std::string spend = joined(money(words_, price.to_spend, price));
    summary_.remarks.push_back(fresh == placement_.count()
                                   ? words_.say_count("summary.price", fresh, spend)
                                   : words_.say_count("summary.price_both", fresh, spend,
                                                      joined(money(words_, price.total, price))));
  }

  LabelName label_name() const {
    return [this](LabelId label) { return data_.names.name(label); };
  }

  void add_availability(const Availability& availability) {
    if (availability.certified)
      summary_.remarks.push_back(words_.say_count("summary.checked_states", availability.answer().states,
                                                  confidence_percent(words_, availability.confidence)));
    else if (!availability.is_impossible())
      summary_.remarks.push_back(
          with_joined_percent(availability_sentence(words_, availability, placement_, label_name())));
    for (std::string& remark : availability_remarks(words_, availability, placement_))
      summary_.remarks.push_back(with_joined_percent(std::move(remark)));
    add_achievements();
    if (std::string lost = lost_sentence(words_, availability, label_name()); !lost.empty())
      summary_.risks.push_back(std::move(lost));
    std::vector<LabelId> rarest;
    for (const LabelAtRisk& label : availability.at_risk) rarest.push_back(label.label);
    if (!rarest.empty())
      summary_.risks.push_back(
          words_.say("summary.risks.rarest", labels_by_cause(words_, availability, rarest, label_name())));
    add_risks();
  }

  void add_achievements() {
    if (labels() == 0) return;
    const LabelId weakest = data_.outcome.by_margin.front();
    const LabelOutcome& label = data_.outcome.labels[weakest];
    if (!plan_.has_known_thresholds())
      summary_.achieves.push_back(words_.say("summary.achieves.unknown"));
    else if (label.met)
      summary_.achieves.push_back(words_.say("summary.achieves.weakest", data_.names.name(weakest),
                                             words_.significant(label.ratio())));
    else
      summary_.achieves.push_back(words_.say("summary.achieves.weakest_short", data_.names.name(weakest),
                                             words_.percent(label.ratio(), 0)));
    const std::size_t secure = data_.outcome.secure, single = data_.outcome.met - secure;
    if (single == 0 && secure == labels())
      summary_.achieves.push_back(words_.say_count("summary.achieves.secure_all", labels()));
    else if (single > 0)
      summary_.achieves.push_back(
          words_.say_count("summary.achieves.secure", single, words_.grouped(secure)));
  }

  void risk(std::string_view key, const std::vector<LabelId>& rows) {
    if (!rows.empty()) summary_.risks.push_back(words_.say_count(key, rows.size(), data_.names.list(rows)));
  }
  void risk(std::string_view key, std::size_t count) {
    if (count > 0) summary_.risks.push_back(words_.say_count(key, count));
  }

  void add_risks() {
    risk("summary.risks.missed", with(Verdict::missed));
    risk("summary.risks.undecided", with(Verdict::undecided));
    if (verified_) risk("summary.risks.unverified", plan_.certificate->count(Verdict::unverified));
    const auto is_close = [](const LabelOutcome& label) {
      return label.met && label.signal * (1 - close_share) < label.requirement;
    };
    if (plan_.has_known_thresholds())
      risk("summary.risks.close",
           static_cast<std::size_t>(std::ranges::count_if(data_.outcome.labels, is_close)));
    else
      summary_.risks.push_back(words_.say("summary.risks.threshold"));
    const auto& units = data_.outcome.units;
    const auto most = std::max_element(
        units.begin(), units.end(),
        [](const UnitOutcome& a, const UnitOutcome& b) { return a.needed_by < b.needed_by; });
    if (most != units.end() && most->needed_by > 0)
      summary_.risks.push_back(
          words_.say_count("summary.risks.unit", most->needed_by, data_.unit_number(most->column)));
    add_materials();
    if (placement_.status == Status::stopped && !plan_.availability && !is_certified_minimum(plan_) &&
        open_bound(words_, plan_).empty())
      summary_.risks.push_back(words_.say("summary.risks.stopped"));
    risk("summary.risks.flagged", data_.outcome.flagged_labels);
    risk("summary.risks.warnings", plan_.warnings.size());
  }

  void add_materials() {
    if (!plan_.sensitivity) return;
    const std::size_t lost = plan_.sensitivity->low.missed.size() + plan_.sensitivity->low.undecided.size();
    summary_.risks.push_back(lost == 0 ? words_.say("summary.risks.darker_holds")
                                       : words_.say_count("summary.risks.darker", lost));
  }

  const ReportData& data_;
  const Words& words_;
  const CertifiedPlan& plan_;
  const Placement& placement_;
  bool verified_;
  Summary summary_;
};

}  // namespace

Summary summary_of(const ReportData& data) {
  SummaryWriter writer(data);
  Summary summary = data.has_selection() ? writer.with_selection() : writer.without_selection();
  summary.tone = headline(data).tone;
  summary.verdict = verdict_of(data, summary.tone);
  // The badge of assumed values does not have the colour of success.
  if (summary.tone == Tone::yes && data.input.plan.weakest_state() == ValueState::assumed)
    summary.tone = Tone::open;
  summary.assumed = assumed_sentence(data.words, data.input.plan);
  return summary;
}

}  // namespace shelfbeam
