#include "shelfbeam/placement/windows/cover_tree.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

using detail::cheapest_cover;
using detail::columns_of_covers;
using detail::FoundCovers;
using detail::SmallCover;

constexpr std::uint64_t any_nodes = std::numeric_limits<std::uint64_t>::max();

SmallCover random_cover(test::RandomTables& random) {
  SmallCover cover;
  const int columns = random.whole(1, 10);
  for (int j = 0; j < columns; ++j)
    cover.cost.push_back(random.chance(0.1) ? 0.0 : random.chance(0.5) ? 1.0 : random.real(0, 2));
  const int rows = random.whole(0, 12);
  for (int i = 0; i < rows; ++i) {
    std::vector<std::uint32_t> row;
    for (int j = 0; j < columns; ++j)
      if (random.chance(0.3)) row.push_back(static_cast<std::uint32_t>(j));
    if (!row.empty()) cover.rows.push_back(row);
  }
  return cover;
}

bool reaches_all(const SmallCover& cover, std::uint32_t set) {
  return std::all_of(cover.rows.begin(), cover.rows.end(), [&](const auto& row) {
    return std::any_of(row.begin(), row.end(), [&](std::uint32_t j) { return (set >> j & 1U) != 0; });
  });
}

double cost_of(const SmallCover& cover, std::uint32_t set) {
  double sum = 0;
  for (std::size_t j = 0; j < cover.cost.size(); ++j) sum += (set >> j & 1U) != 0 ? cover.cost[j] : 0;
  return sum;
}

double min_cost(const SmallCover& cover) {
  double best = std::numeric_limits<double>::infinity();
  for (std::uint32_t set = 0; set < (std::uint32_t{1} << cover.cost.size()); ++set)
    if (reaches_all(cover, set)) best = std::min(best, cost_of(cover, set));
  return best;
}

std::vector<double> random_multipliers(test::RandomTables& random, const SmallCover& cover) {
  std::vector<double> y(cover.rows.size());
  for (double& value : y) value = random.chance(0.3) ? 0.0 : random.real(-0.2, 1);
  return y;
}

TEST(CoverTree, FindsTheCheapestCoverFromAnyMultipliers) {
  test::RandomTables random(71);
  for (int repeat = 0; repeat < 500; ++repeat) {
    const SmallCover cover = random_cover(random);
    const double least = min_cost(cover);
    const FoundCovers found =
        cheapest_cover(cover, random_multipliers(random, cover), least + 1, {{any_nodes}});
    ASSERT_TRUE(found.complete);
    ASSERT_LE(found.bound, least);
    ASSERT_NEAR(found.bound, least, 1e-8 * (least + 1));
    ASSERT_TRUE(found.selected);
    std::uint32_t set = 0;
    for (const std::uint32_t j : *found.selected) set |= std::uint32_t{1} << j;
    ASSERT_TRUE(reaches_all(cover, set));
    ASSERT_NEAR(cost_of(cover, set), least, 1e-8 * (least + 1));
  }
}

// Repeated rows and dearer copies of columns change nothing, but sets of more than 64 members.
TEST(CoverTree, FindsTheSameAmongManyRowsAndColumns) {
  test::RandomTables random(74);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const SmallCover cover = random_cover(random);
    const double least = min_cost(cover);
    SmallCover wide = cover;
    for (std::uint32_t j = 0; j < 70; ++j) {
      const std::uint32_t original = j % static_cast<std::uint32_t>(cover.cost.size());
      const auto copy = static_cast<std::uint32_t>(wide.cost.size());
      wide.cost.push_back(cover.cost[original] + 1);
      for (std::size_t i = 0; i < cover.rows.size(); ++i)
        if (std::ranges::count(cover.rows[i], original) > 0) wide.rows[i].push_back(copy);
    }
    for (std::size_t i = 0; i < 8 * cover.rows.size(); ++i)
      wide.rows.push_back(wide.rows[i % cover.rows.size()]);
    const FoundCovers found = cheapest_cover(wide, {}, least + 1, {{any_nodes}});
    ASSERT_TRUE(found.complete);
    ASSERT_LE(found.bound, least);
    ASSERT_NEAR(found.bound, least, 1e-8 * (least + 1));
  }
}

TEST(CoverTree, BoundOfAnUnfinishedTreeHolds) {
  test::RandomTables random(72);
  int unfinished = 0;
  for (int repeat = 0; repeat < 500; ++repeat) {
    const SmallCover cover = random_cover(random);
    const double least = min_cost(cover);
    const auto nodes = static_cast<std::uint64_t>(random.whole(0, 4));
    const FoundCovers found = cheapest_cover(cover, random_multipliers(random, cover), least + 1, {{nodes}});
    ASSERT_LE(found.bound, least);
    unfinished += found.complete ? 0 : 1;
  }
  EXPECT_GT(unfinished, 100);
}

TEST(CoverTree, FindsTheColumnsOfAllCheapCovers) {
  test::RandomTables random(77);
  int excluded = 0;
  for (int repeat = 0; repeat < 500; ++repeat) {
    const SmallCover cover = random_cover(random);
    const double limit = min_cost(cover) + random.real(0, 1);
    const auto found = columns_of_covers(cover, random_multipliers(random, cover), limit, {{any_nodes}});
    ASSERT_TRUE(found.complete);
    for (std::uint32_t j = 0; j < cover.cost.size(); ++j) {
      bool is_in = false, is_nearly_in = false;
      for (std::uint32_t set = 0; set < (std::uint32_t{1} << cover.cost.size()); ++set) {
        if ((set >> j & 1U) == 0 || !reaches_all(cover, set)) continue;
        is_in = is_in || cost_of(cover, set) <= limit;
        is_nearly_in = is_nearly_in || cost_of(cover, set) <= limit + 1e-6;
      }
      ASSERT_TRUE(found.contains[j] || !is_in);
      ASSERT_TRUE(!found.contains[j] || is_nearly_in);
      excluded += is_in ? 0 : 1;
    }
  }
  EXPECT_GT(excluded, 500);
}

// Negative control: one row too many proves too much.
TEST(CoverTree, ARowThatIsNotRequiredRaisesTheBound) {
  test::RandomTables random(73);
  int too_much = 0;
  for (int repeat = 0; repeat < 100; ++repeat) {
    SmallCover cover = random_cover(random);
    const double least = min_cost(cover);
    cover.rows.push_back({static_cast<std::uint32_t>(cover.cost.size() - 1)});
    const FoundCovers found = cheapest_cover(cover, {}, least + 10, {{any_nodes}});
    too_much += found.bound > least + 1e-6 ? 1 : 0;
  }
  EXPECT_GT(too_much, 20);
}

}  // namespace
}  // namespace shelfbeam
