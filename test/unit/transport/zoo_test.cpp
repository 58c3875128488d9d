// Tests the standard errors of path reuse; bench_coverage examines many more rooms and runs.

#include "unit/transport/zoo.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "physics/reuse_matrix.hpp"
#include "unit/transport/interval_coverage.hpp"

namespace shelfbeam {
namespace {

const test::ZooRoom& room(const std::vector<test::ZooRoom>& rooms, const std::string& name) {
  return *std::find_if(rooms.begin(), rooms.end(), [&](const auto& one) { return one.name == name; });
}

// The reference is path reuse with other random numbers. Other tests show that it has no bias
// (ReuseAgreement, bench_coverage); the paper's estimator would take minutes for equally small errors.
test::Reference reference(const World& world) {
  constexpr std::uint32_t seeds = 4, batches = 616;
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

// Coverage of runs of 77 batches, 10,087 first rays per label, for entries that are not flagged.
test::CoverageCount coverage(const Scene& scene, const World& world, const test::Reference& known,
                             const SpotRule& rule) {
  constexpr std::uint32_t seeds = 4, batches = 77, runs = 4;
  test::CoverageCount count;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    ReuseEffort effort;
    effort.spots = rule;
    const ReuseEstimator estimator(world, seed, effort);
    const test::CoverageTable table =
        test::coverage_of(scene, world, estimator, known, {batches}, batches * runs);
    for (const auto& [of_class, found] : table.at(batches)) count += found.unflagged;
  }
  return count;
}

// Labels 1 to 20 cm above a floor, and boards at 5 and 10 cm in a shop of 2.2 m: 1,200 to 3,000 pairs. The
// pairs of a cluster share their paths, so shares are known to about 1 %. The control is the rule of one cap
// for all receivers, 4 m from the unit, with which single rays from units outweigh a label's own rays.
TEST(ZooSlow, IntervalsContainTheTruthAboveFloors) {
  const auto rooms = test::zoo();
  for (const char* const name : {"labels above the floor", "low shop"}) {
    const Scene scene = room(rooms, name).scene();
    const World world(scene);
    const test::Reference known = reference(world);
    const test::CoverageCount right = coverage(scene, world, known, {});
    EXPECT_GT(right.pairs, 1000U) << name;
    EXPECT_GT(right.share(right.held), 0.92) << name;
    EXPECT_LT(right.share(right.held), 0.98) << name;
    EXPECT_LT(right.share(right.beyond_3), 0.012) << name;
    EXPECT_EQ(right.beyond_6, 0U) << name << ", worst " << right.worst;
    const test::CoverageCount wrong =
        coverage(scene, world, known, {.min_cap_distance = 4, .near_distance = 0, .for_vertices = false});
    EXPECT_GT(wrong.beyond_6, 0U) << name;
    EXPECT_GT(wrong.share(wrong.beyond_3), 0.012) << name;
  }
}

}  // namespace
}  // namespace shelfbeam
