#include "shelfbeam/placement/curve.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "shelfbeam/placement/checker.hpp"
#include "shelfbeam/placement/critical.hpp"
#include "shelfbeam/placement/placement.hpp"
#include "shelfbeam/placement/placement_file.hpp"
#include "shelfbeam/placement/reach_bound.hpp"

#include "brute_force.hpp"
#include "random_table.hpp"

namespace shelfbeam {
namespace {

using test::BruteForce;

constexpr test::RandomTableLimits everything{
    .labels = 8, .transceivers = 10, .mounts = true, .apart = true, .redundant = true};

// What single units reach bounds what two reach: 4 and 3 of 6 labels, though 7 together.
TEST(ReachBound, ByHand) {
  const SignalTable table =
      test::make_table({{1, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 1, 1}, {0, 1, 1}, {0, 1, 0}}, 3);
  const Question question{CommunicationModel::non_cooperative};
  ReachBound bound(table, question, 2);
  EXPECT_EQ(bound.labels(1), 6U) << "nothing is known yet";
  bound.improve(1, 4, 1, {});
  EXPECT_EQ(bound.labels(1), 4U) << "one step with all multipliers 1";
  EXPECT_EQ(bound.labels(2), 6U);
}

// Valid for every number of units after any number of steps towards any of them; tight often, not always.
TEST(ReachBound, HoldsWhateverTheStepsWere) {
  test::RandomTables tables(81, everything);
  int tight = 0, loose = 0, all = 0;
  for (int k = 0; k < 3000; ++k) {
    const SignalTable table = tables.next();
    const Question question = tables.next_question();
    const auto best = BruteForce::budgets(table, question);
    ReachBound bound(table, question, table.columns());
    for (int times = tables.whole(1, 3); times > 0; --times) {
      const auto units = static_cast<std::size_t>(tables.whole(0, static_cast<int>(table.columns())));
      if (!best[units]) continue;
      bound.improve(units, tables.chance(0.5) ? best[units]->reached : 0,
                    static_cast<std::size_t>(tables.whole(0, 60)), {});
    }
    for (std::size_t units = 0; units < best.size(); ++units) {
      if (!best[units]) continue;
      ASSERT_GE(bound.labels(units), best[units]->reached) << k << " with " << units;
      ++all;
      tight += bound.labels(units) == best[units]->reached;
      loose += bound.labels(units) > best[units]->reached;
    }
  }
  EXPECT_GT(tight, all / 2);
  EXPECT_GT(loose, all / 100);
}

TEST(PlacementCurve, EnclosesTheBestForEveryNumber) {
  test::RandomTables tables(82, everything);
  int points = 0, lower_is_best = 0, upper_is_best = 0, below = 0;
  for (int k = 0; k < 6000; ++k) {
    const SignalTable table = tables.next();
    const Question question = tables.next_question();
    const BruteForce brute(table, question);
    if (!brute.feasible) continue;
    std::vector<std::uint32_t> selected;
    std::size_t first = 0;
    for (std::uint32_t j = 0; j < table.columns(); ++j) {
      if ((brute.set_at_fewest >> j & 1U) != 0) selected.push_back(j);
      first += table.transceivers[j].installed ? 1 : 0;
    }
    const auto best = BruteForce::budgets(table, question);
    const std::vector<CurvePoint> curve = reach_curve(table, question, selected);
    first = std::max<std::size_t>(1, first);
    ASSERT_EQ(curve.size(), selected.size() < first ? 0 : selected.size() - first + 1);
    for (std::size_t p = 0; p < curve.size(); ++p) {
      ASSERT_EQ(curve[p].units, first + p);
      const std::size_t reached = best[curve[p].units]->reached;
      ASSERT_LE(curve[p].at_least, reached) << k;
      ASSERT_GE(curve[p].at_most, reached) << k;
      ASSERT_TRUE(p == 0 ||
                  (curve[p].at_least >= curve[p - 1].at_least && curve[p].at_most >= curve[p - 1].at_most));
      ++points;
      lower_is_best += curve[p].at_least == reached;
      upper_is_best += curve[p].at_most == reached;
      below += curve[p].at_least < reached;
    }
    if (!curve.empty()) {
      ASSERT_EQ(curve.back().at_least, table.rows());
    }
  }
  EXPECT_GT(points, 2000);
  EXPECT_GT(lower_is_best, points * 9 / 10);
  EXPECT_GT(upper_is_best, points / 2);
  EXPECT_GT(below, 0);
}

// Against leaving out one unit after the other.
TEST(Critical, AreTheLabelsThatHangOnOneUnit) {
  test::RandomTables tables(83, {.redundant = true});
  int some = 0, none_where_one_may_fail = 0;
  for (int k = 0; k < 3000; ++k) {
    const SignalTable table = tables.next();
    const Question question = tables.next_question();
    std::vector<std::uint32_t> selected;
    for (std::uint32_t j = 0; j < table.columns(); ++j)
      if (tables.chance(0.5)) selected.push_back(j);
    Question nothing_fails = question;
    nothing_fails.redundant = false;
    const Check with_all = check_selection(table, nothing_fails, selected);
    const auto critical = critical_units(table, question, selected);
    ASSERT_EQ(critical.size(), selected.size());
    std::size_t labels = 0;
    for (std::size_t s = 0; s < selected.size(); ++s) {
      std::vector<std::uint32_t> others = selected, expected;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(s));
      const Check without = check_selection(table, nothing_fails, others);
      std::set_difference(without.unmet.begin(), without.unmet.end(), with_all.unmet.begin(),
                          with_all.unmet.end(), std::back_inserter(expected));
      EXPECT_EQ(critical[s].unit, selected[s]);
      ASSERT_EQ(critical[s].labels, expected) << k;
      labels += expected.size();
    }
    some += labels > 0;
    if (question.redundant && check_selection(table, question, selected).met()) {
      EXPECT_EQ(labels, 0U);
      ++none_where_one_may_fail;
    }
  }
  EXPECT_GT(some, 1000);
  EXPECT_GT(none_where_one_may_fail, 100);
}

TEST(PlacementCurve, IsWritten) {
  const SignalTable table = test::make_table({{1, 0}, {1, 0}, {0, 1}}, 2);
  const Placement found = place(table, {}, {});
  const std::string json = placement_json(found, table, reach_curve(table, {}, found.selected));
  const auto expect = [&](const std::string& part) {
    std::string flat = json;
    std::erase_if(flat, [](char c) { return c == ' ' || c == '\n'; });
    EXPECT_NE(flat.find(part), std::string::npos) << part << flat;
  };
  expect(R"("curve":[{"units":1,"at_least":2,"at_most":2},{"units":2,"at_least":3,"at_most":3}])");
  expect(
      R"("critical":[{"unit":"T0","count":2,"labels":["L0","L1"]},{"unit":"T1","count":1,"labels":["L2"]}])");
}

}  // namespace
}  // namespace shelfbeam
