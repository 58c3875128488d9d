#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/heuristic/searches.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/enumeration.hpp"
#include "unit/placement/formula_instances.hpp"

namespace shelfbeam {
namespace {

using test::covering;

std::optional<Selection> search(const SignalTable& table, const PlacementProblem& problem,
                                const Selection& start, std::uint64_t moves, std::uint32_t seed = 1) {
  const std::vector<double> ones(table.columns(), 1.0);
  const detail::Reduction reduction = detail::reduce_cover({table, covering}, ones);
  const detail::Instance instance(table, problem);
  return detail::cover_search(instance, reduction, start, {moves}, seed, {});
}

Selection all_units(const SignalTable& table) {
  Selection all(table.columns());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

// Starting from all columns, two walks reach the best known value with each of these seeds.
TEST(CoverSearch, FindsTheKnownOptima) {
  const struct {
    SignalTable table;
    std::size_t fewest;
  } known[] = {{test::affine_lines(3), 18}, {test::affine_lines(4), 61}, {test::cube_cycles(5), 24}};
  for (const auto& [table, fewest] : known)
    for (const std::uint32_t seed : {1U, 7U}) {
      const auto found = search(table, covering, all_units(table), 50000, seed);
      ASSERT_TRUE(found);
      EXPECT_TRUE(check_selection(table, covering, *found).met());
      EXPECT_EQ(found->size(), fewest);
    }
}

// Installed units stay, the same seed gives the same selection, and a selection that is not better is not
// returned.
TEST(CoverSearch, KeepsInstalledUnitsAndClaimsNoBound) {
  SignalTable table = test::affine_lines(3);
  table.transceivers[5].installed = table.transceivers[6].installed = true;
  constexpr std::uint64_t moves = 20000;
  const auto found = search(table, covering, all_units(table), moves);
  ASSERT_TRUE(found);
  EXPECT_TRUE(std::count(found->begin(), found->end(), 5U) == 1 &&
              std::count(found->begin(), found->end(), 6U) == 1);
  EXPECT_TRUE(check_selection(table, covering, *found).met());
  EXPECT_EQ(search(table, covering, all_units(table), moves), found);
  EXPECT_FALSE(search(table, covering, *found, moves) &&
               search(table, covering, *found, moves)->size() >= found->size());
}

// Random weighted covers with conflicts, compared with enumeration: most selections are optimal, and all are
// feasible and cheaper than the start.
TEST(CoverSearch, FindsCheapSelectionsWithConflicts) {
  test::RandomTables random(41, {.labels = 12, .transceivers = 12, .borderline = false, .mounts = true});
  int found_some = 0, optimal = 0;
  for (int k = 0; k < 2000; ++k) {
    const SignalTable table = random.next();
    const PlacementProblem problem{.model = CommunicationModel::non_cooperative,
                                   .combination = Combination::weighted};
    const test::BruteForce truth(table, problem);
    const auto start = greedy_selection({table, {.model = problem.model}});
    if (!truth.feasible || !check_selection(table, problem, start).met()) continue;
    const std::vector<double> cost = detail::Instance(table, problem).first_cost;
    const auto value = [&](const Selection& selected) {
      double sum = 0;
      for (const std::uint32_t j : selected) sum += cost[j];
      return sum;
    };
    const detail::Reduction reduction = detail::reduce_cover({table, problem}, cost);
    const detail::Instance instance(table, problem);
    const auto found = detail::cover_search(instance, reduction, start, {500}, 1, {});
    if (!found) continue;
    ++found_some;
    EXPECT_TRUE(check_selection(table, problem, *found).met()) << k;
    EXPECT_LT(value(*found), value(start)) << k;
    optimal += value(*found) <= truth.best_sum * (1 + 1e-9);
  }
  EXPECT_GT(found_some, 20);
  EXPECT_GE(optimal, found_some - 1);
}

}  // namespace
}  // namespace shelfbeam
