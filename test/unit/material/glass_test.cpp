#include "shelfbeam/material/material.hpp"
#include "shelfbeam/material/optics/fresnel.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/stats/moments.hpp"

#include "support/hypothesis.hpp"
#include "support/testing.hpp"
#include "unit/material/cases.hpp"

namespace shelfbeam::test {
namespace {

TEST(Dielectric, RefractsBySnellsLaw) {
  const Material glass = make_dielectric(1.5);
  for (const double angle : angles_deg) {
    const Vec3 w = direction_at(angle);
    const auto in = sample(glass, w, 0.999999, 0, 0);
    ASSERT_TRUE(in && in->specular);
    const double sine = std::hypot(in->direction.x, in->direction.y);
    EXPECT_NEAR(1.5 * sine, std::sin(radians(angle)), 1e-12);
    EXPECT_LT(in->direction.z, 0);
    EXPECT_LE(in->direction.x * w.x + in->direction.y * w.y, 0);
    EXPECT_EQ(in->weight, 1);
    EXPECT_NEAR(in->pdf, 1 - fresnel_dielectric(w.z, 1.5), 1e-12);
    // The reversed direction leads back.
    const auto out = sample(glass, in->direction, 0.999999, 0, 0);
    ASSERT_TRUE(out);
    EXPECT_NEAR(length(out->direction - w), 0, 1e-7);
    const auto mirrored = sample(glass, w, 0, 0, 0);
    EXPECT_EQ(mirrored->direction, (Vec3{-w.x, -w.y, w.z}));
    EXPECT_NEAR(mirrored->pdf, specular_reflectance(glass, w), 1e-12);
  }
}

TEST(Dielectric, ReflectsTotallyFromInside) {
  const Material glass = make_dielectric(1.5);
  const Vec3 inside = -direction_at(45);
  for (const double u : {0.0, 0.5, 0.999999}) {
    const auto drawn = sample(glass, inside, u, 0.5, 0.5);
    ASSERT_TRUE(drawn);
    EXPECT_NEAR(length(drawn->direction - Vec3{-inside.x, -inside.y, inside.z}), 0, 1e-12);
    EXPECT_EQ(drawn->weight, 1);
  }
  EXPECT_TRUE(sample(glass, -inside, 0.5, 0.5, 0.5)->direction.z <
              0);  // control: from outside it is transmitted
}

// At roughness 0.001 rough glass behaves like smooth glass: all light continues, the share F of it reflected
// (z-test at 1e-4, error 0.2 %; the facets change F by less).
TEST(Dielectric, OfFineRoughnessIsSmooth) {
  const Material glass = make_dielectric(1.5, make_microfacets(FacetDistribution::ggx, 0.001, 0.001));
  std::vector<double> shares, expected, wrong, errors;
  for (const double angle : {0.0, 35.0, 60.0, 80.0}) {
    const Vec3 w = direction_at(angle);
    EXPECT_NEAR(albedo(glass, w), 1, 2e-3);
    Moments back;
    for (std::uint32_t k = 0; k < 40000; ++k) {
      const auto u = philox({k, 0, 0, 0}, 8);
      const auto drawn = sample(glass, w, to_uniform(u[0]), to_uniform(u[1]), to_uniform(u[2]));
      back.add(drawn && drawn->direction.z > 0 ? drawn->weight : 0);
    }
    shares.push_back(back.mean());
    expected.push_back(fresnel_dielectric(w.z, 1.5));
    wrong.push_back(fresnel_dielectric(w.z, 1.6));
    errors.push_back(std::hypot(back.standard_error(), 5e-4));
  }
  EXPECT_TRUE(z_test(shares, expected, errors, 1e-4).pass);
  EXPECT_FALSE(z_test(shares, wrong, errors, 1e-4).pass);
}

TEST(Dielectric, RefusesInvalidParameters) {
  const auto rough = make_microfacets(FacetDistribution::ggx, 0.3, 0.3);
  EXPECT_THROW(make_dielectric(0.99), std::invalid_argument);
  EXPECT_THROW(make_dielectric(1, rough), std::invalid_argument);
  EXPECT_THROW(make_dielectric(1.5, make_microfacets(FacetDistribution::ggx, 0.3, 0.3, Masking::cook_torrance,
                                                     FacetSampling::visible)),
               std::invalid_argument);
  EXPECT_NO_THROW(make_dielectric(1.5, rough));
}

// Sums the internal reflections one by one, to rounding.
PaneShares pane_by_hand(double cos_i, double n, double thickness, double absorption) {
  const double f = fresnel_dielectric(cos_i, n), cos_t = std::sqrt(1 - (1 - cos_i * cos_i) / (n * n));
  const double once = std::exp(-absorption * thickness / cos_t);
  PaneShares shares{f, 0};
  double inside = (1 - f) * once;  // at the far face
  for (int face = 0; face < 2000; ++face) {
    (face % 2 == 0 ? shares.transmitted : shares.reflected) += inside * (1 - f);
    inside *= f * once;
  }
  return shares;
}

TEST(ThinDielectric, SumsAllReflectionsBetweenItsFaces) {
  for (const double absorption : {0.0, 2.0, 500.0})
    for (const double angle : angles_deg) {
      const ThinDielectric pane = make_thin_dielectric(1.5, 0.006, absorption);
      const double cos_i = std::cos(radians(angle));
      const auto [reflected, transmitted] = pane_shares(pane, cos_i);
      const auto expected = pane_by_hand(cos_i, 1.5, 0.006, absorption);
      EXPECT_NEAR(reflected, expected.reflected, 1e-12);
      EXPECT_NEAR(transmitted, expected.transmitted, 1e-12);
      EXPECT_EQ(pane_transmittance(pane, -cos_i), transmitted);
      if (absorption == 0) {
        EXPECT_NEAR(reflected + transmitted, 1, 1e-12);
      } else {
        EXPECT_LT(reflected + transmitted, 1);
        EXPECT_GT(std::abs(transmitted - pane_by_hand(cos_i, 1.5, 0.006, 0).transmitted), 1e-12);  // control
      }
    }
  // Without absorption at normal incidence T = 2 n / (n^2 + 1).
  EXPECT_NEAR(pane_transmittance(make_thin_dielectric(1.5, 0.006, 0), 1), 3 / 3.25, 1e-12);
  EXPECT_NEAR(pane_transmittance(make_thin_dielectric(1, 0.006, 100), 1), std::exp(-0.6), 1e-12);
  EXPECT_EQ(pane_transmittance(make_thin_dielectric(1.5, 0.006, 2), 0), 0);
}

TEST(ThinDielectric, LetsLightStraightThroughOrMirrorsIt) {
  const ThinDielectric pane = make_thin_dielectric(1.5, 0.006, 20);
  const Material material = pane;
  for (const Vec3& w : {direction_at(50), -direction_at(50, 2), direction_at(89)}) {
    const auto [r, t] = pane_shares(pane, w.z);
    const auto back = sample(material, w, 0, 0.5, 0.5), on = sample(material, w, 0.999999, 0.5, 0.5);
    ASSERT_TRUE(back && on);
    EXPECT_EQ(back->direction, (Vec3{-w.x, -w.y, w.z}));
    EXPECT_EQ(on->direction, -w);
    EXPECT_NEAR(back->weight * back->pdf, r, 1e-12);
    EXPECT_NEAR(on->weight * on->pdf, t, 1e-12);
    EXPECT_NEAR(albedo(material, w), r + t, 1e-12);
    EXPECT_NEAR(specular_reflectance(material, w), r, 1e-12);
    EXPECT_TRUE(back->specular && on->specular);
    EXPECT_EQ(eval(material, w, -w), 0);
  }
  EXPECT_FALSE(sample(make_thin_dielectric(1, 1, 1e6), direction_at(10), 0.5, 0.5, 0.5));
}

// A pane is equivalent to two smooth boundaries of the solid dielectric: compares it with walks between them,
// z-test at 1e-4 with a standard error of 0.15 %. The control is a pane of another index.
TEST(ThinDielectric, IsASlabOfTheSolidDielectric) {
  const Material glass = make_dielectric(1.5);
  std::vector<double> through, expected, wrong, errors;
  for (const double angle : {0.0, 60.0, 80.0}) {
    const Vec3 w = direction_at(angle);
    Moments moments;
    for (std::uint32_t k = 0; k < 40000; ++k) {
      // The lower face is the inverted upper one: seen from inside both are alike.
      auto next = sample(glass, w, to_uniform(philox({k, 0, 0, 0}, 9)[0]), 0, 0);
      bool upper = true;
      if (next->direction.z < 0)
        for (std::uint32_t face = 1;; ++face) {
          upper = !upper;
          next = sample(glass, {next->direction.x, next->direction.y, -std::abs(next->direction.z)},
                        to_uniform(philox({k, face, 0, 0}, 9)[0]), 0, 0);
          if (next->direction.z > 0) break;
        }
      moments.add(upper ? 0 : 1);
    }
    through.push_back(moments.mean());
    errors.push_back(moments.standard_error());
    expected.push_back(pane_transmittance(make_thin_dielectric(1.5, 0.006, 0), w.z));
    wrong.push_back(pane_transmittance(make_thin_dielectric(1.6, 0.006, 0), w.z));
  }
  EXPECT_TRUE(z_test(through, expected, errors, 1e-4).pass);
  EXPECT_FALSE(z_test(through, wrong, errors, 1e-4).pass);
}

TEST(ThinDielectric, RefusesInvalidParameters) {
  EXPECT_THROW(make_thin_dielectric(0.5, 0.006, 2), std::invalid_argument);
  EXPECT_THROW(make_thin_dielectric(1.5, -0.006, 2), std::invalid_argument);
  EXPECT_THROW(make_thin_dielectric(1.5, 6, 2), std::invalid_argument);  // millimetres
  EXPECT_THROW(make_thin_dielectric(1.5, 0.006, -1), std::invalid_argument);
}

}  // namespace
}  // namespace shelfbeam::test
