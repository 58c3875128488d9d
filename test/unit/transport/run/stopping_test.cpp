#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/transport/run/error_survey.hpp"

namespace shelfbeam {
namespace {

TEST(Stopping, TestsAfterSixteenBatchesAndThenEverySixteenthMore) {
  std::vector<std::uint32_t> points;
  for (std::uint32_t b = 0; b <= 100000; ++b)
    if (is_stopping_point(b)) points.push_back(b);
  ASSERT_GT(points.size(), 40u);
  EXPECT_EQ(points[0], 16u);
  EXPECT_EQ(points[1], 17u);
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double growth = static_cast<double>(points[k]) / points[k - 1];
    EXPECT_LE(growth, 1.0 + 1.0 / 16);
    EXPECT_GT(growth, 1.0 + 1.0 / 32.1);
  }
  EXPECT_FALSE(is_stopping_point(0));
  EXPECT_FALSE(is_stopping_point(15));
  EXPECT_FALSE(is_stopping_point(33));
}

// The precision of a row without flagged entries.
Precision count(const std::vector<double>& means, const std::vector<double>& errors, double requirement,
                const RelativeError& wanted) {
  return count_precise(means, errors, std::vector<std::uint8_t>(means.size()), requirement, wanted);
}

TEST(Stopping, CountsEntriesThatMatterAndArePrecise) {
  const RelativeError wanted{0.1, 0.5};
  // Above 0.5 of the requirement 2: 1.01, 4, 8. Among these 0.101 and 0.8 are at most 10 %.
  const std::vector<double> means{0, 0.5, 1, 1.01, 4, 8}, errors{0, 0.5, 0.9, 0.101, 0.41, 0.8};
  const Precision found = count(means, errors, 2, wanted);
  EXPECT_EQ(found.relevant, 3u);
  EXPECT_EQ(found.precise, 2u);
  EXPECT_FALSE(found.is_enough());
  EXPECT_EQ(count(means, errors, 2, {0.1025, 0.5}).precise, 3u);
  EXPECT_EQ(count(means, errors, 2, {0.1, 0.1}).relevant, 5u);
  // Without a requirement: above half of the largest.
  EXPECT_EQ(count(means, errors, 0, wanted).relevant, 1u);
  EXPECT_EQ(count(means, errors, 0, {0.1, 0.49}).relevant, 2u);
}

TEST(Stopping, ZeroErrorIsPreciseAndNaNIsNot) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(count({1.0}, {0.0}, 1, {1e-9, 0.3}).precise, 1u);
  EXPECT_EQ(count({1.0}, {none}, 1, {0.5, 0.3}).precise, 0u);
  EXPECT_EQ(count({0.0, 0.0}, {0.0, 0.0}, 0, {0.1, 0.3}).relevant, 0u);
  EXPECT_EQ(count({}, {}, 0, {0.1, 0.3}).relevant, 0u);
}

TEST(Stopping, DoesNotTrustFlaggedErrors) {
  const std::vector<double> means{1, 2}, errors{0.01, 0.01};
  const Precision found = count_precise(means, errors, std::vector<std::uint8_t>{0, 1}, 1, {0.1, 0.3});
  EXPECT_EQ(found.relevant, 2u);
  EXPECT_EQ(found.precise, 1u);
}

TEST(Stopping, KnowsErrorsThatMoreSamplesCannotReach) {
  // The target is 10 %, and more samples can reduce twice that.
  const std::vector<double> means{1, 1, 1}, errors{0.1, 0.2, 0.21};
  const Precision found = count_precise(means, errors, std::vector<std::uint8_t>(3), 1, {0.1, 0.3}, {2});
  EXPECT_EQ(found.precise, 1u);
  EXPECT_EQ(found.unreachable, 1u);
  EXPECT_FALSE(found.is_decided());
  EXPECT_TRUE((Precision{3, 2, 1}).is_decided());
  EXPECT_FALSE((Precision{100, 0, 1}).is_hopeless());
  EXPECT_TRUE((Precision{100, 0, 2}).is_hopeless());
}

// Four times the samples halve an error, which is known to 5 % from 201 batches.
TEST(Stopping, AllowsForTheErrorOfErrors) {
  EXPECT_DOUBLE_EQ(reachable_error(201, 4), 2 * 1.15);
  EXPECT_DOUBLE_EQ(reachable_error(201, 1), 1.15);
}

TEST(Stopping, RequiresNinetyNinePercent) {
  EXPECT_TRUE((Precision{100, 99}).is_enough());
  EXPECT_FALSE((Precision{100, 98}).is_enough());
  EXPECT_FALSE((Precision{99, 98}).is_enough());
  EXPECT_TRUE((Precision{0, 0}).is_enough());
  // If all parts have enough samples, the whole has, too.
  Precision whole;
  for (std::uint64_t n = 1; n < 300; ++n) whole += {n, (99 * n + 99) / 100};
  EXPECT_TRUE(whole.is_enough());
}

}  // namespace
}  // namespace shelfbeam
