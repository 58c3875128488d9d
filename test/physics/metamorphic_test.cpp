// Tests relations between runs that hold for any values.

#include <gtest/gtest.h>

#include "physics/comparison.hpp"
#include "physics/mixed_room.hpp"

namespace shelfbeam::physics::metamorphic {
namespace {

using test::Way;

const Vec3 down{0, 0, -1};

// A room with two discs, and labels with and without a size.
test::BareScene room_with_discs() {
  test::BareScene room = test::mixed_room();
  room.unit({1.5, 1.9, 2.8}, down, GeneralizedLambertian{1, 2}, 0.3);
  room.unit({4.3, 3, 2.7}, down, SinTwoTheta{1}, 0.25);
  room.label({1.8, 1.5, 1.1}, {0, 1, 0}, CosineResponse{}, {0.4, 0.3});
  room.label({0.2, 3.1, 1.4}, {1, 0, 0});
  room.label({3.4, 1.2, 0.1}, {0, 0, 1}, CosinePowerResponse{2, 1.2}, {0.5, 0.5});
  room.label({3.5, 2, 2}, normalized({0.1, 1, 0.3}), CosineResponse{}, {0.3, 0.2});
  return room;
}

// Compares the sums of the layers up to `last` with the means of another run on the same random numbers, and
// so on the same paths. They agree within the rounding of single precision, 1e-6 of the largest sum.
bool layers_sum_to(const SignalMatrix& layered, std::size_t last, const SignalMatrix& whole) {
  for (std::size_t e = 0; e < whole.mean.size(); ++e) {
    double sum = 0;
    for (std::size_t k = 0; k <= last; ++k) sum += layered.by_bounce[k].mean[e];
    if (!(std::abs(sum - whole.mean[e]) <= 1e-6 * layered.mean[e])) return false;
  }
  return true;
}

TEST(ByBounce, LayersSumToTheMeanAndToShorterRuns) {
  const Scene scene = room_with_discs().scene;
  for (const Way& way : {test::walk, test::nee, test::mis, test::mis_power, test::particle})
    for (const DirectLight direct : {DirectLight::sampled, DirectLight::exact}) {
      const SignalMatrix all =
          way.simulate(scene, 3200, 1, {.direct = direct, .max_bounces = 200, .by_bounce = true});
      EXPECT_TRUE(layers_sum_to(all, 200, all)) << way.name;
      EXPECT_TRUE(layers_sum_to(all, 200, way.simulate(scene, 3200, 1, {.direct = direct}))) << way.name;
      for (const std::uint32_t most : {0U, 1U, 3U}) {
        const SignalMatrix few = way.simulate(scene, 3200, 1, {.direct = direct, .max_bounces = most});
        EXPECT_TRUE(layers_sum_to(all, most, few)) << way.name << " " << most;
        EXPECT_FALSE(layers_sum_to(all, most + 1, few)) << way.name << " " << most;
      }
    }
}

// Discs and rectangles with sampled and stratified direct light: z-test at 0.1 %, with relative standard
// errors of the difference up to 8 %, mostly due to the disc's light by way of the mirror. The control is a
// matrix 15 % off.
TEST(DirectLight, SampledAgreesWithExactForDiscsAndRectangles) {
  const Scene scene = room_with_discs().scene;
  for (const Way& way : {test::mis, test::mis_power, test::particle}) {
    const std::uint64_t samples = way.strategy == Strategy::particle ? 60000 : 20000;
    test::expect_agreement(test::compare(way.simulate(scene, samples, 1),
                                         way.simulate(scene, samples, 2, {.direct = DirectLight::exact})),
                           0.08, 1.15, way.name);
  }
}

// A disc of 1 cm against a point, among diffuse surfaces: z-test at 0.1 %, relative standard errors of the
// difference below 1.5 %. The true difference is (r/d)^2, less than 1e-4. The control is a disc of 60 cm.
TEST(Disc, ShrinksToAPoint) {
  const auto room = [](double radius) {
    test::BareScene result;
    const MaterialId paper = result.material(Lambertian{0.6});
    result.box(paper, {0, 0, 0}, {4, 3, 2.5});
    result.box(paper, {0.5, 1, 0}, {2.5, 1.4, 1.5});
    result.unit({1.4, 0.9, 2.2}, down, SinTwoTheta{1}, radius);
    result.label({1.8, 0.95, 0.8}, {0, -1, 0});
    result.label({2.2, 1.45, 1.1}, {0, 1, 0}, CosineResponse{}, {0.3, 0.2});
    result.label({3.9, 1.5, 1}, {-1, 0, 0});
    return result;
  };
  for (const Way& way : {test::nee, test::mis, test::particle}) {
    const SignalMatrix point = way.simulate(room(0).scene, 60000, 1);
    const auto found = test::compare(way.simulate(room(0.01).scene, 60000, 2), point);
    EXPECT_TRUE(found.agrees(0.001)) << way.name;
    EXPECT_LT(found.precision(), 0.015) << way.name;
    EXPECT_FALSE(test::compare(way.simulate(room(0.6).scene, 60000, 2), point).agrees(0.001)) << way.name;
  }
}

}  // namespace
}  // namespace shelfbeam::physics::metamorphic
