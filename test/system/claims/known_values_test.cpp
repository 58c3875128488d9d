// Page 1, terminal, batch and planner say the same of how well the values of a plan are known, and none of
// them claims a reserve on a threshold that is assumed.

#include "shelfbeam/report/messages/known_values.hpp"

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/report/batch/batch_report.hpp"
#include "shelfbeam/report/batch/store_result.hpp"
#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/messages/recommendation.hpp"
#include "shelfbeam/report/messages/summary.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/terminal/placement_text.hpp"
#include "shelfbeam/report/terminal/plan_text.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "jobs/event.hpp"
#include "jobs/plan_summary.hpp"
#include "system/claims/planned_stores.hpp"
#include "system/claims/sentences.hpp"
#include "system/claims/texts.hpp"

namespace shelfbeam {
namespace {

using test::PlannedStore;
using testing::HasSubstr;

constexpr std::uint32_t stores = 30, ways = 8;

// The words of a text between its places.
std::string words_in(const Words& words, std::string_view key) {
  const std::string_view text = words(key);
  std::string longest;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('{', at), text.size());
    if (end - at > longest.size()) longest = text.substr(at, end - at);
    at = end == text.size() ? end : text.find('}', end) + 1;
  }
  return longest;
}

// Sentences that put a reserve into words.
std::vector<std::string> reserves_in(const Words& words, const std::string& text) {
  std::vector<std::string> found;
  for (const char* key :
       {"recommendation.ample", "recommendation.only", "recommendation.this", "recommendation.more",
        "summary.achieves.title", "summary.achieves.weakest", "summary.achieves.weakest_short",
        "summary.risks.close.one", "summary.risks.close.many", "sensitivity.margin"})
    if (text.find(words_in(words, key)) != std::string::npos) found.emplace_back(key);
  // Of the terminal.
  for (const char* phrase : {"times its requirement", " ample ", "reserve for"})
    if (text.find(phrase) != std::string::npos) found.emplace_back(phrase);
  return found;
}

// What a result says in the places where it is shown.
struct Shown {
  std::string page, terminal, batch, planner;
  std::string badge;  // of page 1
};

Shown shown_of(PlannedStore& store, Language language) {
  store.scene.language = language;
  Shown shown;
  const ReportInput input{store.scene, store.matrix, store.plan};
  const ReportData data(input);
  const Summary summary = summary_of(data);
  shown.badge = summary.verdict;
  shown.page = fmt::format(
      "{}\n{}\n{}\n{}\n{}\n", summary.verdict, summary.answer, summary.assumed, recommendation(data),
      data.words(store.plan.has_known_thresholds() ? "summary.achieves.title"
                                                   : "summary.achieves.title_without_reserve"));
  for (const auto& list : {summary.remarks, summary.achieves, summary.risks})
    for (const std::string& sentence : list) shown.page += sentence + "\n";
  const PlanText text = plan_text(store.plan, store.table);
  shown.terminal = fmt::format("{}\n{}\n{}\n{}{}", text.answer, text.basis, text.open, text.details,
                               describe(store.plan.alternatives, store.plan.placement, store.table,
                                        store.plan.has_known_thresholds()));
  jobs::PlanEnd end;
  static_cast<CertifiedPlan&>(end.plan) = store.plan;
  end.table = store.table;
  const jobs::PlanSummary result = jobs::summary_of(end);
  shown.planner = jobs::line_of(jobs::JobResult{result, true});
  StoreResult of_batch;
  static_cast<PlanNumbers&>(of_batch) = result;
  of_batch.status = StoreStatus::planned;
  shown.batch = batch_html(english(), std::vector{of_batch});
  return shown;
}

bool is_certified(const CertifiedPlan& plan) {
  return plan.availability
             ? plan.availability->certified
             : plan.certificate && plan.placement.has_selection() && plan.certificate->all_reached();
}

