// Labels and units on glass, against the same devices 1 mm in front of or behind these.

#include "shelfbeam/transport/world/glass_devices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/transport/world/direct.hpp"

#include "physics/bare_scene.hpp"

namespace shelfbeam {
namespace {

/// A pane with a unit that looks down, and two labels, all `height` above it.
struct DevicesAtGlass {
  double height = 0;
  Vec3 up{0, 0, 1};
  Vec3 place{0.37, 0.21, 0.83};

  Scene scene() const {
    const Frame frame = Frame::about(normalized(up));
    const auto at = [&](double x, double y, double z) { return place + frame.to_world({x, y, z}); };
    test::BareScene bare;
    const MaterialId pane = bare.material(make_thin_dielectric(1.5, 0.004, 0));
    bare.quad(pane, at(-3, -3, 0), frame.to_world({6, 0, 0}), frame.to_world({0, 6, 0}));
    bare.unit(at(0.1, 0.2, height), -frame.z, GeneralizedLambertian{1, 10});
    bare.unit(at(0.1, 0.2, 0.5), -frame.z, GeneralizedLambertian{1, 10});
    bare.unit(at(0.1, 0.2, -0.5), frame.z, GeneralizedLambertian{1, 10});
    bare.label(at(0.4, 0, 0.6), -frame.z);
    bare.label(at(0.4, 0, -0.6), frame.z);
    bare.label(at(0.7, -0.3, height), -frame.z);
    return bare.scene;
  }

  /// Signals of the devices at the pane, straight and over mirrors: labels from the unit, units at the label.
  std::vector<double> signals() const {
    const Scene made = scene();
    const World world(made);
    std::vector<double> signals;
    for (const auto& [i, j] : {std::array<std::size_t, 2>{0, 0}, {1, 0}, {2, 1}, {2, 2}}) {
      const DirectSignal signal = direct_between_points(world, i, j, {});
      signals.push_back(signal.straight + signal.mirrored);
    }
    return signals;
  }
};

double largest_difference(const DevicesAtGlass& a, const DevicesAtGlass& b) {
  const auto one = a.signals(), other = b.signals();
  double largest = 0;
  for (std::size_t k = 0; k < one.size(); ++k)
    largest = std::max(largest, std::abs(one[k] - other[k]) / std::max({one[k], other[k], 0.01}));
  return largest;
}

std::optional<Devices> moved_in(const Scene& scene) {
  return devices_off_glass(scene, {scene.labels, scene.transceivers}, 1e-4, 1e-5);
}

// The housing of a unit may overlap the pane a little, and the rounding of either position must not matter.
TEST(GlassDevices, CountAsInFront) {
  for (const Vec3& up : {Vec3{0, 0, 1}, Vec3{0, -1, 0}, Vec3{0.4, -0.7, 0.3}})
    for (const double distance : {0.0, 50.0, 900.0}) {
      const Vec3 place = Vec3{0.37, 0.21, 0.83} + Vec3{distance, 0.6 * distance, 0};
      const DevicesAtGlass in_front{-1e-3, up, place}, behind{1e-3, up, place};
      ASSERT_GT(largest_difference(in_front, behind), 0.5) << "units behind a pane shine on it";
      for (const double height : {0.0, 1e-12, -1e-12, 1e-6, -1e-6, 1e-5, -1e-5, -3e-5})
        EXPECT_LT(largest_difference({height, up, place}, in_front), 0.01) << height << " at " << distance;
      for (const double height : {2e-5, 1e-4})
        EXPECT_LT(largest_difference({height, up, place}, behind), 0.01) << height << " at " << distance;
    }
}

TEST(GlassDevices, AreOthersThanThoseBesideAPane) {
  Scene scene = DevicesAtGlass{0.1}.scene();
  EXPECT_FALSE(moved_in(scene));
  scene.transceivers[0].position = Vec3{5, 0, 0.83};  // in its plane
  EXPECT_FALSE(moved_in(scene));
  scene.transceivers[0].position = Vec3{0.37, 0.21, 0.83};
  const auto moved = moved_in(scene);
  ASSERT_TRUE(moved);
  EXPECT_NEAR(moved->transceivers[0].position.z, 0.83 - 1e-4, 1e-15);
  EXPECT_EQ(moved->labels[2].position, scene.labels[2].position);
}

// SlowContact compares the signals of labels that look through glass.
TEST(GlassDevices, AreOutsideOfSolidGlass) {
  test::BareScene bare;
  bare.box(bare.material(make_dielectric(1.5)), {0, 0, 0}, {1, 1, 1});
  bare.label({0.3, 0.2, 1}, {0, 0, -1});
  bare.label({0.3, 0.2, 1 - 1e-6}, {0, 0, 1});
  bare.label({0.3, 0.2, 1 - 5e-5}, {0, 0, 1});
  bare.label({0, 0.4, 0.5}, {0, 0, 1});
  const auto moved = moved_in(bare.scene);
  ASSERT_TRUE(moved);
  EXPECT_NEAR(moved->labels[0].position.z, 1 + 1e-4, 1e-15);
  EXPECT_NEAR(moved->labels[1].position.z, 1 + 1e-4, 1e-15);
  EXPECT_EQ(moved->labels[2].position, bare.scene.labels[2].position) << "embedded in the glass";
  EXPECT_NEAR(moved->labels[3].position.x, -1e-4, 1e-15);
}

}  // namespace
}  // namespace shelfbeam
