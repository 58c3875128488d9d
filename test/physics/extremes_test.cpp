// Tests very small and very large scenes, very weak and very strong units, and labels that measure in any
// unit. Signals scale with the inverse square of the size and in proportion to power and response, and
// nothing else changes.

#include <cmath>

#include <gtest/gtest.h>

#include "physics/bare_scene.hpp"
#include "physics/comparison.hpp"
#include "support/empty_room.hpp"

namespace shelfbeam::physics::extremes {
namespace {

struct Room {
  double size = 1, power = 1, response = 1;
  bool has_mirror = false;  ///< its light reaches a few entries by rare paths, which do not affect z-tests

  // A room of 6 x 5 x 3 with a box, a disc, and labels with and without a size. Lengths are multiplied by
  // `size`, intensities by `power`, responses by `response`.
  Scene scene() const {
    test::BareScene bare;
    const MaterialId paper = bare.material(Lambertian{0.6}), steel = bare.material(Conductor{2.5, 8, {}});
    const auto at = [&](double x, double y, double z) { return Vec3{x, y, z} * size; };
    bare.box({has_mirror ? steel : paper, paper, paper}, {}, at(6, 5, 3));
    bare.box(paper, at(2, 2, 0), at(4, 2.5, 1.5));
    for (int j = 0; j < 3; ++j)
      bare.unit(at(1 + 1.25 * j, 0.75 + j, 2.75), {0, 0, -1}, SinTwoTheta{power}, j == 2 ? 0.0625 * size : 0);
    bare.label(at(1.5, 1, 1.25), {0, 1, 0});
    bare.label(at(3, 1.5, 0.75), {0, -1, 0});
    bare.label(at(5, 4, 1.5), {-0.6, 0, 0.8}, CosineResponse{}, {0.0625 * size, 0.03125 * size});
    for (LabelType& type : bare.scene.label_types) {
      type.threshold = 0.02 * power * response / (size * size);
      if (response != 1)
        type.responsivity = ResponseTable{{{0, 0.7, 1.4}, {0}, {response, 0.7 * response, 0.1 * response}}};
    }
    return bare.scene;
  }
};

SignalMatrix simulated(const Scene& scene, EstimatorKind estimator, std::uint64_t seed = 1) {
  SimulationOptions options;
  options.estimator = estimator;
  options.direct = DirectLight::exact;
  options.samples = 8000;
  options.seed = seed;
  return simulate(scene, options).matrix;
}

bool is_times(const SignalMatrix& matrix, double factor, const SignalMatrix& ordinary) {
  for (std::size_t e = 0; e < ordinary.mean.size(); ++e)
    if (matrix.mean[e] != static_cast<float>(factor * ordinary.mean[e]) ||
        matrix.standard_error[e] != static_cast<float>(factor * ordinary.standard_error[e]))
      return false;
  return true;
}

// A power of two causes no rounding. Path reuse uses lengths that fit stores, so it is tested where the scene
// is so small that it is enlarged.
TEST(Extremes, PowersOfTwoInSizeOnlyRescale) {
  for (const EstimatorKind estimator : {EstimatorKind::uniform, EstimatorKind::reuse}) {
    const SignalMatrix ordinary = simulated(Room{.has_mirror = true}.scene(), estimator);
    for (const int exponent : {-11, -7, -3, 3, 6}) {
      if (exponent > 0 && estimator == EstimatorKind::reuse) continue;
      const double size = std::ldexp(1.0, exponent);
      const SignalMatrix matrix = simulated(Room{.size = size, .has_mirror = true}.scene(), estimator);
      EXPECT_TRUE(is_times(matrix, 1 / (size * size), ordinary)) << exponent;
      EXPECT_FALSE(is_times(matrix, 1.000001 / (size * size), ordinary));
    }
  }
}

// Tests a room of 2 x 1.7 x 1 mm and one of 500 x 417 x 250 m: z-tests at 0.1 %. The control is a factor of
// 1.3.
TEST(Extremes, AMillimetreAndHalfAKilometre) {
  for (const EstimatorKind estimator : {EstimatorKind::uniform, EstimatorKind::reuse}) {
    const SignalMatrix ordinary = simulated(Room{}.scene(), estimator, 2);
    for (const double size : {1.0 / 3000, 500.0 / 6}) {
      const auto found =
          test::compare(simulated(Room{.size = size}.scene(), estimator), ordinary, 1 / (size * size));
      EXPECT_TRUE(found.agrees(0.001)) << size;
      EXPECT_FALSE(found.with_references_times(1.3).agrees(0.001)) << size;
    }
  }
}

// Powers of two are exact; other factors agree within the rounding of single precision (uniform) or in a
// z-test at 0.1 % (path reuse, which uses rounded numbers to choose shadow rays). The control is a factor of
// 1.3.
TEST(Extremes, SignalsAreInProportionToThePower) {
  for (const EstimatorKind estimator : {EstimatorKind::uniform, EstimatorKind::reuse}) {
    const SignalMatrix ordinary = simulated(Room{}.scene(), estimator);
    for (const double power : {std::ldexp(1.0, -40), std::ldexp(1.0, 20)})
      EXPECT_TRUE(is_times(simulated(Room{.power = power}.scene(), estimator), power, ordinary)) << power;
    for (const double power : {1e-12, 1e6}) {
      const SignalMatrix matrix = simulated(Room{.power = power}.scene(), estimator, 3);
      const auto found = test::compare(matrix, ordinary, power);
      EXPECT_TRUE(found.agrees(0.001)) << power;
      EXPECT_FALSE(found.with_references_times(1.3).agrees(0.001)) << power;
    }
    const SignalMatrix weak = simulated(Room{.power = 1e-12}.scene(), EstimatorKind::uniform);
    const SignalMatrix same = simulated(Room{}.scene(), EstimatorKind::uniform);
    for (std::size_t e = 0; e < same.mean.size(); ++e)
      EXPECT_NEAR(weak.mean[e] / (1e-12 * same.mean[e]), 1, 1e-6);
  }
}

// Requirements are compared with light on surfaces, so units of measure must not enter: the same errors and
// flags as at powers of two near 1e-6 and 1e6. The control has thresholds in another unit than its responses.
TEST(Extremes, LabelsMeasureInAnyUnit) {
  for (const EstimatorKind estimator : {EstimatorKind::uniform, EstimatorKind::reuse}) {
    const SignalMatrix ordinary = simulated(Room{.response = 0.5}.scene(), estimator);
    for (const double factor : {std::ldexp(1.0, -20), std::ldexp(1.0, 10), std::ldexp(1.0, 20)}) {
      const SignalMatrix matrix = simulated(Room{.response = 0.5 * factor}.scene(), estimator);
      EXPECT_TRUE(is_times(matrix, factor, ordinary)) << factor;
      EXPECT_EQ(matrix.flags, ordinary.flags) << factor;
    }
  }
  Scene mixed = Room{.response = 512}.scene();
  for (LabelType& type : mixed.label_types) type.threshold /= 1024;
  EXPECT_FALSE(is_times(simulated(mixed, EstimatorKind::reuse), 1024,
                        simulated(Room{.response = 0.5}.scene(), EstimatorKind::reuse)));
}

// One label, one unit and black walls: sin 2 theta cos / d^2, within the rounding of single precision.
TEST(Extremes, OneLabelAndOneUnitHaveTheClosedForm) {
  for (const EstimatorKind estimator : {EstimatorKind::uniform, EstimatorKind::reuse})
    for (const double size : {0.001, 0.1, 1.0, 500.0}) {
      const SignalMatrix matrix = simulated(test::empty_room({size, size, size}), estimator);
      ASSERT_EQ(matrix.mean.size(), 1u);
      const double squared = 3 * size * size / 16, cosine = 1 / std::sqrt(3.0);
      const double expected = 2 * cosine * std::sqrt(1 - cosine * cosine) * cosine / squared;
      EXPECT_NEAR(matrix.mean[0] / expected, 1, 1e-6) << size;
      EXPECT_EQ(matrix.standard_error[0], 0) << size;
    }
}

}  // namespace
}  // namespace shelfbeam::physics::extremes
