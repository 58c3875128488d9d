// Light paths are reversible: a unit with I = cos theta (flux pi) and a cosine label can be exchanged.

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"

#include "physics/comparison.hpp"
#include "physics/mixed_room.hpp"

namespace shelfbeam::physics::reciprocity {
namespace {

using test::Mount, test::Way;

const std::vector<Mount> high{{{1.5, 1.9, 2.8}, {0, 0, -1}},
                              {{4.3, 2.1, 2.6}, normalized({-1, 0.5, -2})},
                              {{2.2, 4.4, 2.3}, normalized({0.3, -1, -0.8})}};
const std::vector<Mount> low{{{1.8, 1.5, 1.1}, {0, 1, 0}},
                             {{3.9, 3.4, 0.8}, {0, -1, 0}},
                             {{0.2, 3.1, 1.4}, {1, 0, 0}},
                             {{3.4, 1.2, 0.1}, {0, 0, 1}}};

SignalMatrix simulate(const std::vector<Mount>& labels, const std::vector<Mount>& units,
                      const Emission& emission, const Way& way, std::uint64_t samples) {
  test::BareScene room = test::mixed_room();
  for (const Mount& mount : labels) room.label(mount.position, mount.direction);
  for (const Mount& mount : units) room.unit(mount.position, mount.direction, emission);
  return way.simulate(room.scene, samples);
}

const GeneralizedLambertian cosine{1, pi}, squared_cosine{2, 2 * pi / 3};  // I = cos, cos^2

// Compares all entries with those of the exchanged scene, by the same strategy.
test::Comparison exchanged(const Way& way, std::uint64_t samples, const Emission& emission) {
  const SignalMatrix one = simulate(low, high, emission, way, samples),
                     other = simulate(high, low, emission, way, samples);
  test::Comparison result;
  for (std::size_t i = 0; i < low.size(); ++i)
    for (std::size_t j = 0; j < high.size(); ++j) {
      const std::size_t a = one.at(i, j), b = other.at(j, i);
      result.add(one.mean[a], other.mean[b], std::hypot(one.standard_error[a], other.standard_error[b]));
    }
  return result;
}

// z-test of all twelve entries at 0.1 %. The relative standard errors of the differences are below
// `precision`. The control is a unit whose profile differs from the label's.
void expect_reciprocity(const Way& way, std::uint64_t samples, double precision) {
  const auto found = exchanged(way, samples, cosine);
  EXPECT_TRUE(found.agrees(0.001)) << way.name;
  EXPECT_LT(found.precision(), precision) << way.name;
  EXPECT_FALSE(exchanged(way, samples, squared_cosine).agrees(0.001)) << way.name;
}

// Relative standard errors of at most 2 % per entry.
TEST(Reciprocity, UnitsAndLabelsMayBeExchanged) {
  expect_reciprocity(test::mis, 20000, 0.03);
  expect_reciprocity(test::particle, 10000, 0.03);
}

// Relative standard errors of 0.9 % per entry.
TEST(ReciprocitySlow, UnitsAndLabelsMayBeExchanged) {
  expect_reciprocity(test::mis, 150000, 0.012);
  expect_reciprocity(test::particle, 75000, 0.012);
}

}  // namespace
}  // namespace shelfbeam::physics::reciprocity
