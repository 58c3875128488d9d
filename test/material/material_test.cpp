#include "shelfbeam/material/material.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/stats/hypothesis.hpp"
#include "shelfbeam/stats/moments.hpp"

#include "support/direction_cells.hpp"

namespace shelfbeam {
namespace {

const std::vector<Vec3> outgoing_directions{
    {0, 0, 1}, normalized({1, 0, 1}), normalized({0.3, -2, 0.2}), normalized({-1, 1, 0.01})};

// Chi-square at a joint level of 1e-4 over all directions, 100,000 samples each.
TEST(Material, SamplesWhatItsDensitySays) {
  constexpr std::uint32_t draws = 100000;
  const Material material = Lambertian{0.7};
  const test::DirectionCells cells(20, 8);
  for (const Vec3& outgoing : outgoing_directions) {
    std::vector<double> counts(cells.size());
    for (std::uint32_t k = 0; k < draws; ++k) {
      const auto u = philox({k, 0, 0, 0}, 3);
      ++counts[cells.cell(sample(material, outgoing, to_unit(u[0]), to_unit(u[1]))->direction)];
    }
    const auto density = [&](const Vec3& d) { return pdf(material, outgoing, d); };
    EXPECT_TRUE(
        chi_square_test(counts, cells.expected(density, draws), 1e-4, outgoing_directions.size()).pass);
    const auto wrong = [&](const Vec3& d) { return d.z > 0 ? 2 * d.z * d.z * 3 / (4 * pi) : 0; };
    EXPECT_FALSE(
        chi_square_test(counts, cells.expected(wrong, draws), 1e-4, outgoing_directions.size()).pass);
  }
}

// The sampled weight is f cos / pdf, and the reflected share over uniform directions is the albedo: z-test at
// 1e-4, standard error 0.1 %. The control is an albedo 2 % off.
TEST(Material, ReflectsItsAlbedo) {
  const Material material = Lambertian{0.7};
  std::vector<double> values, errors;
  for (const Vec3& outgoing : outgoing_directions) {
    Moments moments;
    for (std::uint32_t k = 0; k < 200000; ++k) {
      const auto u = philox({k, 1, 0, 0}, 3);
      const double z = to_unit(u[0]), phi = 2 * pi * to_unit(u[1]), r = std::sqrt(1 - z * z);
      const Vec3 incoming{r * std::cos(phi), r * std::sin(phi), z};
      moments.add(eval(material, outgoing, incoming) * z * 2 * pi);
    }
    values.push_back(moments.mean());
    errors.push_back(moments.standard_error());
    const auto drawn = sample(material, outgoing, 0.3, 0.8);
    ASSERT_TRUE(drawn);
    EXPECT_NEAR(drawn->weight, eval(material, outgoing, drawn->direction) * drawn->direction.z / drawn->pdf,
                1e-12);
    EXPECT_DOUBLE_EQ(albedo(material, outgoing), 0.7);
  }
  EXPECT_TRUE(z_test(values, std::vector<double>(values.size(), 0.7), errors, 1e-4).pass);
  EXPECT_FALSE(z_test(values, std::vector<double>(values.size(), 0.7 * 1.02), errors, 1e-4).pass);
}

TEST(Material, IsReciprocalAndDarkBelowItsSurface) {
  const Material material = Lambertian{0.4};
  for (const Vec3& a : outgoing_directions)
    for (const Vec3& b : outgoing_directions) {
      EXPECT_EQ(eval(material, a, b), eval(material, b, a));
      EXPECT_GT(eval(material, a, b), 0);
      EXPECT_EQ(eval(material, a, -b), 0);
      EXPECT_EQ(pdf(material, a, -b), 0);
    }
}

TEST(Material, BlackSurfacesEndAWalk) {
  EXPECT_FALSE(sample(Lambertian{0}, {0, 0, 1}, 0.5, 0.5));
}

}  // namespace
}  // namespace shelfbeam
