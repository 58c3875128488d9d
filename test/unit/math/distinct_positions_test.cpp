#include "shelfbeam/math/distinct_positions.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

using Numbers = std::vector<std::uint32_t>;

Numbers numbers(const std::vector<Vec3>& positions) {
  const DistinctPositions groups = distinct_positions(positions);
  EXPECT_EQ(groups.count,
            positions.empty() ? 0 : *std::max_element(groups.group_of.begin(), groups.group_of.end()) + 1U);
  return groups.group_of;
}

TEST(DistinctPositions, AreTheSameUpToAMicrometreInEveryCoordinate) {
  EXPECT_EQ(numbers({}), Numbers{});
  EXPECT_EQ(numbers({{1, 2, 3}, {0, 2, 3}, {1, 2, 3}, {1, 2, 4}, {0, 2, 3}}), (Numbers{0, 1, 0, 2, 1}));
  // In floating point, 0.1 + 0.2 differs from 0.3, and -0 from 0.
  EXPECT_EQ(numbers({{0.1 + 0.2, -0.0, 3.98}, {0.3, 0.0, 3.98}}), (Numbers{0, 0}));
  for (int axis = 0; axis < 3; ++axis) {
    const auto moved = [&](double d) {
      return Vec3{5 + (axis == 0 ? d : 0), 5 + (axis == 1 ? d : 0), 5 + (axis == 2 ? d : 0)};
    };
    EXPECT_EQ(numbers({moved(0), moved(0.9e-6)}), (Numbers{0, 0}));
    EXPECT_EQ(numbers({moved(0), moved(1.1e-6)}), (Numbers{0, 1}));
    // Neighbours form a chain, in either order.
    EXPECT_EQ(numbers({moved(0), moved(1.8e-6), moved(0.9e-6)}), (Numbers{0, 0, 0}));
  }
}

// Compares with a comparison of all pairs, on a grid whose points occur several times, each with an error
// below half the tolerance, in any order. The same check must reject a tolerance of zero.
TEST(DistinctPositions, EqualComparisonOfAllPairs) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> error(-0.45e-6, 0.45e-6);
  std::vector<Vec3> positions;
  positions.reserve(600);
  for (int k = 0; k < 600; ++k)
    positions.push_back({0.1 * static_cast<double>(random() % 5) + error(random),
                         0.3 * static_cast<double>(random() % 7) + error(random),
                         3 + static_cast<double>(random() % 2) + error(random)});
  const DistinctPositions groups = distinct_positions(positions);
  EXPECT_EQ(groups.count, 70U);
  int exact = 0;
  for (std::size_t a = 0; a < positions.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Vec3 d = positions[a] - positions[b];
      const double most = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
      ASSERT_EQ(groups.group_of[a] == groups.group_of[b], most <= position_tolerance);
      exact += groups.group_of[a] == groups.group_of[b] && most > 0;
    }
  EXPECT_GT(exact, 1000);
}

}  // namespace
}  // namespace shelfbeam
