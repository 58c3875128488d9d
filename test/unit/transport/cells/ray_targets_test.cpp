#include "shelfbeam/transport/cells/ray_targets.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {
namespace {

constexpr std::uint32_t own = 4096;
constexpr int targeted = own / 8;

Scene scene_with_door(double width, double height) {
  Scene scene;
  scene.room = RoomShape::box({8, 6, 3});
  scene.room->inner_walls.push_back(
      {"wall", {4, 0}, {4, 6}, 0.1, {}, {{.at = 2, .width = width, .bottom = 0.5, .top = 0.5 + height}}});
  return scene;
}

// The solid angle of a rectangle from a point above its centre.
double solid_angle(double width, double height, double distance) {
  const double a = width / 2, b = height / 2;
  return 4 * std::atan(a * b / (distance * std::sqrt(a * a + b * b + distance * distance)));
}

// The mean of 1 / density over directions to a target is its solid angle.
double sampled_solid_angle(const RayTargets::View& view, const Vec3& from) {
  double sum = 0;
  int rays = 0;
  view.each_ray(7, [&](std::size_t target, double u1, double u2) {
    sum += targeted / view.density(from, view.direction(target, from, u1, u2));
    ++rays;
  });
  EXPECT_EQ(rays, targeted);
  return sum / rays;
}

TEST(RayTargets, DirectionsFillAnOpening) {
  for (const double distance : {1.0, 2.0, 3.5}) {
    const RayTargets targets(scene_with_door(1, 2));
    const Vec3 from{4 - distance, 2.5, 1.5};
    const auto view = targets.seen_from(from, {1, 0, 0}, own);
    const double expected = solid_angle(1, 2, distance);
    // Sobol points integrate this smooth function to 1e-4; the area over the squared distance is off by 8 %
    // or more.
    EXPECT_NEAR(sampled_solid_angle(view, from), expected, 1e-3 * expected);
    EXPECT_GT(std::abs(2 / (distance * distance) - expected), 0.05 * expected);
  }
}

TEST(RayTargets, DirectionsFillABall) {
  RayTargets targets(Scene{});
  targets.add_unit({0, 0, 3});
  const Vec3 from{0.4, 0.2, 1};
  const auto view = targets.seen_from(from, {0, 0, 1}, own);
  const double squared = length_squared(from - Vec3{0, 0, 3});
  EXPECT_NEAR(sampled_solid_angle(view, from), 2 * pi * (1 - std::sqrt(1 - 0.4 * 0.4 / squared)), 1e-9);
}

TEST(RayTargets, DensityIsZeroBesideTheTarget) {
  const RayTargets targets(scene_with_door(1, 2));
  const Vec3 from{2, 2.5, 1.5};
  const auto view = targets.seen_from(from, {1, 0, 0}, own);
  EXPECT_GT(view.density(from, normalized(Vec3{2, 0.49, 0.99})), 0);
  EXPECT_EQ(view.density(from, normalized(Vec3{2, 0.51, 0})), 0);
  EXPECT_EQ(view.density(from, normalized(Vec3{2, 0, 1.01})), 0);
  EXPECT_EQ(view.density(from, {-1, 0, 0}), 0);
  EXPECT_EQ(view.weight(2, from, {-1, 0, 0}), 1);
}

// The solid angle of all targets in view.
double seen(const RayTargets& targets, const Vec3& from, const Vec3& normal) {
  const auto view = targets.seen_from(from, normal, own);
  return view.is_empty() ? 0 : sampled_solid_angle(view, from);
}

TEST(RayTargets, GapsAboveAWallAndBesideItsEndsAreOpenings) {
  Scene scene;
  scene.room = RoomShape::box({8, 6, 3});
  InnerWall& wall = scene.room->inner_walls.emplace_back(InnerWall{"wall", {4, 0}, {4, 6}, 0.1, {}, {}});
  const Vec3 from{2, 3, 1.5};
  EXPECT_EQ(seen(RayTargets(scene), from, {1, 0, 0}), 0);
  wall.height = 2.8;
  // The gap is 1.3 to 1.5 m above the point: a half of the difference between two rectangles.
  const double above = (solid_angle(6, 3, 2) - solid_angle(6, 2.6, 2)) / 2;
  EXPECT_NEAR(seen(RayTargets(scene), from, {1, 0, 0}), above, 1e-3 * above);
  wall.height = 1.9;  // ordinary rays find 1.1 m
  EXPECT_EQ(seen(RayTargets(scene), from, {1, 0, 0}), 0);
  // Below a slope, the part up to a metre counts where the gap is narrower in places.
  scene.room->height.points = {{{0, 0, 1.9}, {8, 0, 1.9}, {0, 6, 3.9}}};
  const double sloped = (solid_angle(6, 2.8, 2) - solid_angle(6, 0.8, 2)) / 2;
  EXPECT_NEAR(seen(RayTargets(scene), from, {1, 0, 0}), sloped, 1e-3 * sloped);
  scene.room->height = {3, {}};
  wall.height.reset();
  wall.to = {4, 5.88};
  const double beside = (solid_angle(6, 3, 2) - solid_angle(5.76, 3, 2)) / 2;
  EXPECT_NEAR(seen(RayTargets(scene), from, {1, 0, 0}), beside, 0.03 * beside);  // found to 5 mm
  wall.to = {4, 5.96};  // built into the wall of the room
  EXPECT_EQ(seen(RayTargets(scene), from, {1, 0, 0}), 0);
  wall.to = {4, 5.88};
  // Closed by another wall.
  scene.room->inner_walls.push_back({"corner", {3, 5.9}, {5, 5.9}, 0.3, {}, {}});
  EXPECT_EQ(seen(RayTargets(scene), from, {1, 0, 0}), 0);
  // A corner of two walls is closed, although the far wall is less than a metre away.
  scene.room->inner_walls = {{"one", {4, 0}, {4, 5.5}, 0.1, {}, {}},
                             {"other", {4, 5.5}, {8, 5.5}, 0.1, {}, {}}};
  EXPECT_EQ(seen(RayTargets(scene), from, {1, 0, 0}), 0);
  // A gap that belongs to the ends of two walls.
  scene.room->inner_walls = {{"one", {4, 0}, {4, 2.9}, 0.1, {}, {}},
                             {"other", {4, 3.1}, {4, 6}, 0.1, {}, {}}};
  EXPECT_NEAR(seen(RayTargets(scene), from, {1, 0, 0}), solid_angle(0.2, 3, 2),
              1e-2 * solid_angle(0.2, 3, 2));
}

TEST(RayTargets, OmitsWhatASurfaceHardlySees) {
  const RayTargets targets(scene_with_door(1, 2));
  EXPECT_TRUE(targets.seen_from({2, 2.5, 1.5}, {-1, 0, 0}, own).is_empty());   // behind
  EXPECT_FALSE(targets.seen_from({6, 2.5, 1.5}, {-1, 0, 0}, own).is_empty());  // from the other side
  EXPECT_TRUE(RayTargets(scene_with_door(0.01, 0.01)).seen_from({2, 2.5, 0.5}, {1, 0, 0}, own).is_empty());
  EXPECT_TRUE(RayTargets(Scene{}).seen_from({0, 0, 0}, {0, 0, 1}, own).is_empty());
}

TEST(RayTargets, ChoosesTheTargetsThatMostRaysMeet) {
  RayTargets targets(Scene{});
  for (int k = 0; k < 6; ++k) targets.add_unit({0, 0, 2.0 + k});
  const auto view = targets.seen_from({0, 0, 0}, {0, 0, 1}, own);
  double density = 0;
  for (int k = 0; k < 4; ++k)
    density += targeted / (2 * pi * (1 - std::sqrt(1 - 0.16 / ((2.0 + k) * (2.0 + k)))));
  EXPECT_NEAR(view.density({0, 0, 0}, {0, 0, 1}), density, 1e-9 * density);
}

}  // namespace
}  // namespace shelfbeam
