// The means of path reuse do not depend on the division of its work, on the content of its cache, or on the
// labels that share points: these affect only the variance.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "physics/comparison.hpp"
#include "physics/reuse_matrix.hpp"
#include "physics/strategy_store.hpp"

namespace shelfbeam::physics::reuse_effort {
namespace {

// A scene with diffuse and glossy surfaces, a mirror, a pane and a glass block. The cache omits signals below
// 0.5 % of the requirement, and treats units of each type separately.
Scene store(double requirement_factor = 1) {
  test::StrategyStore store;
  store.add_glossy();
  store.add_glass();
  Scene scene = store.scene();
  for (LabelType& type : scene.label_types) type.threshold *= requirement_factor;
  return scene;
}

// z-test of all entries at 0.1 %. The combined errors of the most precise entries are 0.5 to 3 %. The control
// is a reference 10 % off.
void expect_same(const SignalMatrix& found, const SignalMatrix& reference, const std::string& name) {
  const test::Comparison entries = test::compare(found, reference);
  EXPECT_TRUE(entries.agrees(0.001)) << name;
  EXPECT_FALSE(entries.with_references_times(1.1).agrees(0.001)) << name;
}

// Varies the cache from empty to complete. Light far below the requirement may be sampled so rarely that only
// many batches find it. Returns the sizes of the caches.
std::vector<std::size_t> check_caches(std::uint32_t factor, std::uint32_t of_reference,
                                      const std::vector<double>& requirements) {
  const SignalMatrix reference = test::reuse(store(), of_reference, 1000);
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

// With much higher requirements, few batches do not contain the rare rays that represent all light.
TEST(ReuseEffort, MeansDoNotDependOnTheCache) {
  const auto kept = check_caches(1, 4, {20, 1, 1e-4});
  EXPECT_LT(kept.front(), kept.back());
}

TEST(ReuseEffortSlow, MeansDoNotDependOnTheDistributionOfWork) {
  const Scene scene = store();
  const World world(scene);
  UnitGroups units(world);
  ASSERT_GT(BrightSpots(world, units, 1, {.min_cap_distance = 3}).size(), 0U);
  const SignalMatrix reference = test::reuse(scene, 24, 1000);
  const ReuseEffort least{.lookups = 8,
                          .points = 1,
                          .stake = 0.3,
                          .gather_rays = 3,
                          .later_gather_rays = 2,
                          .group = 1,
                          .survival = 0.5};
  const std::vector<std::pair<const char*, ReuseEffort>> efforts{
      {"few gathering rays", {.gather_rays = 1, .later_gather_rays = 1}},
      {"no groups", {.group = 1}},
      {"tiny groups", {.group = 3}},
      {"large groups", {.group = 128}},
      {"long paths", {.survival = 0.94}},
      {"one point", {.points = 1}},
      {"many points", {.points = 7}},
      {"few shadow rays", {.stake = 0.5}},
      {"few lookups", {.lookups = 2}},
      {"large spots", {.spots = {.min_cap_distance = 3}}},
      {"spots of old", {.spots = {.min_cap_distance = 4, .near_distance = 0, .for_vertices = false}}},
      {"spots close by", {.spots = {.min_cap_distance = 3, .near_distance = 3}}},
      {"little of all", least},
      {"shorter paths", {.survival = 0.3}}};
  std::uint64_t seed = 1;
  for (const auto& [name, effort] : efforts)
    expect_same(test::reuse(scene, 3, ++seed, effort), reference, name);
}

TEST(ReuseEffortSlow, MeansDoNotDependOnTheCache) {
  const auto kept = check_caches(3, 24, {1e6, 100, 30, 10, 1, 1e-4});
  EXPECT_LT(kept.front(), kept.back() * 3 / 4);
}

// Clusters of single labels, or without neighbours.
TEST(ReuseEffortSlow, MeansDoNotDependOnTheClusters) {
  const Scene scene = store();
  const SignalMatrix reference = test::reuse(scene, 24, 1000);
  const std::size_t m = scene.labels.size();
  for (const std::size_t parts : {std::size_t{2}, m}) {
    SignalMatrix found = reference;
    for (std::size_t part = 0; part < parts; ++part) {
      Scene some = scene;
      some.labels.clear();
      for (std::size_t i = part; i < m; i += parts) some.labels.push_back(scene.labels[i]);
      const SignalMatrix those = test::reuse(some, parts == m ? 12 : 3, 3);
      for (std::size_t k = 0; k < those.rows(); ++k)
        for (std::size_t j = 0; j < those.columns(); ++j) {
          found.mean[found.at(part + k * parts, j)] = those.mean[those.at(k, j)];
          found.standard_error[found.at(part + k * parts, j)] = those.standard_error[those.at(k, j)];
        }
    }
    expect_same(found, reference, std::to_string(parts) + " parts");
  }
}

}  // namespace
}  // namespace shelfbeam::physics::reuse_effort
