#include "shelfbeam/math/polygon.hpp"

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

const Polygon l_shape{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};

TEST(Polygon, HasBoundsAndNearestEdges) {
  const PlanBounds bounds = bounds_of(l_shape);
  EXPECT_EQ(bounds.low, (Vec2{0, 0}));
  EXPECT_EQ(bounds.high, (Vec2{4, 3}));
  EXPECT_EQ(bounds.area(), 12);
  EXPECT_EQ(nearest_edge(l_shape, {2, 1.2}), 2u);
  EXPECT_EQ(nearest_edge(l_shape, {-5, 2.9}), 5u);
  EXPECT_NEAR(distance_to_border(l_shape, {2, 1.2}), 0.2, 1e-15);
  EXPECT_NEAR(distance_to_border(l_shape, {5, 2}), std::hypot(1, 1), 1e-15) << "to a corner";
}

}  // namespace
}  // namespace shelfbeam
