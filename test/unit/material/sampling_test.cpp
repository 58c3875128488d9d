#include "shelfbeam/material/material.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/stats/moments.hpp"

#include "support/hypothesis.hpp"
#include "support/testing.hpp"
#include "unit/material/cases.hpp"
#include "unit/material/sphere_cells.hpp"

namespace shelfbeam::test {
namespace {

constexpr std::uint32_t draws = 20000;

struct Drawn {
  std::vector<Vec3> directions;  // without specular ones
  Moments weights;               // of all samples, 0 for an absorbed one
};

Drawn draw(const Material& material, const Vec3& wo, std::uint32_t stream) {
  Drawn drawn;
  for (std::uint32_t k = 0; k < draws; ++k) {
    const auto u = philox({k, stream, 0, 0}, 11);
    const auto s = sample(material, wo, to_uniform(u[0]), to_uniform(u[1]), to_uniform(u[2]));
    drawn.weights.add(s ? s->weight : 0);
    if (!s) continue;
    EXPECT_TRUE(std::isfinite(s->weight) && s->weight >= 0 && s->pdf > 0);
    EXPECT_NEAR(length(s->direction), 1, 1e-9);
    if (s->specular) continue;
    drawn.directions.push_back(s->direction);
    // Rounding: the half vector is recomputed from the two directions.
    const double density = pdf(material, wo, s->direction);
    EXPECT_NEAR(s->pdf, density, 1e-6 * density);
    EXPECT_NEAR(s->weight, eval(material, wo, s->direction) * std::abs(s->direction.z) / density,
                1e-6 * s->weight);
  }
  return drawn;
}

ChiSquareTest compare(const Drawn& drawn, const Material& expected, const Vec3& wo, double level,
                      std::size_t tests) {
  const double plane = std::atan2(-wo.y, -wo.x);
  const SphereCells cells(plane, [&](const Vec3& s) { return pdf(expected, wo, s); });
  std::vector<double> expectations = cells.integrals(), counts(expectations.size());
  for (const Vec3& direction : drawn.directions) ++counts[cells.cell_of(direction)];
  // A cell at the edge of the sampled directions may contain none of the quadrature points.
  for (double& e : expectations) e = std::max(1e-3, e * draws);
  // Specular and absorbed samples form a separate cell or, if they are rare, are added to the largest cell:
  // the quadrature errs by up to 1e-4 in total.
  const double others = draws * (1 - cells.integral());
  const double other_count = draws - static_cast<double>(drawn.directions.size());
  if (others < 20) {
    const auto largest = std::max_element(expectations.begin(), expectations.end()) - expectations.begin();
    expectations[static_cast<std::size_t>(largest)] += others;
    counts[static_cast<std::size_t>(largest)] += other_count;
  } else {
    expectations.push_back(others);
    counts.push_back(other_count);
  }
  return chi_square_test(counts, expectations, level, tests);
}

// Chi-square test of 20,000 samples against the density, jointly at 1e-4 over all materials and directions;
// the quadrature of the density errs by less than 0.05 counts per cell. The control is a rougher material
// with the same samples. The mean weight is the albedo: z-test jointly at 1e-4; the quadrature of the albedo
// adds an error of 1e-4 (rough glass 1e-3). Its control is the albedo of the next case.
TEST(BsdfSamplingSlow, FollowsItsDensityAndAlbedo) {
  const auto& cases = rough_cases();
  std::size_t tests = 0;
  for (const auto& c : cases) tests += directions_for(c.material).size();
  std::vector<double> means, albedos, errors;
  std::vector<std::string> names;
  std::uint32_t stream = 0;
  for (const auto& [name, material, wrong] : cases)
    for (const Vec3& wo : directions_for(material)) {
      SCOPED_TRACE(fmt::format("{} at {:.1f} degrees", name, std::acos(wo.z) * 180 / pi));
      const Drawn drawn = draw(material, wo, ++stream);
      const auto right = compare(drawn, material, wo, 1e-4, tests);
      EXPECT_TRUE(right.pass) << right.statistic << " of " << right.degrees_of_freedom << ", p "
                              << right.p_value;
      const auto control = compare(drawn, wrong, wo, 1e-4, tests);
      EXPECT_FALSE(control.pass) << control.statistic << " of " << control.degrees_of_freedom;
      names.push_back(fmt::format("{} at {}", name, wo.z));
      means.push_back(drawn.weights.mean());
      albedos.push_back(albedo(material, wo));
      errors.push_back(std::hypot(drawn.weights.standard_error(),
                                  std::holds_alternative<Dielectric>(material) ? 1e-3 : 1e-4));
    }
  const auto weights = z_test(means, albedos, errors, 1e-4);
  EXPECT_TRUE(weights.pass) << names[weights.worst] << ": " << means[weights.worst] << " for "
                            << albedos[weights.worst] << ", z " << weights.largest;
  std::rotate(albedos.begin(), albedos.begin() + 1, albedos.end());
  EXPECT_FALSE(z_test(means, albedos, errors, 1e-4).pass);
}

}  // namespace
}  // namespace shelfbeam::test
