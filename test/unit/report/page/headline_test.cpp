#include "shelfbeam/report/page/headline.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "unit/report/supermarket_report.hpp"

namespace shelfbeam {
namespace {

using test::fault;
using test::pieces;
using test::Supermarket;

TEST(Headline, SaysWhatIsProven) {
  Supermarket s;
  const std::size_t k = s.placement.count();
  const auto answer = [&] { return headline(ReportData(s.input)).answer; };
  const std::string reach = std::to_string(k) + " transceivers reach all 926 labels; ";
  EXPECT_EQ(answer(), reach + "at least " + std::to_string(k) + " are needed (proven).");

  s.placement.status = Status::stopped;
  s.placement.count_lower_bound = s.placement.lower_bound =
      static_cast<double>(k) - 1.6;  // rounded up: k - 1
  EXPECT_EQ(answer(), reach + "it is proven that at least " + std::to_string(k - 1) + " are needed (gap " +
                          percent(1.0 / static_cast<double>(k)) + ").");
  EXPECT_EQ(headline(ReportData(s.input)).tone, Headline::Tone::open);
  EXPECT_EQ(fault(report_html(s.input)), "");

  s.placement.question.objective = Objective::links;
  s.placement.count_lower_bound = static_cast<double>(k);
  s.placement.objective_value = 1000;
  s.placement.lower_bound = 900;
  EXPECT_EQ(answer(), reach + "at least " + std::to_string(k) + " are needed (proven).");
  const std::string html = report_html(s.input);
  EXPECT_NE(html.find("links: 1000; at least 900 is proven (gap 10.0\u00A0%)."), std::string::npos);
  EXPECT_EQ(fault(html), "");

  s.placement.question.combination = Combination::weighted;
  s.placement.status = Status::optimal;
  s.placement.count_lower_bound = 1;
  EXPECT_EQ(answer(), reach + "no selection has a lower total cost (proven).");
}

bool any_remark(const ReportInput& input, const std::string& part) {
  const auto remarks = headline(ReportData(input)).remarks;
  return std::any_of(remarks.begin(), remarks.end(),
                     [&](const auto& remark) { return remark.find(part) != std::string::npos; });
}

TEST(Headline, SpeaksOfTheSecondAimOnlyWhereItWasSearchedFor) {
  Supermarket s;
  const auto k = static_cast<double>(s.placement.count());
  s.placement.question.objective = Objective::links;
  s.placement.status = Status::stopped;
  s.placement.objective_value = 1000;
  s.placement.lower_bound = 900;
  for (const bool proven : {true, false}) {
    s.placement.count_lower_bound = proven ? k : k - 1;
    EXPECT_EQ(any_remark(s.input, "Among selections of this size"), proven);
    EXPECT_EQ(any_remark(s.input, "was not searched for"), !proven);
  }
  EXPECT_TRUE(pieces(report_html(s.input)).contains("stopped early"));
  EXPECT_TRUE(pieces(report_html(s.input)).contains("Gap of the objective"));
  s.placement.question.objective = Objective::count;
  EXPECT_FALSE(pieces(report_html(s.input)).contains("Gap of the objective"));
}

TEST(Headline, SaysHowManyLabelsSamplingErrorCouldTurn) {
  Supermarket s;
  std::fill(s.matrix.standard_error.begin(), s.matrix.standard_error.end(), 0.0F);
  EXPECT_TRUE(pieces(report_html(s.input)).contains("Solved"));
  EXPECT_FALSE(any_remark(s.input, "so close to"));

  // The label of least margin is off by some amount: with half of it as standard error it is just certain
  // (1 % to spare for the rounding to 32 bits), with a little more it is not.
  const Outcome outcome = outcome_of(s.matrix, s.placement);
  const std::uint32_t row = outcome.by_margin.front();
  const LabelOutcome& label = outcome.labels[row];
  float& error = s.matrix.standard_error[s.matrix.at(row, *label.strongest)];
  error = static_cast<float>(0.495 * (label.signal - label.requirement));
  ASSERT_GT(error, 0);
  EXPECT_EQ(uncertain_labels(s.matrix, outcome), 0U);
  error = static_cast<float>(0.505 * (label.signal - label.requirement));
  EXPECT_EQ(uncertain_labels(s.matrix, outcome), 1U);
  EXPECT_TRUE(any_remark(s.input, "At least one label lies so close to its requirement"));
  EXPECT_TRUE(pieces(report_html(s.input)).contains("Solved, 1 label uncertain"));
}

TEST(Headline, SaysThatOptionsExcludeOneAnother) {
  Supermarket s;
  for (TransceiverColumn& unit : s.matrix.transceivers) unit.position = s.matrix.transceivers[0].position;
  s.placement = {};
  s.placement.status = Status::infeasible;
  s.placement.solver = "highs 1.10.0";
  EXPECT_EQ(headline(ReportData(s.input)).answer,
            "No selection can do it: each label could be reached, but not all of them at once, because a "
            "mounting point holds one unit.");
  const std::string html = report_html(s.input);
  EXPECT_EQ(fault(html), "");
  EXPECT_TRUE(pieces(html).contains("each alone could be reached"));
  EXPECT_TRUE(any_remark(s.input, "if the best option of every mounting point were on"));

  s.placement.unreachable = {{0, 1, 0.5}};
  EXPECT_EQ(
      headline(ReportData(s.input)).answer,
      "No selection can do it: 1 of 926 labels cannot be reached, even with the best option of the only "
      "mounting point on.");
  s.placement = {};
  s.placement.solver = "greedy";
  s.placement.count_lower_bound = 2;
  EXPECT_EQ(headline(ReportData(s.input)).answer,
            "The greedy method found no selection; it is proven that at least 2 transceivers are needed.");
  EXPECT_TRUE(any_remark(s.input, "an exact search may find one"));
}

TEST(Headline, SaysWhatWasKeptApart) {
  Supermarket s;
  EXPECT_FALSE(any_remark(s.input, "apart"));
  EXPECT_FALSE(pieces(report_html(s.input)).contains("Pairs of candidates kept apart"));
  s.placement.forbidden_pairs = 1200;
  EXPECT_TRUE(any_remark(s.input, "1,200 pairs of candidates are kept apart: some pairs must not be chosen"));
  s.placement.min_spacing = 2.5;
  EXPECT_NE(
      headline(ReportData(s.input)).answer.find("926 labels, every new one at least 2.5 m from all others; "),
      std::string::npos);
  EXPECT_TRUE(any_remark(s.input, "1,200 pairs of candidates are kept apart: units must be 2.5 m apart."));
  const auto cells = pieces(report_html(s.input));
  for (const char* fact :
       {"Least distance between two units", "2.5\u00A0m", "Pairs of candidates kept apart", "1,200"})
    EXPECT_TRUE(cells.contains(fact)) << fact;

  const std::size_t pairs = s.placement.forbidden_pairs;
  s.placement = {};
  s.placement.status = Status::infeasible;
  s.placement.forbidden_pairs = pairs;
  EXPECT_EQ(
      headline(ReportData(s.input)).answer,
      "No selection can do it: each label could be reached, but not all of them at once, because some pairs "
      "must not be chosen together.");
  s.placement.min_spacing = 2;
  EXPECT_NE(headline(ReportData(s.input)).answer.find("because units must be 2 m apart."), std::string::npos);
}

TEST(Headline, SaysWhatTheBoundRestsOn) {
  Supermarket s;
  s.placement.bound_proof = BoundProof::dual;
  s.placement.ties_settled = false;
  EXPECT_TRUE(any_remark(s.input, "rests on a dual solution, added up again from the matrix."));
  EXPECT_FALSE(any_remark(s.input, "largest smallest margin"));
  EXPECT_TRUE(pieces(report_html(s.input)).contains("a dual solution, added up again from the matrix"));
  EXPECT_TRUE(pieces(report_html(s.input)).contains("not all were compared"));
  s.placement.ties_settled = true;
  EXPECT_TRUE(any_remark(s.input, "largest smallest margin"));
  EXPECT_TRUE(pieces(report_html(s.input)).contains("the one with the largest smallest margin"));
}

TEST(Headline, SaysWhatSurvivesAFailure) {
  Supermarket s;
  const std::string legend = "signals without each label's strongest unit";
  EXPECT_FALSE(pieces(report_html(s.input)).contains(legend));
  s.placement.question.redundant = true;
  EXPECT_TRUE(pieces(report_html(s.input)).contains(legend));
  s.placement = {};
  s.placement.question = {.model = CommunicationModel::non_cooperative, .redundant = true};
  s.placement.status = Status::infeasible;
  s.placement.unreachable = {{0, 1, 0.5}};
  EXPECT_EQ(headline(ReportData(s.input)).answer,
            "No selection can do it: 1 of 926 labels cannot be reached, each by two units at once, of which "
            "one may "
            "fail.");
  EXPECT_NE(report_html(s.input).find("the best single candidate that is left when the strongest fails."),
            std::string::npos);
}

TEST(Headline, AsksWhyALabelGetsNoLight) {
  Supermarket s;
  s.placement = {};
  s.placement.status = Status::infeasible;
  s.placement.unreachable = {{0, 1, 0.5}, {3, 1, 0}};
  const std::string asked = "no light arrives at all: is it inside something, or facing into it?";
  // Some light is there: where one unit may fail, that of one is as good as none.
  EXPECT_FALSE(any_remark(s.input, asked));
  EXPECT_EQ(pieces(report_html(s.input)).count(asked), 0U);
  s.placement.question.redundant = true;
  EXPECT_TRUE(pieces(report_html(s.input))
                  .contains("light arrives from one place only, and the unit there may fail"));
  s.placement.question.redundant = false;
  for (std::size_t j = 0; j < s.matrix.columns(); ++j) s.matrix.mean[s.matrix.at(3, j)] = 0;
  EXPECT_EQ(pieces(report_html(s.input)).count(asked), 1U);
  EXPECT_TRUE(any_remark(s.input, "At one of them " + asked));
  s.placement.unreachable[1].most = 0.1;
  EXPECT_FALSE(any_remark(s.input, asked));
  EXPECT_EQ(report_html(s.input).find("no light"), std::string::npos);
}

}  // namespace
}  // namespace shelfbeam
