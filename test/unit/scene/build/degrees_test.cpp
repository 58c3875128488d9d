#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/read_values.hpp"

namespace shelfbeam {
namespace {

// Exact, without tolerance: random angles over the range and over all magnitudes, and their neighbours.
TEST(Degrees, EveryAngleFromDegreesComesBackToTheBit) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 360), exponent(-320, 2.5);
  int missed_by_division = 0;
  for (int k = 0; k < 20000; ++k) {
    const double given = k % 2 == 0 ? share(random) : std::pow(10, exponent(random));
    for (const double degrees : {given, std::nextafter(given, 0), std::nextafter(given, 400)}) {
      const double angle = radians(degrees);
      ASSERT_EQ(radians(degrees_of(angle)), angle) << degrees;
      missed_by_division += radians(angle * 180 / pi) != angle ? 1 : 0;
    }
  }
  EXPECT_GT(missed_by_division, 1000) << "the control: plain division does not do it";
}

TEST(Degrees, RoundAnglesStayRound) {
  for (const double degrees : {0.0, 0.1, 22.5, 45.0, 60.0, 89.0, 90.0, 110.0, 180.0, 359.999, 360.0})
    EXPECT_EQ(degrees_of(radians(degrees)), degrees);
  EXPECT_EQ(degrees_of(2 * pi), 360);
  EXPECT_EQ(degrees_of(pi / 2), 90);
  EXPECT_EQ(radians(360), 2 * pi) << "the plane that closes a table is the one the resolved store writes";
}

}  // namespace
}  // namespace shelfbeam
