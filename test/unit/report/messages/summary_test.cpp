#include "shelfbeam/report/messages/summary.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/report/messages/recommendation.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "unit/report/supermarket_report.hpp"

namespace shelfbeam {
namespace {

using test::Supermarket;

std::string all_of(const Summary& summary) {
  std::string text = summary.verdict + "\n" + summary.answer;
  for (const auto& list : {summary.remarks, summary.achieves, summary.risks})
    for (const std::string& sentence : list) text += "\n" + sentence;
  return text;
}

bool contains(const Supermarket& s, const std::string& piece) {
  return all_of(summary_of(ReportData(s.input))).find(piece) != std::string::npos;
}

// Words that a manager need not know. The confidence is named as on the other pages.
void expect_plain_words(const std::string& text) {
  for (const char* word :
       {"sampling", "standard error", "bound", "gap", "certificate", "median", "quantile", "decibel", " dB",
        "matrix", "cooperative", "lexicographic", "optimal", "feasible", "election"})
    EXPECT_EQ(text.find(word), std::string::npos) << word << " in:\n" << text;
}

TEST(Summary, HasNoTermsOfStatistics) {
  Supermarket s;
  for (const bool has_certificate : {false, true}) {
    if (has_certificate) test::certify(s);
    expect_plain_words(all_of(summary_of(ReportData(s.input))));
  }
  // The control: the statement for experts has them.
  EXPECT_NE(headline(ReportData(s.input)).answer.find("sampling"), std::string::npos);
}

TEST(Summary, SpeaksOfTheTimeIfTheShopChanges) {
  Supermarket s;
  Availability& availability = s.plan.availability.emplace();
  availability.required.assign(s.matrix.rows(), 0.95);
  availability.nominal = {8, 100, std::vector<std::uint32_t>(s.matrix.rows(), 1), 60};
  availability.nominal.missed[3] = 40;
  availability.sample = {9, 100, std::vector<std::uint32_t>(s.matrix.rows(), 0), 0};
  availability.sample_selected = {0};
  availability.sample_value = 9;
  availability.sample_lower_bound = 7;
  availability.lower_bound = 6;
  availability.examined = {{8, 300, std::vector<std::uint32_t>(s.matrix.rows(), 0), 0}};
  availability.assumed.stocking = {0.4, 1.0};
  for (const bool is_certified : {true, false}) {
    availability.certified = is_certified;
    if (!is_certified) availability.responsible = {3};
    expect_plain_words(all_of(summary_of(ReportData(s.input))));
    EXPECT_TRUE(contains(s, is_certified ? " to reach every label at least 95\u00A0% of the time"
                                         : "Undecided labels: " + ReportData(s.input).names.name(3)));
    EXPECT_NE(recommendation(ReportData(s.input)).find("would reach 1 label too rarely"), std::string::npos);
    EXPECT_TRUE(contains(s, "does not specify it: shelves are 40\u00A0% to 100\u00A0% full"));
  }
}

TEST(Summary, ExplainsThatNoPlanReachesAllLabels) {
  Supermarket s;
  s.placement.status = Status::infeasible;
  s.placement.selected.clear();
  s.placement.unreachable = {{.label = 3, .requirement = 1, .max_signal = 0.5},
                             {.label = 4, .requirement = 1, .max_signal = 0.5}};
  EXPECT_TRUE(
      contains(s, "Not possible\nNo plan reaches all labels: 2 of 926 labels cannot be reached, even"));
  EXPECT_TRUE(contains(s, "Out of reach: " + ReportData(s.input).names.name(3)));
  EXPECT_TRUE(contains(s, "Not certified"));
  expect_plain_words(all_of(summary_of(ReportData(s.input))));
  test::certify(s);
  for (LabelVerdict& label : s.plan.certificate->labels) label.verdict = Verdict::unverified;
  s.plan.certificate->labels[3].verdict = Verdict::missed;
  EXPECT_TRUE(contains(s, "confirms with 95\u00A0% confidence that at least 1 label cannot be reached"));
  expect_plain_words(all_of(summary_of(ReportData(s.input))));

  s.plan.certificate.reset();
  s.placement.status = Status::stopped;
  s.placement.unreachable.clear();
  s.placement.count_lower_bound = 5;
  EXPECT_TRUE(contains(s, "Open\nNo plan that reaches all labels was found in time."));
  EXPECT_TRUE(contains(s, "at least 5 transceivers are necessary"));
  EXPECT_FALSE(contains(s, "confirms"));
  expect_plain_words(all_of(summary_of(ReportData(s.input))));
}

TEST(Summary, CountsNewAndInstalledUnits) {
  Supermarket s;
  const std::string all = std::to_string(s.placement.count());
  EXPECT_TRUE(contains(s, "Mount " + all + " new transceivers: all 926 labels receive enough signal."));
  s.matrix.transceivers[s.placement.selected[0]].installed = true;
  EXPECT_TRUE(contains(s, "Mount " + std::to_string(s.placement.count() - 1) +
                              " new transceivers in addition to the one installed: all 926"));
  s.matrix.transceivers[s.placement.selected[1]].installed = true;
  EXPECT_TRUE(contains(s, "new transceivers in addition to the 2 installed: all 926"));
  for (const std::uint32_t j : s.placement.selected) s.matrix.transceivers[j].installed = true;
  EXPECT_TRUE(contains(s, "The " + all + " installed transceivers are enough: all 926"));
  test::certify(s);
  EXPECT_TRUE(contains(s, "Keep the " + all + " installed transceivers: 888 of 926 labels are confirmed"));
}

TEST(Summary, StatesPriceProofAndVerification) {
  Supermarket s;
  EXPECT_TRUE(contains(
      s, "Not certified: no independent samples have verified this result. It rests on one simulation"));
  EXPECT_FALSE(contains(s, "cost"));
  s.placement.price = Price{"EUR", 2040, 1800.5};
  EXPECT_TRUE(contains(s, "The new transceivers cost 1,800.50\u00A0EUR."));
  s.matrix.transceivers[s.placement.selected[0]].installed = true;
  EXPECT_TRUE(contains(s,
                       "The new transceivers cost 1,800.50\u00A0EUR; including those already installed, the "
                       "price is 2,040\u00A0EUR."));
  s.matrix.transceivers[s.placement.selected[0]].installed = false;
  s.placement.count_lower_bound = static_cast<double>(s.placement.count());
  EXPECT_TRUE(contains(s, "Fewer are not enough: this is proven for the simulated signals."));
  test::certify(s);
  EXPECT_TRUE(contains(s,
                       "A second, independent simulation confirms with 95\u00A0% confidence that 888 of 926 "
                       "labels receive enough signal."));
  for (LabelVerdict& label : s.plan.certificate->labels) label.verdict = Verdict::reached;
  EXPECT_TRUE(
      contains(s,
               "A second, independent simulation confirms with 95\u00A0% confidence that all 926 labels "
               "receive enough signal and that at least " +
                   std::to_string(s.placement.count() - 1) + " transceivers are necessary."));
  s.plan.certificate->count_lower_bound = s.placement.count();
  EXPECT_TRUE(contains(s, "Fewer are not enough.\n"));
  EXPECT_TRUE(contains(s, "A second, independent simulation confirms this with 95\u00A0% confidence."));
  for (LabelVerdict& label : s.plan.certificate->labels) label.verdict = Verdict::unverified;
  EXPECT_TRUE(contains(s, "Not certified"));
  EXPECT_FALSE(contains(s, "0 of 926"));
}

TEST(Summary, ProvesNoMoreThanTheSearch) {
  Supermarket s;
  s.placement.status = Status::stopped;
  s.placement.lower_bound = 290.0099;
  s.placement.objective_value = 400;
  s.placement.price = Price{"EUR", 400, 200};
  s.placement.problem.combination = Combination::weighted;
  EXPECT_TRUE(contains(s, "has a lower total cost is open: 290 to 400.")) << "installed units are part of it";
  s.placement.problem.combination = Combination::spend;
  EXPECT_TRUE(contains(s, "a cheaper choice is enough is open: 290 EUR to 400 EUR.")) << "rounded down";
  for (const std::uint32_t j : s.placement.selected) s.matrix.transceivers[j].installed = true;
  EXPECT_FALSE(contains(s, " is open")) << "nothing is bought";
  EXPECT_FALSE(contains(s, "EUR"));
}

TEST(Summary, NamesTheRisks) {
  Supermarket s;
  EXPECT_TRUE(contains(s, "darker than in the store file were not examined"));
  EXPECT_TRUE(contains(s, "the largest loss from any one unit"));
  s.plan.sensitivity.emplace().low.missed = {3, 4};
  EXPECT_TRUE(contains(s, "at its lowest plausible reflectance, 2 labels are missed or undecided"));
  s.plan.warnings = {{FindingCode::other, {}, {}, "x"}};
  EXPECT_TRUE(contains(s, "1 questionable value, listed below"));
  test::certify(s);
  EXPECT_TRUE(contains(s, "19 labels do not receive enough signal: "));
}

TEST(Summary, CountsLabelsThatOneUnitServes) {
  const Supermarket s;
  const ReportData data(s.input);
  std::size_t single = 0;
  for (std::uint32_t i = 0; i < data.outcome.labels.size(); ++i) {
    std::vector<double> signals;
    for (const std::uint32_t j : s.placement.selected)
      signals.push_back(static_cast<double>(s.matrix.mean[s.matrix.at(i, j)]));
    double sum = 0;
    for (const double signal : signals) sum += signal;
    const double without_strongest = sum - *std::max_element(signals.begin(), signals.end());
    if (data.outcome.labels[i].met && without_strongest < data.outcome.labels[i].requirement * (1 - 1e-9))
      ++single;
  }
  EXPECT_GT(single, 0U);
  EXPECT_EQ(data.outcome.met - data.outcome.secure, single);
  EXPECT_TRUE(contains(s, std::to_string(single) + " labels depend on a single transceiver"));
}

}  // namespace
}  // namespace shelfbeam
