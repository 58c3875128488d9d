#include "shelfbeam/transport/cells/cell_division.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "physics/bare_scene.hpp"

namespace shelfbeam::detail {
namespace {

constexpr std::uint32_t no_part = ~0U;

// Points of the floor in the cell from -0.137 to 0.363 along x and y.
std::vector<SurfacePoint> floor_points(const World& world) {
  std::vector<SurfacePoint> points;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y) {
      const Vec3 from{-0.12 + 0.06 * x, -0.12 + 0.06 * y, 2.5};
      const auto hit = world.rays.intersect({from, {0, 0, -1}}, {0, 0, -1});
      if (hit && hit->point.position.z < 0.01)
        points.push_back({hit->point.position, {0, 0, 1}, hit->point.triangle});
    }
  return points;
}

test::BareScene hall() {
  test::BareScene scene;
  scene.box(scene.material(Lambertian{0.5}), {-3, -3, 0}, {3, 3, 3});
  return scene;
}

std::uint32_t part_at(const CellDivision& division, double x, double y) {
  return CellDivision::part(division.planes(), {{x, y, 0}, {0, 0, 1}});
}

TEST(CellDivision, OpenFloorIsOnePart) {
  const test::BareScene scene = hall();
  const World world(scene.scene);
  const CellDivision division(world, floor_points(world), {}, 1);
  EXPECT_EQ(division.parts().size(), 1U);
  EXPECT_TRUE(division.planes().empty());
}

TEST(CellDivision, WallSeparatesItsSides) {
  test::BareScene scene = hall();
  scene.box(scene.material(Lambertian{0.5}), {0.08, -3, 0}, {0.15, 3, 2});
  const World world(scene.scene);
  const CellDivision division(world, floor_points(world), {}, 1);
  EXPECT_EQ(division.parts().size(), 2U);
  EXPECT_NE(part_at(division, -0.1, 0.1), part_at(division, 0.3, 0.1));
  EXPECT_EQ(part_at(division, -0.1, -0.1), part_at(division, 0.07, 0.3));
  for (std::uint32_t k = 0; k < division.parts().size(); ++k)
    for (const SurfacePoint& point : division.parts()[k])
      EXPECT_EQ(CellDivision::part(division.planes(), point), k);
}

TEST(CellDivision, PaneDoesNotSeparate) {
  test::BareScene scene = hall();
  scene.quad(scene.material(ThinDielectric{}), {0.1, -3, 0}, {0, 6, 0}, {0, 0, 3});
  const World world(scene.scene);
  EXPECT_EQ(CellDivision(world, floor_points(world), {}, 1).parts().size(), 1U);
}

TEST(CellDivision, PointsOfAPartSeeEachOtherAroundAColumn) {
  test::BareScene scene = hall();
  scene.box(scene.material(Lambertian{0.5}), {0.05, 0.05, 0}, {0.2, 0.2, 2});
  const World world(scene.scene);
  const CellDivision division(world, floor_points(world), {}, 1);
  EXPECT_GT(division.parts().size(), 1U);
  for (const auto& points : division.parts())
    for (const SurfacePoint& point : points) {
      const Vec3 up{0, 0, 0.02}, from = points[0].position + up;
      EXPECT_GT(world.rays.transmittance({from, {0, 0, 1}}, point.position + up).share, 0);
    }
}

TEST(CellDivision, PartsShrinkTowardsACloseUnit) {
  test::BareScene scene = hall();
  const World world(scene.scene);
  // At the wall x = -3, whose cells it does not concern, and above this cell.
  const std::vector<CloseUnit> far{{{-2.9, 0, 0.1}, {1, 0, 0}, -3, 0.03}},
      close{{{0.1, 0.1, 0.1}, {1, 0, 0}, 0, 0.03}};
  EXPECT_EQ(CellDivision(world, floor_points(world), far, 1).parts().size(), 1U);
  const CellDivision division(world, floor_points(world), close, 1);
  EXPECT_GT(division.parts().size(), 20U);
  EXPECT_LT(division.parts().size(), CellDivision::max_parts);
  EXPECT_NE(part_at(division, 0.10, 0.03), part_at(division, 0.18, 0.03));
  for (const auto& points : division.parts()) EXPECT_FALSE(points.empty());
}

TEST(CellDivision, FindsDamagedPlanes) {
  const CellDivision::Plane whole{{1, 0, 0}, 0, {0, 1}};
  EXPECT_TRUE(CellDivision::fit({}));
  EXPECT_TRUE(CellDivision::fit(std::vector{whole}));
  CellDivision::Plane itself = whole, beyond = whole;
  itself.sides[1] = CellDivision::inner;
  beyond.sides[1] = no_part;
  EXPECT_FALSE(CellDivision::fit(std::vector{itself}));
  EXPECT_FALSE(CellDivision::fit(std::vector{beyond}));
}

}  // namespace
}  // namespace shelfbeam::detail
