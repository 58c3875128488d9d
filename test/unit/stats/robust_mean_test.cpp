#include "shelfbeam/stats/robust_mean.hpp"

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

// Normal values about 3 with known errors and an additional spread of 0.7. For 20,000 values the estimates
// have standard errors of 0.007 and 0.01.
TEST(RobustMean, FindsMeanAndSpread) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  std::vector<double> values, errors;
  for (int k = 0; k < 20000; ++k) {
    errors.push_back(k % 2 == 0 ? 0.2 : 1.0);
    values.push_back(3 + std::hypot(errors.back(), 0.7) * normal(engine));
  }
  const RobustMean mean = robust_mean(values, errors);
  EXPECT_NEAR(mean.value, 3, 0.03);
  EXPECT_NEAR(mean.spread, 0.7, 0.04);
  EXPECT_NEAR(std::accumulate(mean.influences.begin(), mean.influences.end(), 0.0), 0, 1e-9);
  double square = 0;
  for (const double influence : mean.influences) square += influence * influence;
  EXPECT_NEAR(std::sqrt(square), 0.0067, 0.0007) << "standard error";
  // Every tenth value is an outlier: the plain mean moves by 2, the robust mean by a few tenths of a standard
  // deviation.
  for (std::size_t k = 0; k < values.size(); k += 10) values[k] += 20;
  EXPECT_NEAR(robust_mean(values, errors).value, 3, 0.25);
}

TEST(RobustMean, SpreadIsZeroIfErrorsExplainIt) {
  const std::vector<double> values{1, 2, 3, 4, 5}, errors(5, 10);
  EXPECT_EQ(robust_mean(values, errors).spread, 0);
  EXPECT_NEAR(robust_mean(values, errors).value, 3, 1e-12);
  const std::vector<double> none(5, 0);
  EXPECT_GT(robust_mean(values, none).spread, 0.5);
  const std::vector<double> alike(5, 7);
  EXPECT_EQ(robust_mean(alike, none).value, 7);
}

TEST(GroupedError, AddsUpWithinGroups) {
  const std::vector<double> influences{1, 1, -1, -1};
  const std::vector<std::uint32_t> alone{0, 1, 2, 3}, halves{0, 0, 1, 1}, one(4, 0);
  EXPECT_NEAR(grouped_error(influences, alone).standard_error, std::sqrt(4.0 * 4 / 3), 1e-12);
  EXPECT_NEAR(grouped_error(influences, halves).standard_error, std::sqrt(8.0 * 2), 1e-12);
  EXPECT_EQ(grouped_error(influences, halves).groups, 2u);
  EXPECT_TRUE(std::isinf(grouped_error(influences, one).standard_error));
}

}  // namespace
}  // namespace shelfbeam
