// The first roughness of a surface applies along its horizontal direction, on level surfaces along x.

#include <gtest/gtest.h>

#include "shelfbeam/transport/run/simulate.hpp"

#include "physics/comparison.hpp"
#include "support/empty_room.hpp"
#include "support/hypothesis.hpp"

namespace shelfbeam {
namespace {

// The signal of a label by way of one brushed side of a room, which label and unit face; all other sides are
// black.
SignalMatrix over(const Vec3& side, double alpha_x, double alpha_y, const Vec3& unit, const Vec3& label) {
  Scene scene = test::empty_room({8, 8, 8});
  scene.materials.push_back(
      {"brushed", make_conductor(0.2, 6, make_microfacets(FacetDistribution::ggx, alpha_x, alpha_y))});
  test::give_side(scene, side, MaterialId{1});
  scene.transceivers[0].position = unit;
  scene.transceivers[0].axis = side;
  scene.labels[0].position = label;
  scene.labels[0].normal = side;
  return test::mis.simulate(scene, 100000);
}
SignalMatrix over_floor(double alpha_x, double alpha_y, bool along_x) {
  return along_x ? over({0, 0, -1}, alpha_x, alpha_y, {2, 4, 2}, {6, 4, 2})
                 : over({0, 0, -1}, alpha_x, alpha_y, {4, 2, 2}, {4, 6, 2});
}
SignalMatrix over_wall(double alpha_across, double alpha_up, bool level) {
  return level ? over({-1, 0, 0}, alpha_across, alpha_up, {2, 2, 4}, {2, 6, 4})
               : over({-1, 0, 0}, alpha_across, alpha_up, {2, 4, 6}, {2, 4, 2});
}

// z-test at 0.1 %; relative standard errors of about 1 %.
testing::AssertionResult same(const SignalMatrix& a, const SignalMatrix& b) {
  return test::compare(a, b).agrees(0.001);
}

TEST(BrushedMetal, TurnsWithTheStore) {
  const SignalMatrix along = over_floor(0.1, 0.5, true);
  EXPECT_LT(along.standard_error[0] / along.mean[0], 0.02);
  EXPECT_TRUE(same(along, over_floor(0.5, 0.1, false)));
  EXPECT_FALSE(same(along, over_floor(0.5, 0.1, true)));
  EXPECT_FALSE(same(along, over_floor(0.1, 0.5, false)));
}

TEST(BrushedMetal, FirstRoughnessIsHorizontalOnWalls) {
  const SignalMatrix level = over_wall(0.1, 0.5, true);
  EXPECT_LT(level.standard_error[0] / level.mean[0], 0.02);
  EXPECT_TRUE(same(level, over_wall(0.5, 0.1, false)));
  EXPECT_FALSE(same(level, over_wall(0.5, 0.1, true)));
  // The same position over a floor and over a wall.
  EXPECT_TRUE(same(level, over_floor(0.1, 0.5, true)));
}

}  // namespace
}  // namespace shelfbeam
