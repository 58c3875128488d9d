#include "shelfbeam/material/material.hpp"

#include "shelfbeam/material/optics/fresnel.hpp"
#include "shelfbeam/math/random.hpp"

#include "support/testing.hpp"
#include "unit/material/cases.hpp"

namespace shelfbeam::test {
namespace {

Vec3 turned(const Vec3& w) {
  return {w.x, w.y, -w.z};
}

TEST(Material, OpaqueOnesAreTheSameFromBothSides) {
  for (const auto& [name, material, wrong] : rough_cases()) {
    SCOPED_TRACE(name);
    if (std::holds_alternative<Dielectric>(material)) continue;
    const Vec3 a = direction_at(50), b = direction_at(40, 3.5);
    EXPECT_GT(eval(material, a, b), 0);
    EXPECT_EQ(eval(material, turned(a), turned(b)), eval(material, a, b));
    EXPECT_EQ(pdf(material, turned(a), turned(b)), pdf(material, a, b));
    EXPECT_EQ(albedo(material, turned(a)), albedo(material, a));
    EXPECT_EQ(eval(material, a, turned(b)), 0);
    EXPECT_EQ(eval(material, turned(a), b), 0);
    EXPECT_EQ(pdf(material, a, turned(b)), 0);
    for (const double u : {0.05, 0.5, 0.95}) {
      const auto above = sample(material, a, u, 0.3, 0.6), below = sample(material, turned(a), u, 0.3, 0.6);
      ASSERT_EQ(above.has_value(), below.has_value());
      if (!above) continue;
      EXPECT_EQ(below->direction, turned(above->direction));
      EXPECT_EQ(below->weight, above->weight);
      EXPECT_GT(above->direction.z, 0);
    }
  }
}

TEST(Material, SolidsHaveTheirIndexBelow) {
  const Material glass = make_dielectric(1.5);
  const Vec3 steep = direction_at(60);
  EXPECT_NEAR(specular_reflectance(glass, steep), fresnel_dielectric(0.5, 1.5), 1e-12);
  EXPECT_EQ(specular_reflectance(glass, -steep), 1);
}

TEST(Material, SmoothMetalIsAMirror) {
  const Material mirror = make_conductor(1.4, 8);
  const Vec3 w = direction_at(70, 1);
  const auto drawn = sample(mirror, w, 0.4, 0.4, 0.4);
  ASSERT_TRUE(drawn);
  EXPECT_TRUE(drawn->specular);
  EXPECT_EQ(drawn->direction, (Vec3{-w.x, -w.y, w.z}));
  EXPECT_EQ(drawn->pdf, 1);
  EXPECT_EQ(drawn->weight, fresnel_conductor(w.z, 1.4, 8));
  EXPECT_EQ(albedo(mirror, w), drawn->weight);
  EXPECT_EQ(specular_reflectance(mirror, w), drawn->weight);
  EXPECT_EQ(eval(mirror, w, drawn->direction), 0);
  EXPECT_EQ(pdf(mirror, w, drawn->direction), 0);
  EXPECT_THROW(make_conductor(0, 0), std::invalid_argument);
  EXPECT_THROW(make_conductor(-1, 3), std::invalid_argument);
}

TEST(Material, KnowsPureMirrors) {
  const auto rough = make_microfacets(FacetDistribution::ggx, 0.3, 0.3);
  EXPECT_TRUE(has_only_specular(make_conductor(1.4, 8)));
  EXPECT_TRUE(has_only_specular(make_dielectric(1.5)));
  EXPECT_TRUE(has_only_specular(make_thin_dielectric(1.5, 0.006, 2)));
  EXPECT_FALSE(has_only_specular(make_lambertian(0)));
  EXPECT_FALSE(has_only_specular(make_plastic(1.5, 0.5)));
  EXPECT_FALSE(has_only_specular(make_conductor(1.4, 8, rough)));
  EXPECT_FALSE(has_only_specular(make_dielectric(1.5, rough)));
  EXPECT_EQ(specular_reflectance(make_conductor(1.4, 8, rough), {0, 0, 1}), 0);
  EXPECT_NEAR(specular_reflectance(make_plastic(1.5, 0.5), {0, 0, 1}), 0.04, 1e-12);
}

TEST(Material, LightAlongTheSurfaceMeetsNothing) {
  for (const auto& [name, material, wrong] : rough_cases()) {
    EXPECT_EQ(eval(material, {1, 0, 0}, {0, 0, 1}), 0) << name;
    EXPECT_EQ(eval(material, {0, 0, 1}, {1, 0, 0}), 0) << name;
    EXPECT_FALSE(sample(material, {1, 0, 0}, 0.5, 0.5, 0.5)) << name;
  }
}

// Values within 1e-9 rad of the surface, and with extreme random numbers, are finite and not negative.
TEST(Material, StaysFiniteAtTheHorizon) {
  const double extremes[] = {0, 0x1p-32, 0.5, 1 - 0x1p-32};
  for (const auto& [name, material, wrong] : rough_cases())
    for (const double height : {1e-9, 1e-4, 0.02, 1.0})
      for (const double side : {1, -1}) {
        SCOPED_TRACE(fmt::format("{} at {}", name, side * height));
        const Vec3 wo = normalized({0.6, 0.8, side * height});
        for (const double u_lobe : extremes)
          for (const double u1 : extremes)
            for (const double u2 : extremes) {
              const auto drawn = sample(material, wo, u_lobe, u1, u2);
              if (!drawn) continue;
              EXPECT_TRUE(is_finite(drawn->direction));
              EXPECT_TRUE(std::isfinite(drawn->weight) && drawn->weight >= 0) << drawn->weight;
              EXPECT_TRUE(std::isfinite(drawn->pdf) && drawn->pdf > 0) << drawn->pdf;
            }
        for (const double other : {1e-9, -1e-9, 0.5, -0.5}) {
          const double value = eval(material, wo, normalized({-0.5, 0.3, other}));
          EXPECT_TRUE(std::isfinite(value) && value >= 0) << value;
        }
      }
}

TEST(Material, BlackSurfacesEndAWalk) {
  EXPECT_FALSE(sample(make_lambertian(0), {0, 0, 1}, 0.5, 0.5, 0.5));
  EXPECT_THROW(make_lambertian(1.2), std::invalid_argument);
  EXPECT_THROW(make_lambertian(-0.1), std::invalid_argument);
}

TEST(Material, HasTheNamesOfStoreFiles) {
  EXPECT_EQ(type_name(make_lambertian(0.5)), "lambertian");
  EXPECT_EQ(type_name(make_conductor(1, 1)), "conductor");
  EXPECT_EQ(type_name(make_plastic(1.5, 0.5)), "plastic");
  EXPECT_EQ(type_name(make_dielectric(1.5)), "dielectric");
  EXPECT_EQ(type_name(make_thin_dielectric(1.5, 0.006, 2)), "thin_dielectric");
}

}  // namespace
}  // namespace shelfbeam::test
