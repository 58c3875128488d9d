#include "shelfbeam/material/material.hpp"
#include "shelfbeam/math/random.hpp"

#include "support/testing.hpp"
#include "unit/material/cases.hpp"
#include "unit/material/sphere_cells.hpp"

namespace shelfbeam::test {
namespace {

double integral_of_eval(const Material& material, const Vec3& wo) {
  const double plane = std::atan2(-wo.y, -wo.x);
  return SphereCells(plane, [&](const Vec3& s) { return eval(material, wo, s) * std::abs(s.z); }).integral();
}

// Two quadratures that share only the inputs of `eval`: over directions here, over facets in `albedo`. They
// agree to 5e-4, and to 2e-3 for rough glass (`albedo` does not split at the edges of total reflection). The
// control is a kernel that is 1 % too bright, where this is twice the tolerance.
TEST(EnergySlow, OfAllDirectionsIsTheAlbedo) {
  int controls = 0;
  for (const auto& [name, material, wrong] : rough_cases())
    for (const Vec3& wo : directions_for(material)) {
      SCOPED_TRACE(fmt::format("{} at {:.1f} degrees", name, std::acos(wo.z) * 180 / pi));
      const double error = std::holds_alternative<Dielectric>(material) ? 2e-3 : 5e-4;
      const double specular = specular_reflectance(material, wo);
      const double integral = integral_of_eval(material, wo), total = albedo(material, wo);
      EXPECT_NEAR(integral + specular, total, error);
      EXPECT_LE(total, 1);
      EXPECT_GE(total, 0);
      if (0.01 * integral < 2 * error) continue;
      ++controls;
      EXPECT_GT(std::abs(1.01 * integral + specular - total), error);
    }
  EXPECT_GT(controls, 300);
}

// The brightest materials: ideal metal, plastic over a white base, glass. Quadrature errs by 1e-4.
TEST(Energy, IsNeverGained) {
  using enum FacetDistribution;
  for (const Microfacets& m : all_facets({{0.01, 0.01}, {0.05, 0.05}, {0.2, 0.2}, {1, 1}, {0.05, 1}}))
    for (const double angle : {0.0, 75.0, 88.0, 89.5}) {
      SCOPED_TRACE(fmt::format("{} at {}", name_of(m), angle));
      const Vec3 w = direction_at(angle);
      EXPECT_LE(albedo(make_conductor(0, 1, m), w), 1 + 1e-4);
      if (m.masking == Masking::smith) {
        EXPECT_LE(albedo(make_dielectric(1.5, m), w), 1 + 1e-4);
        EXPECT_LE(albedo(make_dielectric(1.5, m), -w), 1 + 1e-4);
      }
    }
}

TEST(Energy, IsConservedByGlassAndIdealMirrors) {
  for (const double angle : angles_deg) {
    const Vec3 w = direction_at(angle);
    EXPECT_EQ(albedo(make_dielectric(1.5), w), 1);
    EXPECT_EQ(albedo(make_dielectric(1.5), -w), 1);
    EXPECT_NEAR(albedo(make_conductor(0, 1), w), 1, 1e-12);
    EXPECT_NEAR(albedo(make_plastic(1.5, 1), w), 1, 1e-12);
    for (const double roughness : {0.05, 0.5})
      EXPECT_NEAR(
          albedo(make_plastic(1.5, 1, make_microfacets(FacetDistribution::ggx, roughness, roughness)), w), 1,
          1e-12);
    EXPECT_LT(albedo(make_plastic(1.5, 0.99), w), 1);  // control
  }
}

// f_hat(a, b) = f_hat(b, a) within rounding, also at grazing angles. The controls omit the indices, or
// include the cosines.
TEST(Reciprocity, HoldsInBasicRadiance) {
  for (const auto& [name, material, wrong] : rough_cases()) {
    SCOPED_TRACE(name);
    const bool solid = std::holds_alternative<Dielectric>(material);
    const auto index2 = [&](const Vec3& w) { return solid && w.z < 0 ? 2.25 : 1; };
    int compared = 0, crossing = 0, asymmetric = 0;
    for (std::uint32_t k = 0; k < 2000; ++k) {
      const auto u = philox({k, 5, 0, 0}, 3);
      const auto direction = [&](double z, double phi, double side) {
        const double across = std::sqrt(1 - z * z);
        return Vec3{across * std::cos(phi), across * std::sin(phi), side < 0.5 ? z : -z};
      };
      const Vec3 a = direction(to_uniform(u[0]), 6 * to_uniform(u[1]), to_uniform(u[2] << 8));
      const Vec3 b = direction(to_uniform(u[2]), 6 * to_uniform(u[3]), to_uniform(u[3] << 8));
      const double ab = eval(material, a, b), ba = eval(material, b, a);
      EXPECT_NEAR(ab / index2(b), ba / index2(a), 1e-7 * (ab + ba));
      if (ab <= 0) continue;
      ++compared;
      crossing += a.z * b.z < 0;
      asymmetric += std::abs((solid ? ab : ab * b.z) / (solid ? ba : ba * a.z) - 1) > 0.01;
    }
    EXPECT_GT(compared, 150);
    EXPECT_GT(asymmetric, 75);
    if (solid) {
      EXPECT_EQ(asymmetric, crossing);
    }
  }
}

}  // namespace
}  // namespace shelfbeam::test