TEST(KnownValuesOfPlansSlow, AreTheSameWhereverTheyAreShown) {
  std::set<std::string> badges;
  for (std::uint32_t number = 0; number < stores; ++number) {
    PlannedStore store = test::planned_store(number);
    for (std::uint32_t way = 0; way < ways; ++way)
      for (const Language language : {Language::english, Language::german}) {
        test::know_values(way, store.plan);
        const Words words(language);
        const Shown shown = shown_of(store, language);
        SCOPED_TRACE(fmt::format("{}, way {}, {}", store.name, way, to_text(language)));
        const bool all = is_certified(store.plan);
        const std::string expected = verified_words(words, store.plan);
        EXPECT_EQ(shown.badge == expected, all) << shown.badge;
        if (all) badges.insert(shown.badge);
        const std::string english_badge = verified_words(english(), store.plan) + ".";
        const std::string assumed = assumed_sentence(english(), store.plan);
        for (const std::string* text : {&shown.terminal, &shown.planner, &shown.batch}) {
          EXPECT_EQ(text->find(english_badge) != std::string::npos, all);
          if (assumed.empty()) continue;
          EXPECT_THAT(*text, HasSubstr(text == &shown.batch ? escape(assumed) : assumed));
        }
        EXPECT_THAT(shown.page, HasSubstr(assumed_sentence(words, store.plan)));
        EXPECT_EQ(assumed.empty(), store.plan.weakest_state() != ValueState::assumed);
      }
  }
  EXPECT_EQ(badges.size(), 6U) << "three states in two languages";
}

TEST(KnownValuesOfPlansSlow, NoneClaimsAReserveOnAnAssumedThreshold) {
  std::set<std::string> claimed;  // where thresholds are known
  std::size_t assumed = 0;
  for (std::uint32_t number = 0; number < stores; ++number) {
    PlannedStore store = test::planned_store(number);
    for (std::uint32_t way = 0; way < ways; ++way)
      for (const Language language : {Language::english, Language::german}) {
        test::know_values(way, store.plan);
        const Shown shown = shown_of(store, language);
        const bool is_known = store.plan.has_known_thresholds();
        assumed += is_known ? 0 : 1;
        for (const std::string* text : {&shown.page, &shown.terminal, &shown.batch, &shown.planner})
          for (const std::string& claim : reserves_in(Words(language), *text)) {
            claimed.insert(claim);
            EXPECT_TRUE(is_known) << claim << " in " << *text;
          }
        if (store.plan.weakest_state() == ValueState::assumed) {
          EXPECT_NE(shown.badge, Words(language)("verdict.certified.yes.confirmed"));
        }
      }
  }
  EXPECT_EQ(assumed, stores * 2 * 2U);
  EXPECT_GE(claimed.size(), 6U) << "the control: where a threshold is known, reserves are put into words";
}

// The control: each sentence of a plan with known thresholds that claims a reserve is caught if the threshold
// is assumed, and so is a plain badge.
TEST(KnownValuesOfPlans, SentencesThatClaimMoreAreCaught) {
  test::ClaimReader reader;
  std::size_t caught = 0, badges = 0;
  for (const std::uint32_t number : {0U, 1U, 9U, 21U, 24U}) {
    PlannedStore store = test::planned_store(number);
    test::know_values(3, store.plan);
    std::vector<test::Text> texts = test::texts_of(store);
    const test::Truth confirmed(store);
    test::know_values(2, store.plan);
    const test::Truth assumed(store);
    for (const test::Text& one : texts) {
      EXPECT_TRUE(reader.faults(one.text, confirmed, one.subject).empty()) << one.text;
      const bool is_wrong = !reader.faults(one.text, assumed, one.subject).empty();
      const bool is_badge = one.text.starts_with("Verified");
      const bool is_claim = !reserves_in(english(), one.text).empty();
      EXPECT_EQ(is_wrong, is_badge || is_claim) << one.text;
      caught += is_wrong && is_claim ? 1 : 0;
      badges += is_wrong && is_badge ? 1 : 0;
    }
  }
  EXPECT_GE(caught, 5U);
  EXPECT_GE(badges, 3U);
}

}  // namespace
}  // namespace shelfbeam
