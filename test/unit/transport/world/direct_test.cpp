#include "shelfbeam/transport/world/direct.hpp"

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"

#include "support/small_store.hpp"

namespace shelfbeam {
namespace {

// The closed form between unit j and the first label, moved to another position.
double signal_at(Scene scene, const Vec3& position, const Vec3& normal, std::size_t j) {
  scene.labels.resize(1);
  scene.labels[0] = {"L", position, normal, {0}};
  return direct_between_points(World(scene), 0, j, {}).straight;
}

// The inverse square law, E = I(theta) cos / d^2, within the rounding of double precision (1e-12).
TEST(DirectSignal, IsTheInverseSquareLaw) {
  test::SmallStore store;
  store.peaks = {1.7};
  const Scene scene = store.scene();
  const Vec3 unit = scene.transceivers[0].position, position{0.2, 0.3, 2.0},
             normal = normalized({1, 0.2, 0.4});
  const Vec3 d = unit - position;
  const double theta = std::acos(d.z / length(d));
  const double expected = 1.7 * std::sin(2 * theta) * dot(normal, d) / length(d) / length_squared(d);
  const double signal = signal_at(scene, position, normal, 0);
  EXPECT_NEAR(signal / expected, 1, 1e-12);
  // Control: without the cosine at the label the value differs.
  EXPECT_GT(std::abs(signal * length(d) / dot(normal, d) / expected - 1), 0.01);
}

TEST(DirectSignal, IsZeroBehindTheLabelAndBehindAFixture) {
  const Scene scene = test::SmallStore{}.scene();
  EXPECT_EQ(signal_at(scene, {1, 0.2, 2.0}, {0, 0, -1}, 0), 0);
  // The gondola is between this label and unit 0.
  EXPECT_EQ(signal_at(scene, {2.5, 2.6, 0.3}, {0, 1, 0}, 0), 0);
  EXPECT_GT(signal_at(scene, {2.5, 2.6, 0.3}, {0, 1, 0}, 3), 0);
}

TEST(DirectSignal, TiltedUnitsShineAlongTheirAxis) {
  test::SmallStore store;
  store.peaks = {1};
  Scene scene = store.scene();
  scene.transceiver_types[0].emission = GeneralizedLambertian{1, pi};  // 1 W/sr on the axis
  scene.transceivers[0].position = {5.9, 4.5, 1.5};
  scene.transceivers[0].axis = {-1, 0, 0};
  EXPECT_NEAR(signal_at(scene, {3.9, 4.5, 1.5}, {1, 0, 0}, 0), 0.25, 1e-12);
}

}  // namespace
}  // namespace shelfbeam
