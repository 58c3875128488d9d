#include "shelfbeam/report/messages/recommendation.hpp"

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "unit/report/supermarket_report.hpp"

namespace shelfbeam {
namespace {

using test::Supermarket;

// The weakest label has `ratio` times its requirement, all others twice that.
std::string advice(Supermarket& s, double ratio, std::optional<double> one_more) {
  const Outcome outcome = outcome_of(s.matrix, s.placement);
  for (std::size_t i = 0; i < s.matrix.rows(); ++i)
    s.matrix.labels[i].requirement = outcome.labels[i].signal / (i == 0 ? ratio : 2 * ratio);
  s.plan.alternatives = {};
  if (one_more) {
    Alternative& more = s.plan.alternatives.one_more.emplace();
    more.selected.resize(s.placement.count() + 1);
    more.smallest_margin = *one_more;
  }
  return recommendation(ReportData(s.input));
}

TEST(Recommendation, IsThisPlanOrOneUnitMore) {
  Supermarket s;
  EXPECT_TRUE(
      advice(s, 1.4, 2.0).starts_with("Recommended: this plan. Its weakest label receives 1.40 times"));
  EXPECT_NE(advice(s, 1.4, 2.0).find("ample"), std::string::npos);
  EXPECT_TRUE(advice(s, 1.3, 2.0).starts_with("Recommended: one unit more"))
      << "the weakest label cannot lose a quarter of its signal";
  EXPECT_TRUE(advice(s, 1.05, 1.4).starts_with("Recommended: one unit more"));
  EXPECT_NE(advice(s, 1.05, 1.4).find("from 1.05 to 1.40 times"), std::string::npos);
  EXPECT_NE(advice(s, 1.05, 1.1).find("would only raise that to 1.10 times"), std::string::npos);
  EXPECT_NE(advice(s, 1.05, {}).find("Recommended: this plan"), std::string::npos);
  EXPECT_EQ(advice(s, 0.9, 1.4), "") << "labels are missed";
  Certificate& certificate = s.plan.certificate.emplace();
  certificate.labels.resize(s.matrix.rows());
  for (auto& label : certificate.labels) label.verdict = Verdict::reached;
  EXPECT_NE(advice(s, 1.4, 2.0), "");
  certificate.labels.back().verdict = Verdict::undecided;
  EXPECT_EQ(advice(s, 1.4, 2.0), "") << "the second simulation leaves a label open";
}

}  // namespace
}  // namespace shelfbeam
