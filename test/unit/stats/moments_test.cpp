#include "shelfbeam/stats/moments.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

// Tolerances here bound the rounding of a few thousand additions (n * 2^-53 < 1e-12) with a margin of 10.

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
    // Negative control: 1/n instead of 1/(n-1) is out of the tolerance even for the largest n.
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

}  // namespace
}  // namespace shelfbeam
