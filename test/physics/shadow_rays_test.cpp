#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "shelfbeam/transport/run/simulate.hpp"

#include "physics/bare_scene.hpp"

namespace shelfbeam::physics::shadow_rays {
namespace {

// A room of 4 x 4 x 3 m with a label on its floor, and units 0.2 m below the ceiling that are free or in a
// closed box.
struct Room {
  test::BareScene bare;
  MaterialId paper = bare.material(Lambertian{0.6});

  Room() {
    bare.box(paper, {0, 0, 0}, {4, 4, 3});
    bare.label({2, 2, 0.01}, {0, 0, 1});
  }
  void unit(double x, bool is_boxed) {
    bare.unit({x, 2, 2.8}, {0, 0, -1}, GeneralizedLambertian{});
    if (is_boxed) bare.box(paper, {x - 0.1, 1.9, 2.7}, {x + 0.1, 2.1, 2.9});
  }
  ShadowRays shadow_rays(const SimulationOptions& options, unsigned threads = 0) const {
    return simulate(bare.scene, options, {threads}).summary.shadow_rays;
  }
};

SimulationOptions walks(std::uint64_t samples = 6400) {
  SimulationOptions options{EstimatorKind::uniform};
  options.samples = samples;
  return options;
}

TEST(ShadowRays, AreOccludedByAClosedBoxAndNotInAnEmptyRoom) {
  for (const bool is_boxed : {false, true}) {
    Room room;
    room.unit(1, is_boxed);
    const ShadowRays counts = room.shadow_rays(walks());
    EXPECT_GT(counts.traced, 6400U);
    EXPECT_EQ(counts.occluded, is_boxed ? counts.traced : 0U);
  }
}

// Without bounces every walk makes one connection to one of three units, of which one is in a box. The count
// is binomial, and the interval is that of a two-sided test at 1e-4. The controls are shares that it must
// reject.
TEST(ShadowRays, AThirdIsOccludedWhereOneOfThreeUnitsIsInABox) {
  Room room;
  for (const double x : {1.0, 2.0, 3.0}) room.unit(x, x == 2.0);
  SimulationOptions options = walks(9600);
  options.max_bounces = 0;
  const ShadowRays counts = room.shadow_rays(options);
  EXPECT_EQ(counts.connections, 9600U);
  EXPECT_EQ(counts.traced, counts.connections);
  const auto z = [&](double share) {
    const double n = static_cast<double>(counts.traced);
    return std::abs(static_cast<double>(counts.occluded) - share * n) / std::sqrt(n * share * (1 - share));
  };
  EXPECT_LT(z(1.0 / 3), 3.89);
  EXPECT_GT(z(0.30), 3.89);
  EXPECT_GT(z(0.37), 3.89);
}

// Connections from behind need no shadow ray.
TEST(ShadowRays, AreNotTracedWithoutContribution) {
  Room room;
  room.bare.unit({2, 2, 2.8}, {0, 0, 1}, GeneralizedLambertian{});
  SimulationOptions options = walks();
  options.max_bounces = 0;
  const ShadowRays counts = room.shadow_rays(options);
  EXPECT_EQ(counts.connections, 6400U);
  EXPECT_EQ(counts.traced, 0U);
}

TEST(ShadowRays, AreTheSameForAnyNumberOfThreads) {
  Room room;
  for (const double x : {1.0, 3.0}) room.unit(x, x == 1.0);
  const ShadowRays one = room.shadow_rays(walks(), 1);
  for (const unsigned threads : {2U, 5U}) {
    const ShadowRays many = room.shadow_rays(walks(), threads);
    EXPECT_EQ(one.connections, many.connections);
    EXPECT_EQ(one.traced, many.traced);
    EXPECT_EQ(one.occluded, many.occluded);
  }
  EXPECT_GT(one.occluded, 0U);
  EXPECT_LT(one.occluded, one.traced);
}

TEST(ShadowRays, AreNotCountedWithoutConnections) {
  Room room;
  room.unit(1, true);
  for (const auto change : {+[](SimulationOptions& o) { o.estimator = EstimatorKind::reuse; },
                            +[](SimulationOptions& o) { o.strategy = Strategy::particle; }}) {
    SimulationOptions options = walks();
    change(options);
    EXPECT_EQ(room.shadow_rays(options).connections, 0U);
  }
}

}  // namespace
}  // namespace shelfbeam::physics::shadow_rays
