#include "shelfbeam/stats/log_histogram.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

TEST(LogHistogram, QuantilesAreGoodToOnePercent) {
  std::vector<double> values;
  LogHistogram all, odd;
  for (int k = 1; k <= 1000; ++k) {
    values.push_back(1e-4 * k * k);
    (k % 2 == 0 ? all : odd).add(values.back());
  }
  all.merge(odd);
  EXPECT_EQ(all.count(), 1000u);
  for (const double p : {0.01, 0.5, 0.9, 0.99, 1.0}) {
    const double exact = values[static_cast<std::size_t>(p * 1000) - 1];
    EXPECT_GE(all.quantile(p), exact * (1 - 1e-12)) << p;
    EXPECT_LE(all.quantile(p), exact * 1.0101) << p;
  }
}

TEST(LogHistogram, CountsZerosAndOutsideValues) {
  LogHistogram histogram;
  EXPECT_EQ(histogram.quantile(0.5), 0);
  for (const double value : {0.0, 0.0, 1e-9, 0.1, 1e9}) histogram.add(value);
  EXPECT_EQ(histogram.quantile(0.6), 0);
  EXPECT_NEAR(histogram.quantile(0.8), 0.1, 1e-3);
  EXPECT_GT(histogram.quantile(1), 900);
}

}  // namespace
}  // namespace shelfbeam
