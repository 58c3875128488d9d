#include "shelfbeam/math/warp.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/random.hpp"

#include "support/direction_cells.hpp"
#include "support/hypothesis.hpp"

namespace shelfbeam {
namespace {

// Chi-square test at level 1e-4 with 200,000 directions in 20 x 16 cells. The control expects a uniform
// hemisphere.
TEST(CosineHemisphere, SamplesItsDensity) {
  constexpr std::uint32_t draws = 200000;
  const test::DirectionCells cells(20, 16);
  std::vector<double> counts(cells.size());
  for (std::uint32_t k = 0; k < draws; ++k) {
    const auto u = philox({k, 0, 0, 0}, 11);
    ++counts[cells.cell(sample_cosine_hemisphere(to_uniform(u[0]), to_uniform(u[1])))];
  }
  EXPECT_TRUE(chi_square_test(counts, cells.expected(pdf_cosine_hemisphere, draws), 1e-4).pass);
  const auto uniform = [](const Vec3& d) { return d.z > 0 ? 1 / (2 * pi) : 0; };
  EXPECT_FALSE(chi_square_test(counts, cells.expected(uniform, draws), 1e-4).pass);
}

}  // namespace
}  // namespace shelfbeam
