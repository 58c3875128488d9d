// Straight through panes: the free field times the transmittance of each at the angle of the ray.

#include <gtest/gtest.h>

#include "shelfbeam/math/frame.hpp"

#include "bare_scene.hpp"
#include "comparison.hpp"

namespace shelfbeam {
namespace {

using test::Way;

const ThinDielectric clear{1.5, 0.004, 0}, tinted{1.6, 0.008, 30};
const Vec3 unit{0.1, 0.2, 3}, label{0.3, -0.4, 0};
const Vec3 label_normal = normalized({0.2, 0.1, 1});

double free_field() {
  const Vec3 way = unit - label;
  return dot(normalized(way), label_normal) * normalized(way).z / length_squared(way);
}

// A large pane about the middle of the way.
void add_pane(test::BareScene& space, const ThinDielectric& pane, const Vec3& normal, double share_of_way) {
  const Frame frame = Frame::about(normalized(normal));
  const Vec3 middle = label + (unit - label) * share_of_way;
  space.quad(space.material(pane), middle - frame.x - frame.y * 0.7, frame.x * 2.1, frame.y * 1.5);
}
double transmittance(const ThinDielectric& pane, const Vec3& normal) {
  return pane_transmittance(pane, dot(normalized(normal), normalized(unit - label)));
}

// The part without a bounce of every strategy that joins points, relative to the free field: exact to the
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
      // The controls: other glass, or the pane as thick as it would be for a ray across it.
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
  // Opaque things between them still block.
  space.quad(space.material(Lambertian{0}), {-1, -1, 1.5}, {3, 0, 0}, {0, 3, 0});
  expect_direct(space, 0);
}

// Discs seen through a pane, by every strategy: the direct signal of a walk passes the pane by chance.
// z-test at 0.1 % at relative standard errors of 2 % (walk) and below 0.5 %. The pane lies across the line to
// the disc's centre, and the disc is small enough for one transmittance (to 1e-4: the cosine changes by
// (r/d)^2 / 2 = 0.1 %, the transmittance near the normal far less). The control is no pane.
TEST(Pane, DimsADiscForEveryStrategy) {
  constexpr double radius = 0.15;
  const Vec3 normal = unit - label;
  test::BareScene space;
  space.unit(unit, -normalized(normal), GeneralizedLambertian{1, 1}, radius);
  space.label(label, normalized(normal));
  add_pane(space, tinted, normal, 0.5);
  const double expected = transmittance(tinted, normal) / (pi * (radius * radius + length_squared(normal)));
  const auto test = [&](const Way& way, std::uint64_t samples, DirectLight direct) {
    const SignalMatrix matrix = way.simulate(space.scene, samples, 1, {.direct = direct});
    test::Comparison found;
    found.add(matrix.direct[0], expected, std::hypot(matrix.standard_error[0], 1e-4 * expected));
    EXPECT_TRUE(found.agrees(0.001)) << way.name;
    EXPECT_LT(found.precision(), way.strategy == Strategy::walk ? 0.03 : 0.005) << way.name;
    EXPECT_FALSE(found.with_references_times(1 / transmittance(tinted, normal)).agrees(0.001)) << way.name;
  };
  test(test::walk, 2000000, DirectLight::sampled);
  for (const Way& way : {test::nee, test::mis, test::mis_power, test::particle}) {
    test(way, 20000, DirectLight::sampled);
    test(way, 2000, DirectLight::exact);
  }
}

}  // namespace
}  // namespace shelfbeam
