#include "shelfbeam/plan/bound_rows.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

// The rows found need as many units as all rows, and are not claimed to need more.
TEST(CoreRows, ForceTheCountOfAllRows) {
  test::RandomTables random(3, {.labels = 60, .transceivers = 14, .borderline = false, .redundant = true});
  const PlaceOptions by_steps{.step_limit = 1 << 20, .settles_ties = false};
  int sufficient = 0, fewer = 0;
  for (int k = 0; k < 150; ++k) {
    const SignalTable table = random.next();
    PlacementProblem problem;
    problem.model =
        random.chance(0.5) ? CommunicationModel::cooperative : CommunicationModel::non_cooperative;
    problem.redundant = random.chance(0.3);
    const Placement all = place(table, problem, by_steps);
    if (all.status != Status::optimal || all.count() < 2) continue;
    const BoundGoal goal = bound_goal(table, all);
    const auto count = static_cast<double>(all.count());
    const CoreRows decisive = core_rows(table, goal, count, by_steps, {});
    EXPECT_TRUE(decisive.suffice);
    EXPECT_TRUE(std::is_sorted(decisive.rows.begin(), decisive.rows.end()));
    EXPECT_EQ(std::adjacent_find(decisive.rows.begin(), decisive.rows.end()), decisive.rows.end());
    const Placement some = place(table_of_rows(table, decisive.rows), problem, by_steps);
    EXPECT_EQ(some.count(), all.count());
    EXPECT_FALSE(core_rows(table, goal, count + 1, by_steps, {}).suffice) << "more is not to be had";
    const CoreRows hurried = core_rows(table, goal, count, {.time_limit_s = 0}, {});
    EXPECT_TRUE(std::is_sorted(hurried.rows.begin(), hurried.rows.end()));
    EXPECT_FALSE(hurried.suffice) << "nothing was asked";
    ++sufficient;
    fewer += decisive.rows.size() < table.rows();
  }
  EXPECT_GT(sufficient, 40);
  EXPECT_GT(fewer, sufficient / 3);
}

}  // namespace
}  // namespace shelfbeam
