#include "shelfbeam/material/plastic.hpp"

#include "shelfbeam/material/optics/fresnel.hpp"

#include "support/testing.hpp"
#include "unit/material/cases.hpp"

namespace shelfbeam::test {
namespace {

// 2 integral of f(mu) mu dmu by midpoints; the error is below 1e-6 for the functions here.
template <class Function>
double cosine_mean(const Function& f) {
  constexpr int points = 20000;
  double sum = 0;
  for (int k = 0; k < points; ++k) {
    const double mu = (k + 0.5) / points;
    sum += 2 * mu * f(mu) / points;
  }
  return sum;
}

// The program derives internal reflection from the outside by the equality of etendue; this test integrates
// it from the inside. 0.5963 is the textbook value for glass.
TEST(Plastic, InternalReflectionIsThatOfTheInside) {
  for (const double n : {1.1, 1.5, 2.0}) {
    const double inside = cosine_mean([&](double mu) { return fresnel_dielectric(mu, 1 / n); });
    const double rho = 0.5, expected = rho * (1 - inside) / (1 - rho * inside);
    EXPECT_NEAR(make_plastic(n, rho).base_albedo, expected, 2e-6);
    EXPECT_GT(std::abs(make_plastic(n, rho * 1.001).base_albedo - expected), 2e-6);  // control
    if (n == 1.5) {
      EXPECT_NEAR(inside, 0.5963, 1e-4);
    }
  }
}

// The interreflections between base and smooth coat, summed bounce by bounce.
TEST(Plastic, SmoothCoatIsTheSumOfItsInterreflections) {
  constexpr double n = 1.5, rho = 0.8;
  const Plastic plastic = make_plastic(n, rho);
  const double inside = cosine_mean([&](double mu) { return fresnel_dielectric(mu, 1 / n); });
  const Vec3 o = direction_at(20), i = direction_at(70, 3);
  double radiosity = 0, arriving = 1 - fresnel_dielectric(i.z, n);
  for (int bounce = 0; bounce < 200; ++bounce) {
    radiosity += arriving * rho;
    arriving *= rho * inside;
  }
  // Radiosity / pi in the coat; refraction preserves the radiance over the squared index.
  const double by_hand = radiosity / pi * (1 - fresnel_dielectric(o.z, n)) / (n * n);
  EXPECT_NEAR(plastic.eval(o, i), by_hand, 1e-6);
  EXPECT_GT(std::abs(plastic.eval(o, i) - by_hand * n * n), 0.01);  // control: without the change of index
}

TEST(Plastic, WithoutChangeOfIndexIsItsBase) {
  const Plastic plastic = make_plastic(1, 0.6);
  for (const double angle : angles_deg) {
    EXPECT_NEAR(plastic.eval(direction_at(angle), direction_at(30)), 0.6 / pi, 1e-12);
    EXPECT_NEAR(plastic.albedo(direction_at(angle)), 0.6, 1e-12);
  }
}

// A coat of very low roughness behaves like the smooth coat; 2e-3 allows for the facets' spread of 0.1
// degrees.
TEST(Plastic, RoughCoatBecomesTheSmoothOne) {
  const Plastic smooth = make_plastic(1.5, 0.5);
  for (const auto distribution : {FacetDistribution::ggx, FacetDistribution::beckmann}) {
    const Plastic fine = make_plastic(1.5, 0.5, make_microfacets(distribution, 0.001, 0.001));
    const Plastic coarse = make_plastic(1.5, 0.5, make_microfacets(distribution, 0.3, 0.3));
    for (const double angle : {0.0, 35.0, 60.0, 80.0, 85.0})
      EXPECT_NEAR(fine.albedo(direction_at(angle)), smooth.albedo(direction_at(angle)), 2e-3) << angle;
    EXPECT_GT(std::abs(coarse.albedo(direction_at(80)) - smooth.albedo(direction_at(80))), 2e-3);  // control
  }
}

TEST(Plastic, RefusesInvalidParameters) {
  EXPECT_THROW(make_plastic(0.9, 0.5), std::invalid_argument);
  EXPECT_THROW(make_plastic(15, 0.5), std::invalid_argument);
  EXPECT_THROW(make_plastic(1.5, 1.01), std::invalid_argument);
  EXPECT_THROW(make_plastic(1.5, std::nan("")), std::invalid_argument);
  EXPECT_THROW(make_plastic(1.5, 0.5, make_microfacets(FacetDistribution::ggx, 0.1, 0.2)),
               std::invalid_argument);
}

}  // namespace
}  // namespace shelfbeam::test
