#include "shelfbeam/placement/problem/checker.hpp"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

#include "shelfbeam/placement/heuristic/greedy.hpp"

#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

using Columns = Selection;
using Labels = std::vector<LabelId>;
using Numbers = std::vector<std::uint32_t>;
using test::alone;
using test::coop;

SignalTable four_units() {
  SignalTable table =
      test::make_table({{0.5, 0.5, 0.0, 2.0}, {0.0, 1.0, 0.75, 0.0}, {0.25, 0.0, 1.5, 0.0}}, 4);
  for (std::size_t j = 0; j < 4; ++j) table.transceivers[j].cost = static_cast<double>(j + 1);
  for (auto& label : table.labels) label.link_cost = 1, label.signal_cost = 10;
  table.labels[2].link_cost = 100;
  return table;
}

TEST(PlacementChecker, AddsSignalsWhereUnitsCooperate) {
  const Check check = check_selection(four_units(), {coop, Objective::signal}, Columns{0, 1, 2});
  EXPECT_TRUE(check.met());
  EXPECT_EQ(check.signal, (std::vector<double>{1.0, 1.75, 1.75}));
  EXPECT_EQ(check.serving, (Numbers{0, 1, 1}));
  EXPECT_EQ(check.transceiver_cost, 6);
  EXPECT_EQ(check.objective, 45);
}

TEST(PlacementChecker, UsesTheLargestSignalIfUnitsDoNotCooperate) {
  const Check check = check_selection(four_units(), {alone, Objective::links}, Columns{2, 1, 0});
  EXPECT_EQ(check.unmet, Labels{0});
  EXPECT_EQ(check.signal, (std::vector<double>{0.5, 1.0, 1.5}));
  EXPECT_EQ(check.objective, 101);
  EXPECT_TRUE(check_selection(four_units(), {alone}, Columns{1, 2, 3}).met());
}

TEST(PlacementChecker, ComputesEveryObjective) {
  const auto value = [](CommunicationModel model, Objective objective, double share) {
    return check_selection(four_units(), {model, objective, Combination::weighted, share}, Columns{1, 2})
        .objective;
  };
  EXPECT_EQ(value(coop, Objective::count, 1), 0);
  EXPECT_EQ(value(coop, Objective::links, 1), 2 * 102);
  EXPECT_EQ(value(alone, Objective::links, 1), 101);
  EXPECT_EQ(value(coop, Objective::effective_links, 0.5), 1 + 2 + 100);
  EXPECT_EQ(value(alone, Objective::signal, 1), 37.5);
}

TEST(PlacementChecker, RemovesTheStrongestUnitIfOneMayFail) {
  Check check = check_selection(four_units(), {.model = coop, .redundant = true}, Columns{0, 1, 2, 3});
  EXPECT_EQ(check.signal, (std::vector<double>{1.0, 0.75, 0.25}));
  EXPECT_EQ(check.unmet, (Labels{1, 2}));
  check = check_selection(four_units(), {.model = alone, .redundant = true}, Columns{0, 1, 3});
  EXPECT_EQ(check.signal, (std::vector<double>{0.5, 0.0, 0.0}));
  // A failing signal of any size leaves the others unchanged to the last bit.
  const SignalTable table = test::make_table({{0.5, 1e30, 0.5}}, 3);
  EXPECT_EQ(check_selection(table, {.redundant = true}, Columns{0, 1, 2}).signal[0], 1.0);
  EXPECT_FALSE(check_selection(table, {.redundant = true}, Columns{1}).met());
}

TEST(PlacementChecker, AppliesTheToleranceOfTheContract) {
  SignalTable table = test::make_table({{0.5, 0.5 - 0.9e-9}}, 2);
  EXPECT_TRUE(check_selection(table, {coop}, Columns{0, 1}).met());
  table.entries[1].signal = 0.5 - 1.1e-9;
  EXPECT_FALSE(check_selection(table, {coop}, Columns{0, 1}).met());
}

TEST(PlacementChecker, NamesViolatedPointsAndPairs) {
  SignalTable table = four_units();
  table.mounts = {{0, 2}, {1, 3}};
  EXPECT_TRUE(check_selection(table, {coop}, Columns{2, 3, 3}).crowded.empty());
  Check check = check_selection(table, {coop}, Columns{0, 1, 2});
  EXPECT_TRUE(check.unmet.empty());
  EXPECT_EQ(check.crowded, Numbers{0});
  EXPECT_FALSE(check.met());
  check = check_selection(table, {alone}, Columns{0, 1, 2, 3});
  EXPECT_EQ(check.crowded, (Numbers{0, 1}));
  EXPECT_FALSE(check.met());
  table.mounts.clear();
  table.conflicts = {{0, 2}, {1, 3}};
  check = check_selection(table, {coop}, Columns{0, 1, 2});
  EXPECT_TRUE(check.unmet.empty());
  EXPECT_EQ(check.too_close, Numbers{0});
  EXPECT_FALSE(check.allowed() || check.met());
}

TEST(PlacementChecker, CountsARepeatedColumnOnce) {
  EXPECT_EQ(check_selection(four_units(), {coop}, Columns{0, 0}).unmet, (Labels{0, 1, 2}));
  EXPECT_THROW(check_selection(four_units(), {coop}, Columns{4}), std::out_of_range);
}

TEST(PlacementChecker, HandlesTablesWithoutLabelsOrUnits) {
  EXPECT_TRUE(check_selection(test::make_table({}, 2), {coop}, Columns{}).met());
  EXPECT_FALSE(check_selection(test::make_table({{}}, 0), {coop}, Columns{}).met());
  EXPECT_FALSE(check_selection(test::make_table({{}}, 0), {alone}, Columns{}).met());
}

// Removes a unit that some label requires; the checker must report exactly the missed labels, which the test
// recomputes from the dense definition.
TEST(PlacementChecker, RejectsBrokenSelections) {
  test::RandomTables tables(5);
  int broken = 0;
  for (int k = 0; k < 1000; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    const Columns whole = greedy_selection({table, problem});
    if (whole.empty() || !check_selection(table, problem, whole).met()) continue;
    for (const std::uint32_t removed : whole) {
      Columns rest = whole;
      std::erase(rest, removed);
      Labels expected;
      for (std::uint32_t i = 0; i < table.rows(); ++i) {
        double sum = 0, largest = 0;
        for (const SignalEntry& entry : table.row(i)) {
          const bool in = std::find(rest.begin(), rest.end(), entry.transceiver) != rest.end();
          sum += in ? entry.signal : 0;
          largest = std::max(largest, in ? entry.signal : 0);
        }
        const bool met = problem.model == coop ? sum >= table.labels[i].requirement * (1 - 1e-9)
                                               : largest >= table.labels[i].single_requirement * (1 - 1e-9);
        if (!met) expected.push_back(i);
      }
      broken += !expected.empty();
      EXPECT_EQ(check_selection(table, problem, rest).unmet, expected);
    }
  }
  EXPECT_GT(broken, 1000);
}

}  // namespace
}  // namespace shelfbeam
