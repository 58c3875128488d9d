// Path reuse gives the same means however its work is dealt out, whatever its cache holds and whichever
// labels share their points: all of this is a matter of variance alone.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "physics/comparison.hpp"
#include "physics/reuse_matrix.hpp"
#include "physics/strategy_store.hpp"

namespace shelfbeam {
namespace {

// Diffuse and glossy surfaces, mirror, pane and glass block. The cache leaves out what is less than 0.5 % of
// the requirement, and units of either type apart.
Scene store(double requirement_factor = 1, bool with_glass = true) {
  test::StrategyStore store;
  store.add_glossy();
  if (with_glass) store.add_glass();
  Scene scene = store.scene();
  for (LabelType& type : scene.label_types) type.threshold *= requirement_factor;
  return scene;
}

// z-test of all entries at 0.1 %; the combined errors are 0.5 to 3 % of the best ones. The control is a
// reference 10 % off.
void expect_same(const SignalMatrix& found, const SignalMatrix& reference, const std::string& name) {
  const test::Comparison entries = test::compare(found, reference);
  EXPECT_TRUE(entries.agrees(0.001)) << name;
  EXPECT_FALSE(entries.with_references_times(1.1).agrees(0.001)) << name;
}

void check_efforts(std::uint32_t factor) {
  // Few batches do not meet the rare light over mirrors.
  const Scene scene = store(1, factor > 1);
  const World world(scene);
  UnitGroups units(world);
  ASSERT_GT(BrightSpots(world, units, 1, {.cap_at = 3}).size(), 0U);
  const SignalMatrix reference = test::reuse(scene, 8 * factor, 1000);
  const ReuseEffort least{.lookups = 8,
                          .points = 1,
                          .stake = 0.3,
                          .gather_rays = 3,
                          .later_gather_rays = 2,
                          .group = 1,
                          .survival = 0.5};
  std::vector<std::pair<const char*, ReuseEffort>> efforts{
      {"few gathering rays", {.gather_rays = 1, .later_gather_rays = 1}},
      {"no groups", {.group = 1}},
      {"tiny groups", {.group = 3}},
      {"large groups", {.group = 128}},
      {"long paths", {.survival = 0.94}},
      {"one point", {.points = 1}},
      {"many points", {.points = 7}},
      {"few shadow rays", {.stake = 0.5}},
      {"few lookups", {.lookups = 2}},
      {"large spots", {.spots = {.cap_at = 3}}},
      {"spots of old", {.spots = {.cap_at = 4, .near = 0, .for_vertices = false}}},
      {"spots close by", {.spots = {.cap_at = 3, .near = 3}}},
      {"little of all", least}};
  // Many batches hold none of the long paths that such short ones stand for.
  if (factor > 1) efforts.push_back({"shorter paths", {.survival = 0.3}});
  std::uint64_t seed = 1;
  for (const auto& [name, effort] : efforts)
    expect_same(test::reuse(scene, factor, ++seed, effort), reference, name);
}

// From little in the cache, or nothing, to everything. What is far below the requirement may be sampled so
// rarely that it takes many batches to see it. Returns how large the caches are.
std::vector<std::size_t> check_caches(std::uint32_t factor, const std::vector<double>& requirements) {
  const SignalMatrix reference = test::reuse(store(), 8 * factor, 1000);
  std::vector<std::size_t> kept;
  std::uint64_t seed = 1;
  for (const double requirement : requirements) {
    const Scene scene = store(requirement);
    const World world(scene);
    kept.push_back(ReuseEstimator(world, 1).bytes());
    expect_same(test::reuse(scene, requirement >= 30 ? 6 * factor : factor, ++seed), reference,
                "requirement x " + std::to_string(requirement));
  }
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  return kept;
}

// Labels by themselves, or without their neighbours.
void check_clusters(std::uint32_t factor) {
  const Scene scene = store();
  const SignalMatrix reference = test::reuse(scene, 8 * factor, 1000);
  const std::size_t m = scene.labels.size();
  for (const std::size_t parts : {std::size_t{2}, m}) {
    SignalMatrix found = reference;
    for (std::size_t part = 0; part < parts; ++part) {
      Scene some = scene;
      some.labels.clear();
      for (std::size_t i = part; i < m; i += parts) some.labels.push_back(scene.labels[i]);
      const SignalMatrix those = test::reuse(some, factor * (parts == m ? 4 : 1), 3);
      for (std::size_t k = 0; k < those.rows(); ++k)
        for (std::size_t j = 0; j < those.columns(); ++j) {
          found.mean[found.at(part + k * parts, j)] = those.mean[those.at(k, j)];
          found.standard_error[found.at(part + k * parts, j)] = those.standard_error[those.at(k, j)];
        }
    }
    expect_same(found, reference, std::to_string(parts) + " parts");
  }
}

TEST(ReuseEffort, MeansDoNotDependOnHowTheWorkIsDealtOut) {
  check_efforts(1);
}
// Few batches do not hold the rare rays that stand for all light where the requirement is much higher.
TEST(ReuseEffort, MeansDoNotDependOnTheCache) {
  const auto kept = check_caches(1, {20, 1, 1e-4});
  EXPECT_LT(kept.front(), kept.back());
}
TEST(ReuseEffort, MeansDoNotDependOnTheClusters) {
  check_clusters(1);
}

TEST(ReuseEffortSlow, MeansDoNotDependOnHowTheWorkIsDealtOut) {
  check_efforts(8);
}
TEST(ReuseEffortSlow, MeansDoNotDependOnTheCache) {
  const auto kept = check_caches(10, {1e6, 100, 30, 10, 1, 1e-4});
  EXPECT_LT(kept.front(), kept.back() * 3 / 4);
}
// Far too weak for the requirement, all units are left to chance; some of what they give comes in one batch
// of fifty and its errors are lopsided, so this takes 9,600.
TEST(ReuseEffortSlow, MeansDoNotDependOnTheRequirement) {
  expect_same(test::reuse(store(1e6), 300, 6), test::reuse(store(), 100, 1000), "nothing in reach");
}
TEST(ReuseEffortSlow, MeansDoNotDependOnTheClusters) {
  check_clusters(10);
}

}  // namespace
}  // namespace shelfbeam
