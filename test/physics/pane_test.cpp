// Tests direct light through panes: the free field times the transmittance of each pane at the ray's angle.

#include <gtest/gtest.h>

#include "shelfbeam/math/frame.hpp"

#include "physics/bare_scene.hpp"
#include "physics/comparison.hpp"
#include "physics/disc_light.hpp"

namespace shelfbeam::physics::pane {
namespace {

using test::Way;

const ThinDielectric clear{1.5, 0.004, 0}, tinted{1.6, 0.008, 30};
const Vec3 unit{0.1, 0.2, 3}, label{0.3, -0.4, 0};
const Vec3 label_normal = normalized({0.2, 0.1, 1});

double free_field() {
  const Vec3 way = unit - label;
  return dot(normalized(way), label_normal) * normalized(way).z / length_squared(way);
}

// Adds a large pane across the connection.
void add_pane(test::BareScene& space, const ThinDielectric& pane, const Vec3& normal, double share_of_way) {
  const Frame frame = Frame::about(normalized(normal));
  const Vec3 middle = label + (unit - label) * share_of_way;
  space.quad(space.material(pane), middle - frame.x - frame.y * 0.7, frame.x * 2.1, frame.y * 1.5);
}
double transmittance(const ThinDielectric& pane, const Vec3& normal) {
  return pane_transmittance(pane, dot(normalized(normal), normalized(unit - label)));
}

// Compares the direct light of every strategy that connects points with the free field: exact within the
// rounding of single precision, 1e-6.
void expect_direct(const test::BareScene& space, double share) {
  for (const Way& way : {test::nee, test::mis, test::particle})
    for (const DirectLight direct : {DirectLight::exact, DirectLight::sampled}) {
      const SignalMatrix matrix = way.simulate(space.scene, 64, 1, {.direct = direct});
      EXPECT_NEAR(matrix.direct[0] / free_field(), share, 1e-6) << way.name;
    }
}

test::BareScene free_space() {
  test::BareScene space;
  space.unit(unit, {0, 0, -1}, GeneralizedLambertian{1, pi});
  space.label(label, label_normal);
  return space;
}

TEST(Pane, KeepsItsTransmittanceOfTheDirectSignal) {
  const Vec3 across = unit - label, oblique{1.5, 0.3, 1}, grazing{0.2, 3, 0.1};
  expect_direct(free_space(), 1);
  for (const Vec3& normal : {across, oblique, grazing, -oblique})
    for (const ThinDielectric& pane : {clear, tinted}) {
      test::BareScene space = free_space();
      add_pane(space, pane, normal, 0.6);
      expect_direct(space, transmittance(pane, normal));
      // Controls: other glass, or the transmittance of a perpendicular ray.
      EXPECT_GT(std::abs(transmittance(pane, normal) / transmittance({1.51, pane.thickness, 0}, normal) - 1),
                1e-5);
      const double as_if_across = transmittance(pane, across);
      EXPECT_TRUE(normal == across || std::abs(transmittance(pane, normal) / as_if_across - 1) > 1e-3);
    }
}

TEST(Pane, MultipliesWithAnother) {
  const Vec3 first{1.5, 0.3, 1}, second{0, 0.2, 1};
  test::BareScene space = free_space();
  add_pane(space, clear, first, 0.3);
  add_pane(space, tinted, second, 0.8);
  const double both = transmittance(clear, first) * transmittance(tinted, second);
  expect_direct(space, both);
  EXPECT_LT(both, 0.99 * transmittance(clear, first));
  // Opaque objects still block the light.
  space.quad(space.material(Lambertian{0}), {-1, -1, 1.5}, {3, 0, 0}, {0, 3, 0});
  expect_direct(space, 0);
}

// Two discs seen through a pane by every strategy. They are so large that connections and walks share their
// light: the walk passes the pane at random, and both must use that probability. The pane is of germanium,
// which reflects much. z-test at 0.1 %, with relative standard errors below 1 %; the control is off by 4 %.
TEST(Pane, DimsDiscsForEveryStrategy) {
  const ThinDielectric germanium{4, 0.004, 50};
  constexpr double radii[] = {1.5, 1}, distances[] = {1.8, 0.9};
  test::BareScene space;
  space.label({0, 0, 0}, {0, 0, 1});
  space.quad(space.material(germanium), {-5, -5, 0.4}, {10, 0, 0}, {0, 10, 0});
  std::vector<double> expected;
  for (std::size_t j = 0; j < 2; ++j) {
    space.unit({0, 0, distances[j]}, {0, 0, -1}, GeneralizedLambertian{1, 1}, radii[j]);
    expected.push_back(test::irradiance_of_coaxial_disc(
        1, radii[j], distances[j], [&](double cosine) { return pane_transmittance(germanium, cosine); }));
  }
  for (const Way& way : {test::walk, test::nee, test::mis, test::mis_power, test::particle})
    for (const DirectLight direct : {DirectLight::sampled, DirectLight::exact}) {
      const SignalMatrix matrix = way.simulate(space.scene, 60000, 1, {.direct = direct, .max_bounces = 0});
      test::Comparison found;
      for (std::size_t j = 0; j < 2; ++j) found.add(matrix.mean[j], expected[j], matrix.standard_error[j]);
      test::expect_agreement(found, 0.01, 1.04, way.name);
    }
}

// A disc in the plane of the pane is treated as in front of it, and once, for every strategy. z-test at
// 0.1 %, with relative standard errors below 2 %. The controls are the disc behind the pane, and the sum of
// the disc in front and behind.
TEST(Pane, ShowsADiscInItsPlaneOnce) {
  const Frame frame = Frame::about(normalized({0.37, -0.52, 0.8}));
  constexpr double radius = 0.5;
  test::BareScene space;
  space.label({1, 2, 3}, frame.z);
  const Vec3 middle = Vec3{1, 2, 3} + frame.z;
  space.quad(space.material(tinted), middle - frame.x - frame.y, frame.x * 2, frame.y * 2);
  space.unit(middle, -frame.z, GeneralizedLambertian{1, 1}, radius);
  const auto expected = [&](bool behind) {
    return test::irradiance_of_coaxial_disc(
        1, radius, 1, [&](double cosine) { return behind ? pane_transmittance(tinted, cosine) : 1; });
  };
  for (const Way& way : {test::walk, test::nee, test::mis, test::particle}) {
    const SignalMatrix matrix = way.simulate(space.scene, 60000);
    test::Comparison found;
    found.add(matrix.mean[0], expected(false), matrix.standard_error[0]);
    EXPECT_TRUE(found.agrees(0.001)) << way.name;
    EXPECT_LT(found.precision(), 0.02) << way.name;
    const double behind = expected(true) / expected(false);
    EXPECT_FALSE(found.with_references_times(behind).agrees(0.001)) << way.name;
    EXPECT_FALSE(found.with_references_times(1 + behind).agrees(0.001)) << way.name;
  }
}

}  // namespace
}  // namespace shelfbeam::physics::pane
