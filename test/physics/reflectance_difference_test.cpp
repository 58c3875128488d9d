// Runs of one seed in rooms that differ in a reflectance take the same paths, so that their difference is far
// more precise than either.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/transport/run/simulate.hpp"

#include "physics/bare_scene.hpp"

namespace shelfbeam::physics::reflectance_difference {
namespace {

SignalMatrix simulated(double reflectance, std::uint64_t seed, double brightest) {
  test::BareScene room;
  room.box({room.material(Lambertian{0.3}), room.material(Lambertian{0.8}),
            room.material(Lambertian{reflectance})},
           {0, 0, 0}, {6, 5, 3});
  room.box(room.material(Lambertian{0.5}), {2.8, 1.5, 0}, {3.3, 5, 1.8});
  for (int k = 0; k < 8; ++k)
    room.label({k < 4 ? 2.79 : 3.31, 1.8 + 0.7 * (k % 4), 0.4 + 0.3 * (k % 4)}, {k < 4 ? -1.0 : 1.0, 0, 0});
  for (const double x : {1.5, 4.5}) room.unit({x, 2.5, 2.95}, {0, 0, -1}, SinTwoTheta{1});
  SimulationOptions options;
  options.samples = 2096;
  options.direct = DirectLight::exact;
  options.seed = seed;
  options.brightest = brightest;
  return simulate(room.scene, options).matrix;
}

// The mean number of bounces at this material, by differences, for pairs of seeds: its standard deviation
// over the pairs relative to its mean, as a median over the entries. The reflectances are that of the walls
// and another of the same material, `step` times as large.
double spread(double step, double brightest, std::uint64_t other_seed = 0) {
  constexpr std::uint64_t pairs = 8;
  std::vector<std::vector<double>> bounces;
  for (std::uint64_t seed = 1; seed <= pairs; ++seed) {
    const SignalMatrix dark = simulated(0.8, seed, brightest),
                       bright = simulated(0.8 * step, seed + other_seed, brightest);
    bounces.resize(dark.mean.size());
    for (std::size_t e = 0; e < dark.mean.size(); ++e)
      bounces[e].push_back(std::log(static_cast<double>(bright.mean[e]) / static_cast<double>(dark.mean[e])) /
                           std::log(step));
  }
  std::vector<double> spreads;
  for (const std::vector<double>& of_entry : bounces) {
    double sum = 0, squares = 0;
    for (const double k : of_entry) {
      sum += k / pairs;
      squares += k * k / pairs;
    }
    spreads.push_back(std::sqrt(std::max(0.0, squares - sum * sum)) / std::abs(sum));
  }
  std::nth_element(spreads.begin(), spreads.begin() + static_cast<std::ptrdiff_t>(spreads.size() / 2),
                   spreads.end());
  return spreads[spreads.size() / 2];
}

TEST(ReflectanceDifference, IsPreciseAtOneSeed) {
  EXPECT_LT(spread(1.02, 0), 0.045);
  EXPECT_GT(spread(1.02, 0, 100), 0.15);  // the control: runs of different seeds
}

// Paths survive more often at 0.88 than at 0.8, unless they survive everywhere as at the brightest surface.
TEST(ReflectanceDifference, IsPreciseForAllReflectancesUpToTheBrightest) {
  EXPECT_LT(spread(1.1, 0.88), 0.015);
  EXPECT_GT(spread(1.1, 0), 0.02);
}

}  // namespace
}  // namespace shelfbeam::physics::reflectance_difference
