#include "shelfbeam/math/frame.hpp"

#include <gtest/gtest.h>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {
namespace {

Vec3 random_direction(std::uint32_t k) {
  const auto u = philox({k, 0, 0, 0}, 5);
  const double z = 2 * to_uniform(u[0]) - 1, phi = 2 * pi * to_uniform(u[1]), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

// Rounding of a handful of operations: 1e-14.
void expect_right_handed(const Frame& f) {
  EXPECT_NEAR(dot(f.x, f.y), 0, 1e-14);
  EXPECT_NEAR(dot(f.x, f.z), 0, 1e-14);
  EXPECT_NEAR(length(f.x), 1, 1e-14);
  EXPECT_NEAR(length(cross(f.x, f.y) - f.z), 0, 1e-14);
}

TEST(Frame, IsOrthonormalAndRightHanded) {
  for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}}) {
    expect_right_handed(Frame::about(axis));
    expect_right_handed(Frame::of_device(axis, 0.3));
  }
  for (std::uint32_t k = 0; k < 1000; ++k) {
    expect_right_handed(Frame::about(random_direction(k)));
    expect_right_handed(Frame::of_device(random_direction(k), 0.01 * k));
  }
}

TEST(Frame, TurnsThereAndBack) {
  for (std::uint32_t k = 0; k < 100; ++k) {
    const Frame frame = Frame::about(random_direction(k));
    const Vec3 v = random_direction(k + 1000);
    EXPECT_NEAR(length(frame.to_world(frame.to_local(v)) - v), 0, 1e-14);
  }
}

TEST(Frame, OfADeviceLookingDownHasItsXAlongTheRoom) {
  const Frame level = Frame::of_device({0, 0, -1}, 0);
  EXPECT_NEAR(length(level.x - Vec3{1, 0, 0}), 0, 1e-15);
  // A right-handed rotation about an axis that points down takes x to -y.
  const Frame rolled = Frame::of_device({0, 0, -1}, radians(90));
  EXPECT_NEAR(length(rolled.x - Vec3{0, -1, 0}), 0, 1e-15);
}

}  // namespace
}  // namespace shelfbeam
