#include "shelfbeam/math/random.hpp"

#include "support/direction_cells.hpp"
#include "support/hypothesis.hpp"
#include "support/testing.hpp"
#include "unit/device/profiles.hpp"

namespace shelfbeam::test {
namespace {

constexpr std::uint32_t draws = 100000;
constexpr double level = 1e-3;  // joint level of all cases (Sidak)
constexpr std::size_t sectors = 8, rings = 128, fine = 8;

struct Density {
  std::string name;
  std::function<std::optional<DirectionSample>(double, double)> sample;
  std::function<double(const Vec3&)> pdf;
  std::function<double(const Vec3&)> value;  ///< the density is proportional to this value
};

Density density_of(const std::string& name, const Emission& e) {
  return {name, [e](double u1, double u2) { return sample(e, u1, u2); },
          [e](const Vec3& d) { return pdf(e, d); },
          [e](const Vec3& d) { return intensity(e, d) / power(e); }};
}

Density density_of(const std::string& name, const Responsivity& r) {
  return {name, [r](double u1, double u2) { return sample(r, u1, u2); },
          [r](const Vec3& d) { return pdf(r, d); },
          [r](const Vec3& d) { return response(r, d.z) / integral(r); }};
}

std::vector<Density> densities() {
  std::vector<Density> result;
  for (const auto& [name, emission] : profiles()) result.push_back(density_of(name, emission));
  for (const auto& [name, responsivity] : responses()) result.push_back(density_of(name, responsivity));
  return result;
}

std::vector<double> counts(const Density& c, const DirectionCells& cells, double bend) {
  std::vector<double> result(cells.size());
  for (std::uint32_t k = 0; k < draws; ++k) {
    const auto u = philox({k, 0, 0, 0}, 31);
    if (const auto drawn = c.sample(std::pow(to_uniform(u[0]), bend), to_uniform(u[1])))
      ++result[cells.cell(drawn->direction)];
  }
  return result;
}

// Chi-square test of 100,000 directions in 128 x 8 cells over the sphere at a joint level of 1e-3. The
// expectations are midpoint sums, exact to about 1e-3 of a cell, far below its statistical 10 %. Controls: a
// density that is skewed by 8 % to one side, and samples whose u1 is distorted by a twelfth.
TEST(Sampling, FollowsItsDensity) {
  const DirectionCells cells(rings, sectors);
  const auto all = densities();
  for (const Density& c : all) {
    const auto drawn = counts(c, cells, 1);
    const auto expected = cells.expected(c.pdf, draws, fine);
    const auto test = chi_square_test(drawn, expected, level, all.size());
    EXPECT_TRUE(test.pass) << c.name << ": p = " << test.p_value;

    const auto leaning = [&](const Vec3& d) {
      return c.pdf(d) * (1 + 0.08 * d.x / std::max(1e-9, std::hypot(d.x, d.y)));
    };
    EXPECT_FALSE(chi_square_test(drawn, cells.expected(leaning, draws, 2), level, all.size()).pass) << c.name;
    EXPECT_FALSE(chi_square_test(counts(c, cells, 13.0 / 12), expected, level, all.size()).pass) << c.name;
  }
}

// The pdf of a sample is equal to `pdf`, bit for bit, and to the value over its integral within rounding.
// Every sampled direction therefore has a nonzero value.
TEST(Sampling, ReturnsTheDensityOfItsDirection) {
  for (const Density& c : densities()) {
    int lost = 0;
    for (std::uint32_t k = 0; k < 20000; ++k) {
      const auto u = philox({k, 1, 0, 0}, 31);
      const auto drawn = c.sample(to_uniform(u[0]), to_uniform(u[1]));
      if (!drawn) {
        ++lost;
        continue;
      }
      ASSERT_GT(drawn->pdf, 0) << c.name;
      ASSERT_EQ(drawn->pdf, c.pdf(drawn->direction)) << c.name;
      // acos in `response` rounds by 1e-8 rad near the normal, which is amplified by a slope of 6 per radian.
      ASSERT_NEAR(c.value(drawn->direction) / drawn->pdf, 1, 1e-6) << c.name;
      ASSERT_NEAR(length(drawn->direction), 1, 1e-14) << c.name;
    }
    EXPECT_EQ(lost, 0) << c.name;
  }
}

// The corners of the unit square and their neighbours, where inversions may divide by zero.
TEST(Sampling, SurvivesTheCornersOfTheUnitSquare) {
  const double last = 1 - 0x1p-53;
  for (const Density& c : densities())
    for (const double u1 : {0.0, 0x1p-60, 0x1p-32, 0.5, 1 - 0x1p-32, last})
      for (const double u2 : {0.0, 0x1p-60, 0.25, 0.5, 0.75, last})
        if (const auto drawn = c.sample(u1, u2)) {
          EXPECT_TRUE(is_finite(drawn->direction) && drawn->pdf > 0 && std::isfinite(drawn->pdf)) << c.name;
          EXPECT_NEAR(length(drawn->direction), 1, 1e-14) << c.name;
        }
}

}  // namespace
}  // namespace shelfbeam::test
