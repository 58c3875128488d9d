#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/transport/run/simulate.hpp"

#include "support/empty_room.hpp"
#include "support/expect_input_error.hpp"
#include "support/small_store.hpp"

namespace shelfbeam {
namespace {

constexpr LengthSteps steps{0.5, 40};

SignalMatrix run(const Scene& scene, SimulationOptions options, std::uint64_t samples) {
  options.estimator = EstimatorKind::uniform;
  options.samples = samples;
  options.by_length = steps;
  return simulate(scene, options).matrix;
}

// A black room except for one wall, which label and unit face.
Scene one_wall() {
  Scene scene = test::empty_room({4, 5, 3});
  scene.materials.push_back({"white", make_lambertian(0.8)});
  test::give_side(scene, {1, 0, 0}, MaterialId{1});
  scene.labels[0].normal = {1, 0, 0};
  return scene;
}

// The wall's single bounces by path length: the integral over the wall, by midpoints.
std::vector<double> over_the_wall(const Scene& scene) {
  std::vector<double> lengths(steps.count, 0.0);
  const Vec3 label = scene.labels[0].position, unit = scene.transceivers[0].position;
  const Vec3 room = scene.room->upper();
  constexpr int fine = 800;
  for (int a = 0; a < fine; ++a)
    for (int b = 0; b < fine; ++b) {
      const Vec3 at{room.x, (a + 0.5) / fine * room.y, (b + 0.5) / fine * room.z};
      const Vec3 in = unit - at, out = label - at;
      const double d1 = length(in), d2 = length(out);
      const double down = in.z / d1;  // cos theta at the unit, which points down
      if (down <= 0) continue;
      const double intensity = 2 * down * std::sqrt(1 - down * down);
      const double cosines = (-in.x / d1) * (-out.x / d2) * (-out.x / d2);  // wall, wall, label
      const auto step = static_cast<std::size_t>((d1 + d2) / steps.step);
      lengths[step] += 0.8 / std::numbers::pi * intensity * cosines / (d1 * d1 * d2 * d2) * room.y * room.z /
                       (fine * fine);
    }
  return lengths;
}

TEST(PathLengths, OfDirectLightAreTheDistance) {
  Scene scene = test::empty_room({6, 5, 3});
  const double distance = length(scene.transceivers[0].position - scene.labels[0].position);
  const auto step = static_cast<std::size_t>(distance / steps.step);
  const SignalMatrix matrix = run(scene, {}, 64);
  EXPECT_EQ(matrix.length_step, steps.step);
  ASSERT_EQ(matrix.by_length.size(), steps.count);
  ASSERT_GT(matrix.mean[0], 0);
  for (std::size_t k = 0; k < steps.count; ++k)
    EXPECT_EQ(matrix.by_length[k].mean[0], k == step ? matrix.mean[0] : 0) << k;
}

// Student's t of 31 degrees of freedom exceeds 5 with probability 2e-5, for each of about ten steps. The
// control, which shifts everything by one step, is off by far more.
TEST(PathLengths, OfSingleBouncesAreThoseOfTheIntegral) {
  const Scene scene = one_wall();
  const SignalMatrix matrix = run(scene, {.max_bounces = 1}, 200000);
  std::vector<double> expected = over_the_wall(scene);
  const double distance = length(scene.transceivers[0].position - scene.labels[0].position);
  expected[static_cast<std::size_t>(distance / steps.step)] += static_cast<double>(matrix.direct[0]);
  double farthest = 0, farthest_shifted = 0;
  for (std::size_t k = 1; k < steps.count; ++k) {
    const auto mean = static_cast<double>(matrix.by_length[k].mean[0]);
    const auto error = static_cast<double>(matrix.by_length[k].standard_error[0]);
    if (error == 0) {
      EXPECT_NEAR(mean, expected[k], 1e-7) << k;
      continue;
    }
    farthest = std::max(farthest, std::abs(mean - expected[k]) / error);
    farthest_shifted = std::max(farthest_shifted, std::abs(mean - expected[k - 1]) / error);
  }
  EXPECT_LT(farthest, 5);
  EXPECT_GT(farthest_shifted, 50);
}

// Walks that hit discs compute their lengths differently from connections. 5 standard errors of a difference
// (probability 5e-6 at 62 degrees of freedom) are allowed in each of about 300 comparisons. Steps with less
// than 5 % of the signal are omitted, because walks find too few discs there. The sum over all steps is the
// signal within single precision.
TEST(PathLengthsSlow, AgreeBetweenStrategiesAndAddUp) {
  test::SmallStore store;
  store.peaks = {1, 1};
  Scene scene = store.scene();
  for (TransceiverType& type : scene.transceiver_types) type.radius = 0.6;
  const auto with = [&](Strategy strategy) {
    return run(scene, {.strategy = strategy, .max_bounces = 6, .by_bounce = true}, 100000);
  };
  const SignalMatrix connected = with(Strategy::nee), met = with(Strategy::walk), both = with(Strategy::mis);
  ASSERT_EQ(both.by_bounce.size(), 7u);
  std::size_t compared = 0;
  for (std::size_t e = 0; e < both.mean.size(); ++e) {
    double sum = 0;
    for (std::size_t k = 0; k < steps.count; ++k) {
      const auto value = [&](const SignalMatrix& matrix) {
        return static_cast<double>(matrix.by_length[k].mean[e]);
      };
      const auto error = [&](const SignalMatrix& matrix) {
        return static_cast<double>(matrix.by_length[k].standard_error[e]);
      };
      sum += value(both);
      if (value(connected) < 0.05 * static_cast<double>(both.mean[e])) continue;
      ++compared;
      EXPECT_LT(std::abs(value(connected) - value(met)), 5 * std::hypot(error(connected), error(met)))
          << e << ", step " << k;
      EXPECT_LT(std::abs(value(connected) - value(both)), 5 * std::hypot(error(connected), error(both)))
          << e << ", step " << k;
    }
    EXPECT_NEAR(sum / static_cast<double>(both.mean[e]), 1, 1e-6);
  }
  EXPECT_GT(compared, 100u);
}

TEST(PathLengths, LastBinHasAllLongerPaths) {
  const Scene scene = test::SmallStore{}.scene();
  SimulationOptions options{EstimatorKind::uniform, 640};
  options.by_length = {3, 2};
  const SignalMatrix matrix = simulate(scene, options).matrix;
  ASSERT_EQ(matrix.by_length.size(), 2u);
  for (std::size_t e = 0; e < matrix.mean.size(); ++e)
    EXPECT_NEAR((matrix.by_length[0].mean[e] + matrix.by_length[1].mean[e]) / matrix.mean[e], 1, 1e-6);
}

TEST(PathLengths, AreRefusedIfUnknown) {
  const Scene scene = test::SmallStore{}.scene();
  SimulationOptions options{EstimatorKind::uniform};
  options.by_length = steps;
  options.direct = DirectLight::exact;
  test::expect_input_error([&] { simulate(scene, options); }, "by path length", "direct light");
  options.direct = DirectLight::sampled;
  options.strategy = Strategy::particle;
  test::expect_input_error([&] { simulate(scene, options); }, "by path length", "particle");
}

}  // namespace
}  // namespace shelfbeam
