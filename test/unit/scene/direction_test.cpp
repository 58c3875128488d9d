#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "shelfbeam/scene/read_values.hpp"

#include "support/expect_input_error.hpp"

namespace shelfbeam {
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
  test::expect_input_error([] { unit_direction({0, -0.0, 0}, "axis"); }, "axis", "zero vector");
  for (const double value : {HUGE_VAL, -HUGE_VAL, std::nan("")})
    test::expect_input_error([=] { unit_direction({1, value, 0}, "axis"); }, "axis", "not finite");
}

}  // namespace
}  // namespace shelfbeam
