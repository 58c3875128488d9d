#include "shelfbeam/report/messages/proof_remarks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/open_bound.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

class ProofWriter {
 public:
  explicit ProofWriter(const ReportData& data)
      : words_(data.words),
        plan_(data.input.plan),
        placement_(data.input.plan.placement),
        certificate_(plan_.has_verdicts() ? &*plan_.certificate : nullptr),
        bounds_(value_bounds(data.input.plan)),
        labels_(data.outcome.labels.size()),
        installed_(placement_.count() - new_units(data)),
        applies_(!placement_.partial && data.outcome.met == labels_ && new_units(data) > 0 &&
                 !(certificate_ != nullptr && certificate_->count(Verdict::missed) > 0)) {}

  std::string bound() const {
    if (!applies_) return {};
    if (is_certified()) return of_kind("summary.bound.certified.{}");
    if (const std::string open = open_bound(words_, plan_, installed_); !open.empty())
      return remedy_for(words_, plan_).after(open);
    if (is_proven()) return of_kind("summary.bound.proven.{}");
    if (placement_.status == Status::feasible) return of_kind("summary.bound.greedy.{}");
    if (bounds_.simulated > bounds_.certified * (1 + 1e-9))
      return amount("summary.bound.some.{}", bounds_.simulated);
    return bounds_.certified > 0 ? of_kind("summary.bound.open.{}") : std::string();
  }

  std::string confirmation() const {
    if (certificate_ == nullptr) return words_.say("summary.unchecked", words_("certificate.lacking"));
    const bool is_all = certificate_->all_reached() && (is_certified() || bound().empty());
    const std::string confidence = confidence_percent(words_, certificate_->confidence);
    return words_.say("summary.checked", is_all
                                             ? words_.say("summary.confirms.this", confidence)
                                             : words_.say("summary.confirms.part", confidence, confirmed()));
  }

 private:
  bool is_certified() const { return certificate_ != nullptr && bounds_.is_minimum(bounds_.certified); }
  bool is_proven() const {
    return minimises_cost(placement_.problem) ? cost_is_proven(placement_) : count_is_proven(placement_);
  }

  std::string key_of_kind(std::string_view pattern) const {
    const char* const kind = placement_.problem.combination == Combination::spend      ? "cheaper"
                             : placement_.problem.combination == Combination::weighted ? "sum"
                             : installed_ > 0                                          ? "fewer_new"
                                                                                       : "fewer";
    return fmt::format(fmt::runtime(pattern), kind);
  }
  template <class... Args>
  std::string of_kind(std::string_view pattern, const Args&... args) const {
    return words_.say(key_of_kind(pattern), args...);
  }

  // With the bound in the words of the kind. Bounds on counts include installed units. Empty if installed
  // units alone meet the bound.
  template <class... Args>
  std::string amount(std::string_view pattern, double bound, const Args&... args) const {
    const std::string key = key_of_kind(pattern);
    if (placement_.problem.combination == Combination::spend)
      return words_.say(key, joined(at_least(words_, bound, placement_.price)), args...);
    if (placement_.problem.combination == Combination::weighted)
      return words_.say(key, at_least(words_, bound, std::nullopt), args...);
    const double fresh = std::round(bound) - static_cast<double>(installed_);
    return fresh < 1 ? std::string() : words_.say_count(key, static_cast<std::uint64_t>(fresh), args...);
  }

  // "888 of 926 labels receive enough signal",
  // "all 12 labels receive enough signal and that at least 4 transceivers are necessary"
  std::string confirmed() const {
    const std::size_t reached = certificate_->count(Verdict::reached);
    std::string labels =
        words_.say_count("summary.confirms.labels", reached, labels_reached(words_, reached, labels_));
    // A bound without labels needed no samples.
    if (!applies_ || certificate_->bound_labels == 0 || bounds_.certified == 0) return labels;
    if (is_certified()) return of_kind("summary.bound.confirmed.{}", labels);
    const std::string with_bound = amount("summary.bound.confirmed_some.{}", bounds_.certified, labels);
    return with_bound.empty() ? labels : with_bound;
  }

  const Words& words_;
  const CertifiedPlan& plan_;
  const Placement& placement_;
  const Certificate* certificate_;  ///< null without verdicts
  ValueBounds bounds_;
  std::size_t labels_, installed_;
  bool applies_;  ///< a bound says something
};

}  // namespace

ProofRemarks proof_remarks(const ReportData& data) {
  const ProofWriter writer(data);
  return {writer.bound(), writer.confirmation()};
}

std::size_t new_units(const ReportData& data) {
  const Selection& selected = data.input.plan.placement.selected;
  return static_cast<std::size_t>(std::count_if(selected.begin(), selected.end(), [&](std::uint32_t column) {
    return !data.transceiver(column).installed;
  }));
}

std::string joined(std::string text) {
  for (std::size_t at = 0; (at = text.find(' ', at)) != std::string::npos;) text.replace(at, 1, "\u00A0");
  return text;
}

std::string confidence_percent(const Words& words, double confidence) {
  return words.confidence_text(confidence) + "\u00A0%";
}

}  // namespace shelfbeam
