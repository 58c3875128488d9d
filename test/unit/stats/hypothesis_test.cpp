#include "support/hypothesis.hpp"

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/stats/distributions.hpp"
#include "shelfbeam/stats/moments.hpp"

namespace shelfbeam {
namespace {

// The number of failures of a test is binomial. With N runs at level p it is within 4.5 standard deviations,
// sqrt(N p (1 - p)), of N p for all but 7e-6 of the seeds; the seeds here are fixed.
bool is_binomial(int failures, int runs, double p) {
  return std::abs(failures - runs * p) <= 4.5 * std::sqrt(runs * p * (1 - p));
}

int z_failures(std::size_t values, double level, double shift) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const std::vector<double> references(values, 3.0), errors(values, 0.5);
  int failures = 0;
  for (int run = 0; run < 4000; ++run) {
    std::vector<double> drawn(values);
    for (double& value : drawn) value = 3.0 + 0.5 * normal(random);
    drawn[0] += 0.5 * shift;
    failures += z_test(drawn, references, errors, level).pass ? 0 : 1;
  }
  return failures;
}

TEST(ZTest, FailsAtItsLevelHoweverManyValues) {
  for (const std::size_t values : {1, 10, 100}) {
    EXPECT_TRUE(is_binomial(z_failures(values, 0.1, 0), 4000, 0.1)) << values;
  }
  // Negative controls: the check of the rate rejects another level, and the test rejects one wrong value.
  EXPECT_FALSE(is_binomial(z_failures(10, 0.13, 0), 4000, 0.1));
  EXPECT_GT(z_failures(100, 0.1, 7), 3900);
}

TEST(ZTest, StudentLimitForErrorsFromFewBatches) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  constexpr std::size_t entries = 20;
  const std::vector<double> references(entries, 0.0);
  int student = 0, as_if_known = 0;
  for (int run = 0; run < 4000; ++run) {
    std::vector<double> values, errors;
    for (std::size_t i = 0; i < entries; ++i) {
      Moments batches;
      for (int b = 0; b < 8; ++b) batches.add(normal(random));
      values.push_back(batches.mean());
      errors.push_back(batches.standard_error());
    }
    student += z_test(values, references, errors, 0.1, 7).pass ? 0 : 1;
    as_if_known += z_test(values, references, errors, 0.1).pass ? 0 : 1;
  }
  EXPECT_TRUE(is_binomial(student, 4000, 0.1)) << student;
  EXPECT_FALSE(is_binomial(as_if_known, 4000, 0.1)) << "negative control: the normal limit is too small here";
}

TEST(ZTest, ReportsTheWorstValueAndTheLimit) {
  const std::array<double, 3> values = {1.0, 2.5, 3.0}, references = {1.0, 2.0, 2.9},
                              errors = {0.0, 0.25, 0.1};
  const ZTest test = z_test(values, references, errors, 0.05);
  EXPECT_DOUBLE_EQ(test.largest, 2);
  EXPECT_EQ(test.worst, 1u);
  EXPECT_DOUBLE_EQ(test.limit, -normal_quantile(sidak_level(0.05, 3) / 2));
  EXPECT_TRUE(test.pass);
}

TEST(ZTest, MissingScoreFails) {
  const double nan = std::nan("");
  const auto passes = [](double value, double reference, double error) {
    return z_test(std::array{value}, std::array{reference}, std::array{error}, 0.05).pass;
  };
  EXPECT_TRUE(passes(1, 1, 0));
  EXPECT_FALSE(passes(1, 1 + 1e-15, 0));
  EXPECT_FALSE(passes(nan, 1, 1));
  EXPECT_FALSE(passes(1, nan, 1));
  EXPECT_FALSE(passes(1, 1, nan));
  EXPECT_FALSE(passes(1, 2, -1e9));
  EXPECT_THROW(z_test({}, {}, {}, 0.05), std::invalid_argument);
  const std::array<double, 2> two = {1, 1};
  EXPECT_THROW(z_test(two, two, std::array{1.0}, 0.05), std::invalid_argument);
}

int chi_square_failures(const std::vector<double>& drawn, const std::vector<double>& claimed) {
  std::mt19937_64 random(17);
  std::discrete_distribution<std::size_t> draw(drawn.begin(), drawn.end());
  std::vector<double> expected = claimed;
  for (double& cell : expected) cell *= 1000;
  int failures = 0;
  for (int run = 0; run < 2000; ++run) {
    std::vector<double> counts(drawn.size(), 0.0);
    for (int k = 0; k < 1000; ++k) counts[draw(random)] += 1;
    failures += chi_square_test(counts, expected, 0.1).pass ? 0 : 1;
  }
  return failures;
}

TEST(ChiSquareTest, FailsAtItsLevel) {
  const std::vector<double> even(20, 0.05);
  EXPECT_TRUE(is_binomial(chi_square_failures(even, even), 2000, 0.1));
  // Many cells that expect 1 to 4 of 1000: pooling keeps the level.
  std::vector<double> skewed(100, 0.04);
  for (std::size_t k = 0; k < 80; ++k) skewed[k] = 0.001 + 0.003 * static_cast<double>(k) / 79;
  double sum = 0;
  for (const double p : skewed) sum += p;
  for (double& p : skewed) p /= sum;
  EXPECT_TRUE(is_binomial(chi_square_failures(skewed, skewed), 2000, 0.1));
  // Negative control: probabilities off by a quarter in half of the cells.
  std::vector<double> off = even;
  for (std::size_t k = 0; k < off.size(); ++k) off[k] *= k < 10 ? 1.25 : 0.75;
  EXPECT_GT(chi_square_failures(off, even), 1900);
}

TEST(ChiSquareTest, PoolsTheSmallestCellsFirst) {
  // 1 + 4 are pooled to 5, and 3 cells remain: (7-5)^2/5 + (8-10)^2/10 + (19-20)^2/20 + (31-30)^2/30.
  const std::array<double, 5> counts = {31, 3, 8, 19, 4}, expected = {30, 1, 10, 20, 4};
  const ChiSquareTest test = chi_square_test(counts, expected, 0.05, 3);
  EXPECT_DOUBLE_EQ(test.statistic, 4 / 5.0 + 4 / 10.0 + 1 / 20.0 + 1 / 30.0);
  EXPECT_EQ(test.degrees_of_freedom, 3);
  EXPECT_DOUBLE_EQ(test.p_value, chi_square_upper_tail(test.statistic, 3));
  EXPECT_DOUBLE_EQ(test.level, sidak_level(0.05, 3));
  EXPECT_TRUE(test.pass);
}

TEST(ChiSquareTest, ImpossibleCountsAndUselessTests) {
  const std::array<double, 3> expected = {0, 50, 50};
  EXPECT_TRUE(chi_square_test(std::array{0.0, 50.0, 50.0}, expected, 0.05).pass);
  EXPECT_FALSE(chi_square_test(std::array{1.0, 50.0, 50.0}, expected, 0.05).pass);
  EXPECT_THROW(chi_square_test(std::array{2.0, 3.0}, std::array{2.0, 2.0}, 0.05), std::invalid_argument);
  EXPECT_THROW(chi_square_test(std::array{9.0, 9.0}, std::array{18.0, -1.0}, 0.05), std::invalid_argument);
  EXPECT_THROW(chi_square_test(std::array{9.0, 9.0}, std::array{18.0, std::nan("")}, 0.05),
               std::invalid_argument);
  EXPECT_THROW(chi_square_test(std::array{9.0}, expected, 0.05), std::invalid_argument);
}

}  // namespace
}  // namespace shelfbeam
