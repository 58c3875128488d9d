#include "shelfbeam/transport/direct.hpp"

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"

#include "support/small_store.hpp"

namespace shelfbeam {
namespace {

Label label_at(const Vec3& position, const Vec3& normal) {
  return {"L", position, normal, {0}};
}

// Inverse square, E = I(theta) cos / d^2, exact to rounding of double precision (1e-12).
TEST(DirectSignal, IsTheInverseSquareLaw) {
  test::SmallStore store;
  store.peaks = {1.7};
  const Scene scene = store.scene();
  const RayScene rays(scene.mesh);
  const Emitters emitters(scene);
  const Vec3 unit = scene.transceivers[0].position;
  const Label label = label_at({0.2, 0.3, 2.0}, normalized({1, 0.2, 0.4}));
  const Vec3 d = unit - label.position;
  const double theta = std::acos(d.z / length(d));
  const double expected = 1.7 * std::sin(2 * theta) * dot(label.normal, d) / length(d) / length_squared(d);
  const double signal = direct_signal(label, CosineResponse{}, emitters, 0, rays);
  EXPECT_NEAR(signal / expected, 1, 1e-12);
  // The control: without the cosine at the label it would be another value.
  EXPECT_GT(std::abs(signal * length(d) / dot(label.normal, d) / expected - 1), 0.01);
}

TEST(DirectSignal, IsZeroBehindTheLabelAndBehindAFixture) {
  const Scene scene = test::SmallStore{}.scene();
  const RayScene rays(scene.mesh);
  const Emitters emitters(scene);
  EXPECT_EQ(direct_signal(label_at({1, 0.2, 2.0}, {0, 0, -1}), CosineResponse{}, emitters, 0, rays), 0);
  const Label behind = label_at({2.5, 2.6, 0.3}, {0, 1, 0});  // the gondola stands between it and unit 0
  EXPECT_EQ(direct_signal(behind, CosineResponse{}, emitters, 0, rays), 0);
  EXPECT_GT(direct_signal(behind, CosineResponse{}, emitters, 3, rays), 0);
}

TEST(DirectSignal, TiltedUnitsShineAlongTheirAxis) {
  test::SmallStore store;
  store.peaks = {1};
  Scene scene = store.scene();
  scene.transceiver_types[0].emission = GeneralizedLambertian{1, pi};  // 1 W/sr on the axis
  scene.transceivers[0].position = {5.9, 4.5, 1.5};
  scene.transceivers[0].axis = {-1, 0, 0};
  const RayScene rays(scene.mesh);
  const Emitters emitters(scene);
  EXPECT_NEAR(direct_signal(label_at({3.9, 4.5, 1.5}, {1, 0, 0}), CosineResponse{}, emitters, 0, rays), 0.25,
              1e-12);
}

}  // namespace
}  // namespace shelfbeam
