// Tests the standard errors of path reuse; bench_coverage examines many more rooms and runs.

#include "unit/transport/zoo.hpp"

#include <gtest/gtest.h>

#include "physics/reuse_matrix.hpp"
#include "unit/transport/interval_coverage.hpp"

namespace shelfbeam {
namespace {

// The reference is path reuse with other random numbers. Other tests show that it has no bias
// (ReuseAgreement, bench_coverage); the paper's estimator would take minutes for equally small errors.
test::Reference reference(const World& world, std::uint32_t batches) {
  constexpr std::uint32_t seeds = 4;
  std::vector<PowerSums> sums(world.receivers.size() * world.emitters.size());
  for (std::uint32_t seed = 101; seed <= 100 + seeds; ++seed) {
    const ReuseEstimator estimator(world, seed);
    for (std::uint32_t b = 0; b < batches; ++b) {
      const std::vector<double> batch =
          test::batch_of(estimator, world.receivers.size(), world.emitters.size(), b);
      for (std::size_t e = 0; e < sums.size(); ++e) sums[e].add(batch[e]);
    }
  }
  test::Reference found;
  const std::vector<double> known = test::analytic_direct(world);
  for (std::size_t e = 0; e < sums.size(); ++e) {
    found.mean.push_back(sums[e].mean() + known[e]);
    found.error.push_back(sums[e].standard_error());
  }
  return found;
}

// Coverage of runs of some batches, for entries that are not flagged.
test::CoverageCount coverage(const Scene& scene, const World& world, const test::Reference& known,
                             const ReuseEffort& effort, std::uint32_t batches, std::uint32_t seeds = 4) {
  constexpr std::uint32_t runs = 4;
  test::CoverageCount count;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    const ReuseEstimator estimator(world, seed, effort);
    const test::CoverageTable table =
        test::coverage_of(scene, world, estimator, known, {batches}, batches * runs);
    for (const auto& [of_class, found] : table.at(batches)) count += found.unflagged;
  }
  return count;
}

ReuseEffort with_spots(const SpotRule& rule) {
  ReuseEffort effort;
  effort.spots = rule;
  return effort;
}

// Labels 1 to 20 cm above a floor, and boards at 5 and 10 cm in a shop of 2.2 m: more than 1,000 pairs. The
// pairs of a cluster share their paths, so shares are known to about 1 %. The control is the rule of one cap
// for all receivers, 4 m from the unit, with which single rays from units outweigh a label's own rays.
TEST(ZooSlow, IntervalsContainTheTruthAboveFloors) {
  constexpr std::uint32_t batches = 77;  // 10,087 first rays per label
  for (const char* const name : {"labels above the floor", "low shop"}) {
    const Scene scene = test::zoo_room(name).scene();
    const World world(scene);
    const test::Reference known = reference(world, 308);
    const test::CoverageCount right = coverage(scene, world, known, {}, batches, 3);
    EXPECT_GT(right.pairs, 1000U) << name;
    EXPECT_GT(right.share(right.held), 0.92) << name;
    EXPECT_LT(right.share(right.held), 0.98) << name;
    EXPECT_LT(right.share(right.beyond_3), 0.012) << name;
    EXPECT_EQ(right.beyond_6, 0U) << name << ", worst " << right.worst;
    const test::CoverageCount wrong =
        coverage(scene, world, known,
                 with_spots({.min_cap_distance = 4, .near_distance = 0, .for_vertices = false}), batches, 1);
    EXPECT_GT(wrong.beyond_6, 0U) << name;
    EXPECT_GT(wrong.share(wrong.beyond_3), 0.012) << name;
  }
}

// Two of four units shine into the hall with the labels through a door: some 900 pairs of 2,096 first rays.
// The control is a cache that knows only surfaces that labels' walks meet, with three points per label.
TEST(ZooSlow, IntervalsContainTheTruthBehindADoor) {
  constexpr std::uint32_t batches = 16;
  const Scene scene = test::zoo_room("back room").scene();
  const World world(scene);
  const test::Reference known = reference(world, 77);
  const test::CoverageCount right = coverage(scene, world, known, {}, batches);
  EXPECT_GT(right.pairs, 800U);
  EXPECT_GT(right.share(right.held), 0.91);
  EXPECT_LT(right.share(right.beyond_3), 0.03);
  ReuseEffort from_labels;
  from_labels.seeks_rare_light = false;
  const test::CoverageCount wrong = coverage(scene, world, known, from_labels, batches);
  EXPECT_GT(wrong.share(wrong.beyond_3), 0.05);
}

}  // namespace
}  // namespace shelfbeam
