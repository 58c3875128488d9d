#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/placement/heuristic/searches.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/formula_instances.hpp"

namespace shelfbeam {
namespace {

constexpr PlacementProblem alone{.model = CommunicationModel::non_cooperative};

std::optional<std::vector<std::uint32_t>> search(const SignalTable& table, const PlacementProblem& problem,
                                                 const std::vector<std::uint32_t>& start, std::uint64_t moves,
                                                 std::uint32_t seed = 1) {
  const std::vector<double> ones(table.columns(), 1.0);
  const detail::Reduction reduction = detail::reduce_cover(table, alone, ones);
  return detail::cover_search(table, problem, reduction, start, {moves}, seed, {});
}

std::vector<std::uint32_t> everything(const SignalTable& table) {
  std::vector<std::uint32_t> all(table.columns());
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
      const auto found = search(table, alone, everything(table), 50000, seed);
      ASSERT_TRUE(found);
      EXPECT_TRUE(check_selection(table, alone, *found).met());
      EXPECT_EQ(found->size(), fewest);
    }
}

// Installed units stay, the same seed gives the same selection, and a selection that is not better is not
// returned.
TEST(CoverSearch, KeepsInstalledUnitsAndClaimsNoBound) {
  SignalTable table = test::affine_lines(3);
  table.transceivers[5].installed = table.transceivers[6].installed = true;
  constexpr std::uint64_t moves = 20000;
  const auto found = search(table, alone, everything(table), moves);
  ASSERT_TRUE(found);
  EXPECT_TRUE(std::count(found->begin(), found->end(), 5U) == 1 &&
              std::count(found->begin(), found->end(), 6U) == 1);
  EXPECT_TRUE(check_selection(table, alone, *found).met());
  EXPECT_EQ(search(table, alone, everything(table), moves), found);
  EXPECT_FALSE(search(table, alone, *found, moves) &&
               search(table, alone, *found, moves)->size() >= found->size());
}

TEST(CoverSearch, IgnoresOtherProblems) {
  SignalTable table = test::affine_lines(2);
  const auto all = everything(table);
  EXPECT_FALSE(search(table, {}, all, 1000));
  EXPECT_FALSE(search(table, {.model = alone.model, .redundant = true}, all, 1000));
  table.conflicts = {{0, 1}};
  EXPECT_FALSE(search(table, alone, all, 1000));
}

}  // namespace
}  // namespace shelfbeam
