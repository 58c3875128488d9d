#include "shelfbeam/stats/histogram.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(Histogram, CountsEveryValueOnce) {
  Histogram histogram(-1, 1, 4);
  for (const double value : {-1.0, -0.75, -0.5, -0.25, 0.0, 0.49, 0.5, 0.999, 1.0}) histogram.add(value);
  EXPECT_EQ(histogram.counts(), (std::vector<std::uint64_t>{2, 2, 2, 3}));
  for (const double value : {-1.0001, -infinite, 1.0001, infinite, std::nan("")}) histogram.add(value);
  EXPECT_EQ(histogram.below(), 2u);
  EXPECT_EQ(histogram.above(), 3u);
  EXPECT_EQ(histogram.counts(), (std::vector<std::uint64_t>{2, 2, 2, 3}));
}

TEST(Histogram, Edges) {
  const Histogram histogram(0, 0.7, 7);
  EXPECT_EQ(histogram.edge(0), 0);
  EXPECT_DOUBLE_EQ(histogram.edge(3), 0.3);
  EXPECT_EQ(histogram.edge(7), 0.7);
}

TEST(Histogram, ValuesNextToTheUpperEndStayInside) {
  Histogram histogram(0.1, 0.7, 3);
  histogram.add(std::nextafter(0.7, 0));
  histogram.add(0.7);
  EXPECT_EQ(histogram.counts()[2], 2u);
}

TEST(Histogram, RefusesEmptyRanges) {
  EXPECT_THROW(Histogram(1, 1, 3), std::invalid_argument);
  EXPECT_THROW(Histogram(0, 1, 0), std::invalid_argument);
  EXPECT_THROW(Histogram(0, infinite, 3), std::invalid_argument);
}

}  // namespace
}  // namespace shelfbeam
