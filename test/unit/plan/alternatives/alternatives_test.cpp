#include "shelfbeam/plan/alternatives/alternatives.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/plan/io/alternatives_json.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

// Enumeration confirms the figures of every alternative and its claims of proof.
TEST(Alternatives, AgreeWithEnumeration) {
  test::RandomTables random(
      17, {.labels = 9, .transceivers = 10, .borderline = false, .mounts = true, .conflicts = true});
  int fewer = 0, more = 0, secure = 0;
  for (int k = 0; k < 300; ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = random.next();
    PlacementProblem problem = random.next_problem();
    problem.objective = Objective::count;
    problem.combination = Combination::automatic;
    const Placement placement = place(table, problem, {}, {.threads = 1});
    const Alternatives others = alternatives_to(placement, table);
    if (!placement.has_selection()) {
      EXPECT_TRUE(others.empty());
      continue;
    }
    if (const auto& one = others.one_fewer) {
      ++fewer;
      const auto best = test::BruteForce::budgets(table, placement.problem)[placement.count() - 1];
      ASSERT_TRUE(best);
      EXPECT_LE(one->selected.size(), placement.count() - 1);
      EXPECT_LE(one->reached, best->reached);
      EXPECT_GE(one->max_reached, best->reached);
      EXPECT_EQ(one->is_proven, one->reached == one->max_reached);
    }
    if (const auto& one = others.one_more) {
      ++more;
      double widest = 0;
      for (std::uint32_t j = 0; j < table.columns(); ++j) {
        Selection with = placement.selected;
        if (std::binary_search(with.begin(), with.end(), j)) continue;
        with.insert(std::upper_bound(with.begin(), with.end(), j), j);
        if (check_selection(table, placement.problem, with).allowed())
          widest = std::max(widest, evaluate(table, placement.problem, with).smallest_margin);
      }
      EXPECT_DOUBLE_EQ(one->smallest_margin, widest);
      EXPECT_EQ(one->selected.size(), placement.count() + 1);
      EXPECT_EQ(one->reached, table.rows());
    }
    PlacementProblem redundant = placement.problem;
    redundant.redundant = true;
    if (others.cannot_survive) {
      EXPECT_TRUE(test::BruteForce::answers(table, redundant).empty());
    }
    if (const auto& one = others.survives_failure) {
      ++secure;
      EXPECT_EQ(one->secure, table.rows());
      EXPECT_TRUE(check_selection(table, redundant, one->selected).met());
      if (one->is_proven) {
        EXPECT_EQ(one->selected.size(), place(table, redundant, {}, {.threads = 1}).count());
      }
    }
    // The figures do not depend on the number of threads, and files keep them.
    const auto text = [&](const Alternatives& of) { return detail::Record::write(of, {table}).dump(); };
    EXPECT_EQ(text(alternatives_to(placement, table, {.threads = 4})), text(others));
    EXPECT_EQ(text(detail::Record::read<Alternatives>(JsonCursor::parse(text(others), "x.json"), {table})),
              text(others));
  }
  EXPECT_GT(fewer, 50);
  EXPECT_GT(more, 50);
  EXPECT_GT(secure, 20);
}

TEST(Alternatives, HaveNoUnitFewerThanThoseInstalled) {
  SignalTable table = test::make_table({{1, 0.5}, {1, 0.5}}, 2);
  table.transceivers[0].installed = true;
  const Placement placement = place(table, {}, {});
  const Alternatives others = alternatives_to(placement, table);
  EXPECT_FALSE(others.one_fewer);
  ASSERT_TRUE(others.one_more);
  EXPECT_DOUBLE_EQ(others.one_more->smallest_margin, 1.5);
  EXPECT_FALSE(others.survives_failure);
  EXPECT_TRUE(others.cannot_survive);
}

TEST(Alternatives, AreInterrupted) {
  const SignalTable table = test::dense_table(40, 30);
  const Placement placement = place(table, {}, {.time_limit_s = 1});
  CancelToken cancel;
  cancel.request();
  EXPECT_FALSE(alternatives_to(placement, table, {.cancel = &cancel}).survives_failure);
}

}  // namespace
}  // namespace shelfbeam
