#include "shelfbeam/placement/problem/mounts.hpp"

#include <gtest/gtest.h>

#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

using test::alone;
using test::coop;

TEST(Mounts, KnowAllConflicts) {
  SignalTable table = test::make_table({{0.5, 0.75, 0.25, 1, 2}}, 5);
  table.mounts = {{1, 3}, {2, 4}};
  table.transceivers[2].installed = true;
  const Mounts mounts(table);
  EXPECT_TRUE(mounts.options(0).empty());
  EXPECT_EQ(mounts.options(3).size(), 2U);
  EXPECT_EQ(mounts.options(3)[0], 1U);
  for (const std::uint32_t j : {0U, 1U, 2U, 3U}) EXPECT_TRUE(mounts.available(j)) << j;
  EXPECT_FALSE(mounts.available(4));
  EXPECT_EQ(mounts.max_signal(table.row(0), {coop}), 0.5 + 1 + 0.25);
  EXPECT_EQ(mounts.max_signal(table.row(0), {alone}), 1);
  EXPECT_EQ(table.mounting_points(), 3U);
  EXPECT_EQ(shared_mounts(table, {true, true, true, false, true}), std::vector<std::uint32_t>{1});
}

TEST(Mounts, KnowTheConflictsOfAPair) {
  SignalTable table = test::make_table({{0.5, 0.75, 0.25, 1, 2}}, 5);
  table.mounts = {{1, 3}};
  table.conflicts = {{0, 2}, {0, 4}, {1, 2}};
  table.transceivers[4].installed = true;
  const Mounts mounts(table);
  EXPECT_EQ(mounts.partners(0).size(), 2U);
  Selection excluded;
  mounts.for_each_conflict(1, [&](std::uint32_t j) { excluded.push_back(j); });
  EXPECT_EQ(excluded, (Selection{3, 2}));
  EXPECT_FALSE(mounts.available(0)) << "an installed unit is too near";
  EXPECT_TRUE(mounts.available(2));
  EXPECT_EQ(mounts.max_signal(table.row(0), {coop}), 0.25 + 1 + 2);
  EXPECT_EQ(mounts.max_signal(table.row(0), {.model = coop, .redundant = true}), 0.25 + 1);
  EXPECT_EQ(mounts.max_signal(table.row(0), {.model = alone, .redundant = true}), 1);
  EXPECT_EQ(conflicting_pairs(table, {true, true, true, false, false}), (std::vector<std::uint32_t>{0, 2}));
}

}  // namespace
}  // namespace shelfbeam
