#include "shelfbeam/material/optics/fresnel.hpp"

#include "shelfbeam/math/warp.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

// Rounding of a few operations on numbers of order one.
constexpr double rounding = 1e-12;

TEST(Fresnel, OfADielectricHasItsKnownValues) {
  for (const double n : {1.0, 1.33, 1.5, 2.4, 1 / 1.5}) {
    const double normal = (n - 1) / (n + 1);
    EXPECT_NEAR(fresnel_dielectric(1, n), normal * normal, rounding);
    // At Brewster's angle, tan = n, no p light is reflected, and half of R_s remains.
    const double r_s = (n * n - 1) / (n * n + 1), brewster = std::cos(std::atan(n));
    EXPECT_NEAR(fresnel_dielectric(brewster, n), r_s * r_s / 2, rounding);
    if (n > 1) {
      EXPECT_GT(std::abs(fresnel_dielectric(brewster + 0.1, n) - r_s * r_s / 2), 1e-4);  // control
      EXPECT_NEAR(fresnel_dielectric(0, n), 1, rounding);
    }
  }
  // 45 degrees on glass, computed by hand from Snell's law: sin_t = 0.4714, R_s = 0.09201, R_p = R_s^2.
  const double r_s = 0.0920134, by_hand = (r_s + r_s * r_s) / 2;
  EXPECT_NEAR(fresnel_dielectric(std::sqrt(0.5), 1.5), by_hand, 1e-6);
}

TEST(Fresnel, ReflectsTotallyBeyondTheCriticalAngle) {
  const double critical = std::asin(1 / 1.5);
  EXPECT_EQ(fresnel_dielectric(std::cos(critical + 1e-6), 1 / 1.5), 1);
  EXPECT_EQ(fresnel_dielectric(0.1, 1 / 1.5), 1);
  EXPECT_LT(fresnel_dielectric(std::cos(critical - 1e-6), 1 / 1.5), 1);
}

TEST(Fresnel, IsTheSameFromBothSidesOfARefractedRay) {
  for (int k = 1; k <= 20; ++k) {
    const double cos_i = 0.05 * k;
    const double cos_t = std::sqrt(1 - (1 - cos_i * cos_i) / (1.5 * 1.5));
    EXPECT_NEAR(fresnel_dielectric(cos_i, 1.5), fresnel_dielectric(cos_t, 1 / 1.5), rounding);
  }
}

// The real form of the equations (Born and Wolf), without complex numbers.
double conductor_by_hand(double cos_i, double eta, double k) {
  const double c2 = cos_i * cos_i, s2 = 1 - c2, t = eta * eta - k * k - s2;
  const double both = std::sqrt(t * t + 4 * eta * eta * k * k), a = std::sqrt((both + t) / 2);
  const double r_s = (both + c2 - 2 * a * cos_i) / (both + c2 + 2 * a * cos_i);
  const double r_p =
      r_s * (c2 * both + s2 * s2 - 2 * a * cos_i * s2) / (c2 * both + s2 * s2 + 2 * a * cos_i * s2);
  return (r_s + r_p) / 2;
}

struct Metal {
  double eta, k, normal;
};

// At 940 nm, interpolated in the tables named in data/materials_940nm.json. The reflectance at normal
// incidence is ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2), computed separately to five digits.
TEST(Fresnel, OfMetalsIsThatOfIndependentArithmetic) {
  for (const Metal& m : {Metal{0.196, 6.021, 0.97920}, Metal{1.674, 8.608, 0.91758},
                         Metal{2.939, 3.680, 0.59543}, Metal{3.357, 3.546, 0.57449}}) {
    EXPECT_NEAR(fresnel_conductor(1, m.eta, m.k), m.normal, 1e-5);
    for (int percent = 0; percent <= 100; ++percent) {
      const double cos_i = 0.01 * percent;
      EXPECT_NEAR(fresnel_conductor(cos_i, m.eta, m.k), conductor_by_hand(cos_i, m.eta, m.k), 1e-9);
      if (cos_i > 0.05 && cos_i < 0.95) {
        EXPECT_GT(
            std::abs(fresnel_conductor(cos_i, m.eta, m.k) - conductor_by_hand(cos_i, m.eta, 1.02 * m.k)),
            1e-6);  // control
      }
    }
  }
}

TEST(Fresnel, OfAConductorWithoutAbsorptionIsThatOfADielectric) {
  for (int k = 0; k <= 20; ++k) {
    const double cos_i = 0.05 * k;
    EXPECT_NEAR(fresnel_conductor(cos_i, 1.5, 0), fresnel_dielectric(cos_i, 1.5), rounding);
    EXPECT_NEAR(fresnel_conductor(cos_i, 0, 1), 1, rounding);
  }
}

}  // namespace
}  // namespace shelfbeam::test
