#include "shelfbeam/device/emission.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {
namespace {

// Midpoint rule over the sphere with equal steps in theta and phi.
double integrated_power(const Emission& emission, int thetas = 2000, int phis = 360) {
  double flux = 0;
  for (int t = 0; t < thetas; ++t) {
    const double theta = (t + 0.5) * pi / thetas;
    double ring = 0;
    for (int p = 0; p < phis; ++p) {
      const double phi = (p + 0.5) * 2 * pi / phis;
      ring += intensity(emission,
                        {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
    flux += ring * std::sin(theta);
  }
  return flux * (pi / thetas) * (2 * pi / phis);
}

EmissionTable symmetric_table() {
  return {{0, radians(30), radians(60), radians(95)}, {0}, {2, 3, 1, 0.5}};
}

EmissionTable lopsided_table() {
  return {{0, radians(45), radians(90)},
          {0, radians(90), radians(180), radians(270), 2 * pi},
          {1, 2, 0, 1, 3, 0, 1, 0.5, 0, 1, 1, 1, 1, 2, 0}};
}

const std::vector<Emission> profiles{SinTwoTheta{1.5},
                                     IsotropicHemisphere{0.3},
                                     GeneralizedLambertian{1, 2},
                                     GeneralizedLambertian{7.05, 0.1},
                                     symmetric_table(),
                                     lopsided_table()};

// The midpoint rule is good to 2e-5 here: 5e-4 is demanded at the kink of tables and at 90 degrees. A profile
// whose flux is 0.2 % off fails.
TEST(Emission, PowerIsTheIntegralOfIntensity) {
  for (const Emission& profile : profiles) {
    const double integral = integrated_power(profile);
    EXPECT_NEAR(power(profile) / integral, 1, 5e-4) << type_name(profile);
    EXPECT_GT(std::abs(power(profile) * 1.002 / integral - 1), 5e-4) << type_name(profile);
  }
}

TEST(Emission, SinTwoThetaPeaksAt45DegreesWithTheFluxOfThePaper) {
  const Emission profile = SinTwoTheta{1.5};
  EXPECT_DOUBLE_EQ(intensity(profile, normalized({1, 0, 1})), 1.5);
  EXPECT_NEAR(intensity(profile, {std::sin(0.3), 0, std::cos(0.3)}), 1.5 * std::sin(0.6), 1e-15);
  EXPECT_DOUBLE_EQ(power(profile), 4 * pi / 3 * 1.5);
  EXPECT_EQ(intensity(profile, {0, 0, 1}), 0);
}

TEST(Emission, NothingLeavesBackwards) {
  for (const Emission& profile : profiles) EXPECT_EQ(intensity(profile, normalized({0.3, 0.2, -1})), 0);
  // ... unless a table says so.
  EXPECT_GT(intensity(symmetric_table(), {std::sin(radians(93)), 0, std::cos(radians(93))}), 0);
}

TEST(Emission, TablesInterpolateBetweenTheirPoints) {
  const auto at = [](double theta_deg, double phi_deg) {
    const double t = radians(theta_deg), p = radians(phi_deg);
    return Vec3{std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
  };
  EXPECT_NEAR(intensity(symmetric_table(), at(15, 77)), 2.5, 1e-12);
  EXPECT_NEAR(intensity(symmetric_table(), at(60, 200)), 1, 1e-12);
  EXPECT_NEAR(intensity(lopsided_table(), at(45, 0)), 2, 1e-12);
  EXPECT_NEAR(intensity(lopsided_table(), at(45, 45)), 2.5, 1e-12);
  EXPECT_NEAR(intensity(lopsided_table(), at(45, 315)), 1.5, 1e-12);
  EXPECT_NEAR(intensity(lopsided_table(), at(67.5, 270)), 1, 1e-12);
}

}  // namespace
}  // namespace shelfbeam
