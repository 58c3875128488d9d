#include "shelfbeam/placement/tree/tree_search.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>

#include <gtest/gtest.h>

#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/tree/proof.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam::detail {
namespace {

using test::BruteForce;
using Columns = Selection;
using Kind = TreeGoal::Kind;
constexpr auto no_limit = std::numeric_limits<std::int64_t>::max();

// The result of enumeration for a goal.
struct Expected {
  std::vector<BruteForce::Answer> allowed;
  std::optional<std::int64_t> min_cost;
  std::optional<Columns> widest;

  Expected(const Instance& instance, const TreeGoal& goal)
      : Expected(instance, goal, BruteForce::answers(instance.table, instance.problem)) {}

  Expected(const Instance& instance, const TreeGoal& goal, std::vector<BruteForce::Answer> answers)
      : allowed(std::move(answers)) {
    std::erase_if(allowed, [&](const BruteForce::Answer& answer) {
      return answer.columns.size() > goal.max_units || instance.cost_of(answer.columns) > goal.max_cost;
    });
    const auto rank = [&](const BruteForce::Answer& answer) {
      return std::tuple(-answer.margin, answer.columns.size(),
                        BruteForce::ids(instance.table, answer.columns));
    };
    for (const auto& answer : allowed)
      min_cost = std::min(min_cost.value_or(no_limit), instance.cost_of(answer.columns));
    if (!allowed.empty())
      widest = std::min_element(allowed.begin(), allowed.end(), [&](const auto& a, const auto& b) {
                 return rank(a) < rank(b);
               })->columns;
  }
};

bool agrees(const Instance& instance, const TreeGoal& goal, const TreeResult& answer,
            const Expected& expected) {
  const auto is_allowed = [&] {
    return std::any_of(expected.allowed.begin(), expected.allowed.end(),
                       [&](const auto& one) { return one.columns == *answer.selected; });
  };
  if (!answer.is_complete || (answer.selected && !is_allowed())) return false;
  switch (goal.kind) {
    case Kind::any:
      return answer.selected.has_value() != expected.allowed.empty();
    case Kind::cheapest:
      return answer.selected ? instance.cost_of(*answer.selected) == expected.min_cost
                             : expected.allowed.empty();
    case Kind::widest:
      return answer.selected.value_or(goal.start) == expected.widest;
  }
  return false;
}

TreeResult search(const Instance& instance, const TreeGoal& goal, unsigned threads = 1) {
  const SearchMatrix all(instance);
  return TreeSearch(instance, all).run(goal, {.wants_proof = true}, {.threads = threads});
}

// A goal that is seldom trivial or impossible; `answers` are the selections of the whole problem.
TreeGoal random_goal(test::RandomTables& random, const Instance& instance,
                     const std::vector<BruteForce::Answer>& answers) {
  TreeGoal goal;
  goal.kind = static_cast<Kind>(random.whole(0, answers.empty() ? 1 : 2));
  const auto some = [&]() -> const BruteForce::Answer& {
    return answers[static_cast<std::size_t>(random.whole(0, static_cast<int>(answers.size()) - 1))];
  };
  const int n = static_cast<int>(instance.table.columns());
  goal.max_units = static_cast<std::size_t>(random.whole(0, n));
  if (!answers.empty() && random.chance(0.7)) {
    std::size_t fewest = answers.front().columns.size();
    for (const auto& answer : answers) fewest = std::min(fewest, answer.columns.size());
    goal.max_units =
        fewest + static_cast<std::size_t>(random.whole(0, 2)) - (random.chance(0.3) && fewest > 0);
  }
  if (!answers.empty() && random.chance(0.4)) goal.max_cost = instance.cost_of(some().columns);
  if (goal.kind == Kind::widest) {
    const BruteForce::Answer& start = some();
    goal.start = start.columns;
    goal.max_units = std::max(goal.max_units, start.columns.size());
    goal.max_cost = std::max(goal.max_cost, instance.cost_of(start.columns));
  }
  return goal;
}

struct Tally {
  int found = 0, proven = 0, checked = 0;
};

void run(std::uint64_t seed, int cases, const test::RandomTableLimits& limits) {
  test::RandomTables random(seed, limits);
  Tally tally;
  for (int k = 0; k < cases && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = random.next();
    const PlacementProblem problem = random.next_problem();
    const Instance instance(table, problem);
    const auto answers = BruteForce::answers(table, problem);
    const TreeGoal goal = random_goal(random, instance, answers);
    const TreeResult answer = search(instance, goal);
    EXPECT_TRUE(agrees(instance, goal, answer, Expected(instance, goal, answers)))
        << "kind " << static_cast<int>(goal.kind);
    (answer.selected ? tally.found : tally.proven) += 1;
    for (const unsigned threads : {2U, 4U})
      if (goal.kind == Kind::widest) {
        EXPECT_EQ(search(instance, goal, threads).selected, answer.selected);
      }
    if (goal.kind != Kind::widest && answer.proof.is_complete) {
      ++tally.checked;
      EXPECT_EQ(judge_proof({table, problem}, answer.proof), ProofVerdict::holds);
    }
  }
  EXPECT_GT(tally.found, cases / 5);
  EXPECT_GT(tally.proven, cases / 5);
  EXPECT_GT(tally.checked, cases / 5);
}

TEST(TreeSearch, EqualsEnumeration) {
  run(1, 2500, {.transceivers = 11});
  run(2, 2500, {.labels = 6, .transceivers = 11, .mounts = true, .conflicts = true, .redundant = true});
}

// More labels than a search begins with: most are alike, so that few matter and the others enter later.
TEST(TreeSearch, AddsRowsToASmallStart) {
  test::RandomTables random(5);
  int found = 0;
  for (int k = 0; k < 60 && !HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const std::size_t columns = 10;
    const double density = random.real(0.3, 1);
    std::vector<std::vector<double>> matrix(static_cast<std::size_t>(random.whole(200, 500)));
    for (auto& row : matrix) {
      row.assign(columns, 0.0);
      row[static_cast<std::size_t>(random.whole(0, 9))] = 1.2;
      for (double& entry : row)
        if (random.chance(density)) entry += 0.25 * random.whole(0, 4);
    }
    const SignalTable table = test::make_table(matrix, columns);
    PlacementProblem problem = random.next_problem();
    problem.redundant = random.chance(0.2);
    const Instance instance(table, problem);
    const auto answers = BruteForce::answers(table, problem);
    const TreeGoal goal = random_goal(random, instance, answers);
    const Expected expected(instance, goal, answers);
    const SearchMatrix all(instance);
    for (const std::size_t rows : {std::size_t{1}, std::size_t{0}}) {
      TreeSearch tree(instance, all);
      if (rows > 0) tree.begin_with(std::vector<LabelId>{7}, std::vector<double>{1.0});
      const TreeResult answer = tree.run(goal, {.wants_proof = true}, {.threads = 2});
      EXPECT_TRUE(agrees(instance, goal, answer, expected));
      found += answer.selected.has_value();
    }
  }
  EXPECT_GT(found, 20);
}

TEST(TreeSearch, ReportsTheLimitThatEndsIt) {
  test::RandomTables random(6);
  std::vector<std::vector<double>> matrix(60, std::vector<double>(60));
  for (auto& row : matrix)
    for (double& entry : row) entry = random.real(0, 0.3);
  const SignalTable table = test::make_table(matrix, 60);
  const PlacementProblem problem;
  const Instance instance(table, problem);
  const SearchMatrix all(instance);
  TreeGoal goal;
  goal.max_units = 7;
  const TreeResult few = TreeSearch(instance, all).run(goal, {{.steps = 100}}, {});
  EXPECT_FALSE(few.is_complete);
  EXPECT_LT(few.nodes, 1000U);
  CancelToken token;
  token.request();
  const TreeResult none = TreeSearch(instance, all).run(goal, {.wants_proof = true}, {.cancel = &token});
  EXPECT_FALSE(none.is_complete);
  EXPECT_FALSE(none.selected);
  EXPECT_FALSE(none.proof.is_complete);
  EXPECT_NE(judge_proof({table, problem}, none.proof), ProofVerdict::holds);
}

TEST(TreeSearch, FindsTheSameForAnyNumberOfThreadsWhereWorkLimitsIt) {
  test::RandomTables random(7);
  int complete = 0, open_and_found = 0, more_with_more_work = 0;
  for (int k = 0; k < 30 && !HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = test::scattered_table(random, 150, 40);
    const PlacementProblem problem;
    const Instance instance(table, problem);
    const SearchMatrix all(instance);
    TreeGoal goal;
    goal.kind = k % 3 == 0 ? Kind::any : k % 3 == 1 ? Kind::cheapest : Kind::widest;
    goal.max_units = static_cast<std::size_t>(random.whole(4, 6));
    const auto look = [&](std::uint64_t work, unsigned threads) {
      return TreeSearch(instance, all).run(goal, {.work = work}, {.threads = threads});
    };
    std::optional<double> margin;
    std::vector<float> memory;
    for (const std::uint64_t work : {300'000U, 3'000'000U, 30'000'000U}) {
      const TreeResult one = look(work, 1);
      for (const unsigned threads : {2U, 4U, 4U}) {
        const TreeResult more = look(work, threads);
        EXPECT_EQ(more.selected, one.selected);
        EXPECT_EQ(more.nodes, one.nodes);
        EXPECT_EQ(more.is_complete, one.is_complete);
      }
      complete += one.is_complete;
      open_and_found += !one.is_complete && one.selected.has_value();
      if (one.is_complete && goal.kind != Kind::any) {
        const TreeResult whole = search(instance, goal, 2);
        EXPECT_EQ(whole.selected.has_value(), one.selected.has_value());
        if (goal.kind == Kind::widest) {
          EXPECT_EQ(whole.selected, one.selected);
        }
      }
      if (goal.kind != Kind::widest || !one.selected) continue;
      const double now = margin_of({table, problem}, all, *one.selected, memory).smallest;
      if (margin) {
        EXPECT_GE(now, *margin);
        more_with_more_work += now > *margin;
      }
      margin = now;
    }
  }
  EXPECT_GT(complete, 10);
  EXPECT_GT(open_and_found, 3) << "searches that end early, where threads would tell";
  EXPECT_GT(more_with_more_work, 0);
}

// Signals far above every requirement: single precision no longer distinguishes them, but the result does.
TEST(TreeSearch, DistinguishesLargeMargins) {
  const SignalTable table = test::make_table({{3e6, 5e8, 0, 4e8}, {3e6, 2e6, 7e7, 4e8}}, 4);
  for (const auto model : {CommunicationModel::cooperative, CommunicationModel::non_cooperative}) {
    const PlacementProblem problem{model};
    const Instance instance(table, problem);
    for (const std::size_t units : {1U, 2U, 3U, 4U}) {
      TreeGoal goal;
      goal.kind = Kind::widest;
      goal.max_units = units;
      goal.start = {0};
      EXPECT_TRUE(agrees(instance, goal, search(instance, goal), Expected(instance, goal))) << units;
    }
  }
}

}  // namespace
}  // namespace shelfbeam::detail
