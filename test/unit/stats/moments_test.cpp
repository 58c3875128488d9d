#include "shelfbeam/stats/moments.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/stats/distributions.hpp"

namespace shelfbeam {
namespace {

// Tolerances of Moments bound the rounding of a few thousand additions (n * 2^-53 < 1e-12) with a margin
// of 10.

Moments of(const std::vector<double>& values) {
  Moments moments;
  for (const double value : values) moments.add(value);
  return moments;
}

TEST(Moments, OfOneToN) {
  for (const int n : {2, 3, 10, 1000}) {
    Moments moments;
    for (int k = 1; k <= n; ++k) moments.add(k);
    EXPECT_EQ(moments.count(), static_cast<std::uint64_t>(n));
    EXPECT_NEAR(moments.mean(), (n + 1) / 2.0, 1e-11 * n);
    EXPECT_NEAR(moments.variance(), n * (n + 1) / 12.0, 1e-11 * n * n);
    EXPECT_NEAR(moments.standard_error(), std::sqrt((n + 1) / 12.0), 1e-11 * n);
    // Negative control: 1/n instead of 1/(n-1) exceeds the tolerance even for the largest n.
    EXPECT_GT(std::abs(moments.variance() - (n + 1.0) * (n - 1.0) / 12.0), 1e-11 * n * n);
  }
}

TEST(Moments, MergeIsTheUnion) {
  std::mt19937_64 random(3);
  std::lognormal_distribution<double> draw(0, 2);
  std::vector<double> values(5000);
  for (double& value : values) value = draw(random);
  const Moments whole = of(values);
  for (const std::size_t piece : {1, 2, 7, 100, 4999, 5000}) {
    Moments merged;
    for (std::size_t begin = 0; begin < values.size(); begin += piece) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
      merged.merge(of({first, first + static_cast<std::ptrdiff_t>(std::min(piece, values.size() - begin))}));
    }
    EXPECT_EQ(merged.count(), whole.count());
    EXPECT_NEAR(merged.mean() / whole.mean(), 1, 1e-11);
    EXPECT_NEAR(merged.variance() / whole.variance(), 1, 1e-11);
  }
  Moments same = whole;
  same.merge({});
  EXPECT_EQ(same.mean(), whole.mean());
  EXPECT_EQ(same.variance(), whole.variance());
}

TEST(Moments, FarFromZero) {
  // Values 1e9 + {0, 1, 2}: variance 1. Summing squares, as the negative control, loses it entirely.
  Moments moments;
  double sum = 0, squares = 0;
  for (int k = 0; k < 3000; ++k) {
    const double value = 1e9 + k % 3;
    moments.add(value);
    sum += value;
    squares += value * value;
  }
  const double exact = 2000.0 / 2999.0;
  EXPECT_NEAR(moments.variance(), exact, 1e-6);  // the mean's own rounding, 1e9 * 2^-53, per addition
  EXPECT_GT(std::abs((squares - sum * sum / 3000) / 2999 - exact), 1e-6);
}

TEST(Moments, OfLessThanTwoValues) {
  Moments moments;
  EXPECT_EQ(moments.mean(), 0);
  EXPECT_TRUE(std::isinf(moments.standard_error()));
  moments.add(4);
  EXPECT_EQ(moments.mean(), 4);
  EXPECT_TRUE(std::isinf(moments.variance()));
  moments.add(4);
  EXPECT_EQ(moments.standard_error(), 0);
}

double uniform(std::uint32_t seed, std::uint32_t k, std::uint32_t which = 0) {
  return to_uniform(philox({k, which, 0, 0}, seed)[0]);
}

TEST(PowerSums, AgreeWithUpdatedMoments) {
  PowerSums sums;
  SkewedMoments moments;
  for (std::uint32_t k = 0; k < 100; ++k) {
    const double value = -std::log(1 - uniform(1, k)) + 3;
    sums.add(value);
    moments.add(value);
  }
  EXPECT_NEAR(sums.mean(), moments.mean(), 1e-12);
  EXPECT_NEAR(sums.standard_error(), moments.standard_error(), 1e-12);
  EXPECT_NEAR(sums.skewness(), moments.skewness(), 1e-9);
}

TEST(PowerSums, IgnoreRoundingErrors) {
  PowerSums equal, close;
  for (std::uint32_t k = 0; k < 64; ++k) {
    equal.add(0.1);
    close.add(1 + 1e-6 * (k == 0 ? 1 : 0));
  }
  EXPECT_EQ(equal.standard_error(), 0);
  EXPECT_FALSE(equal.is_skewed());
  EXPECT_GT(close.standard_error(), 0);
  EXPECT_FALSE(close.is_skewed());
}

// The number of Student's 95 % intervals that contain the truth, and of flagged ones.
struct Coverage {
  double all = 0, unflagged = 0, flagged = 0;
};

template <class Draw>
Coverage coverage(std::uint32_t n, double truth, const Draw& draw) {
  constexpr std::uint32_t runs = 20000;
  Coverage found;
  double kept = 0;
  for (std::uint32_t run = 0; run < runs; ++run) {
    PowerSums sums;
    for (std::uint32_t k = 0; k < n; ++k) sums.add(draw(run, k));
    const bool holds =
        std::abs(sums.mean() - truth) <= student_quantile(0.975, n - 1.0) * sums.standard_error();
    found.all += holds ? 1.0 / runs : 0;
    if (sums.is_skewed()) {
      found.flagged += 1.0 / runs;
    } else {
      kept += 1;
      found.unflagged += holds ? 1 : 0;
    }
  }
  found.unflagged /= kept;
  return found;
}

// Normal values are not flagged, and neither are 77 exponential values, whose intervals are correct. For
// values that are 1 with probability 1/77, the intervals contain the truth in 63 % of the cases: all runs
// with one or two such values are flagged (runs without any have no error). 20,000 runs: shares are known to
// 0.4 %.
TEST(PowerSums, FlagErrorsThatRestOnFewValues) {
  const auto normal = [](std::uint32_t run, std::uint32_t k) {
    return std::sqrt(-2 * std::log(1 - uniform(run, k))) * std::cos(2 * pi * uniform(run, k, 1));
  };
  const auto exponential = [](std::uint32_t run, std::uint32_t k) { return -std::log(1 - uniform(run, k)); };
  const auto rare = [](std::uint32_t run, std::uint32_t k) { return uniform(run, k) < 1.0 / 77 ? 1.0 : 0; };
  EXPECT_LT(coverage(16, 0, normal).flagged, 0.01);
  EXPECT_LT(coverage(77, 0, normal).flagged, 0.001);
  const Coverage skewed = coverage(77, 1, exponential);
  EXPECT_GT(skewed.unflagged, 0.935);
  EXPECT_LT(skewed.flagged, 0.15);
  const Coverage seldom = coverage(77, 1.0 / 77, rare);
  EXPECT_LT(seldom.all, 0.7);
  EXPECT_GT(seldom.flagged, 0.5);
}

}  // namespace
}  // namespace shelfbeam
