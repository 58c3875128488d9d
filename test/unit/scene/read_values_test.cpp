#include "shelfbeam/scene/read_values.hpp"

#include "shelfbeam/math/warp.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

TEST(Direction, TakesAnyFiniteVectorButZero) {
  const Vec3 given{-3, 5, 0.25}, usual = unit_direction(given, "axis");
  for (int exponent = -1060; exponent <= 1020; exponent += 20) {
    const double scale = std::ldexp(1.0, exponent);
    EXPECT_EQ(unit_direction(given * scale, "axis"), usual) << exponent;
  }
  EXPECT_FALSE(is_finite(normalized(given * 1e-170))) << "the control";
  const double largest = std::numeric_limits<double>::max(),
               least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(unit_direction({0, 0, -largest}, "axis"), (Vec3{0, 0, -1}));
  EXPECT_EQ(unit_direction({least, 0, 0}, "axis"), (Vec3{1, 0, 0}));
  const Vec3 unit{0.6, 0, 0.8};
  EXPECT_EQ(unit_direction(unit, "axis"), unit);
  expect_input_error([] { unit_direction({0, -0.0, 0}, "axis"); }, "axis", "zero vector");
  for (const double value : {HUGE_VAL, -HUGE_VAL, std::nan("")})
    expect_input_error([=] { unit_direction({1, value, 0}, "axis"); }, "axis", "not finite");
}

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
}  // namespace shelfbeam::test
