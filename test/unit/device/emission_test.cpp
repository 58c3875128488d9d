#include "shelfbeam/device/emission.hpp"

#include "shelfbeam/math/warp.hpp"

#include "support/testing.hpp"
#include "unit/device/profiles.hpp"

namespace shelfbeam::test {
namespace {

TEST(Emission, SinTwoThetaPeaksAt45DegreesWithTheFluxOfThePaper) {
  const Emission profile = SinTwoTheta{1.5};
  EXPECT_DOUBLE_EQ(intensity(profile, normalized({1, 0, 1})), 1.5);
  EXPECT_NEAR(intensity(profile, {std::sin(0.3), 0, std::cos(0.3)}), 1.5 * std::sin(0.6), 1e-15);
  EXPECT_DOUBLE_EQ(power(profile), 4 * pi / 3 * 1.5);
  EXPECT_EQ(intensity(profile, {0, 0, 1}), 0);
}

// The paper's sampling formulas of 2.9: theta = arcsin cbrt(u1), phi = 2 pi u2, density 3 sin(2 theta) / (4
// pi).
TEST(Emission, SinTwoThetaIsSampledByTheFormulasOfThePaper) {
  const auto drawn = sample(SinTwoTheta{2}, 0.3, 0.4);
  ASSERT_TRUE(drawn);
  const double theta = std::asin(std::cbrt(0.3));
  EXPECT_NEAR(std::acos(drawn->direction.z), theta, 1e-14);
  EXPECT_NEAR(std::atan2(drawn->direction.y, drawn->direction.x), 2 * pi * 0.4, 1e-14);
  EXPECT_NEAR(drawn->pdf, 3 * std::sin(2 * theta) / (4 * pi), 1e-14);
  EXPECT_FALSE(sample(SinTwoTheta{2}, 0, 0.4));  // on the axis, in which nothing is emitted
}

// Near the axis the sine must not be computed from the rounded cosine: at order 1e8 it would keep 4 digits.
TEST(Emission, NarrowLobesKeepTheirDigits) {
  const double order = 1e8, u = 0.5;
  const auto drawn = sample(GeneralizedLambertian{order, 1}, u, 0);
  ASSERT_TRUE(drawn);
  const double exponent = std::log(u) / (order + 1);
  EXPECT_NEAR(drawn->direction.x / std::sqrt(-2 * exponent - 2 * exponent * exponent), 1, 1e-12);
}

TEST(Emission, NothingLeavesBackwards) {
  const std::vector<Emission> downward{SinTwoTheta{1.5}, IsotropicHemisphere{0.3},
                                       GeneralizedLambertian{7.05, 0.1}, EmissionTable{axial_table()},
                                       EmissionTable{lopsided_table()}};
  for (const Emission& profile : downward) EXPECT_EQ(intensity(profile, normalized({0.3, 0.2, -1})), 0);
  // A table may emit backwards.
  EXPECT_GT(intensity(EmissionTable{axial_table()}, {std::sin(radians(93)), 0, std::cos(radians(93))}), 0);
}

// Compares with the mean of 100,000 azimuths, which differs from a linear interpolation between planes by
// less than 1e-8.
TEST(Emission, MeanIntensityIsTheAverageOverPhi) {
  for (const Emission& profile : {Emission(SinTwoTheta{1.5}), Emission(GeneralizedLambertian{7.05, 0.1}),
                                  Emission(IsotropicHemisphere{0.3}), Emission(EmissionTable{axial_table()}),
                                  Emission(EmissionTable{lopsided_table()})})
    for (const double theta : {1e-9, 0.2, 1.0, 1.5, 3.0}) {  // on the axis a direction has no phi
      double sum = 0;
      constexpr int azimuths = 100'000;
      for (int k = 0; k < azimuths; ++k) {
        const double phi = 2 * pi * (k + 0.5) / azimuths;
        sum += intensity(profile,
                         {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
      }
      EXPECT_NEAR(mean_intensity(profile, theta), sum / azimuths, 1e-8) << theta;
    }
  // Control: the planes differ by far more.
  const Emission lopsided = EmissionTable{lopsided_table()};
  EXPECT_GT(std::abs(intensity(lopsided, {std::sin(1.0), 0, std::cos(1.0)}) - mean_intensity(lopsided, 1)),
            1e-3);
}

TEST(Emission, TablesInterpolateBetweenTheirPoints) {
  const auto at = [](double theta_deg, double phi_deg) {
    const double t = radians(theta_deg), p = radians(phi_deg);
    return Vec3{std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
  };
  const Emission axial = EmissionTable{axial_table()}, lopsided = EmissionTable{lopsided_table()};
  EXPECT_NEAR(intensity(axial, at(15, 77)), 2.5, 1e-12);
  EXPECT_NEAR(intensity(axial, at(60, 200)), 1, 1e-12);
  EXPECT_NEAR(intensity(lopsided, at(45, 0)), 2, 1e-12);
  EXPECT_NEAR(intensity(lopsided, at(45, 45)), 2.5, 1e-12);
  EXPECT_NEAR(intensity(lopsided, at(45, 315)), 1.5, 1e-12);
  EXPECT_NEAR(intensity(lopsided, at(67.5, 270)), 1, 1e-12);
}

}  // namespace
}  // namespace shelfbeam::test
