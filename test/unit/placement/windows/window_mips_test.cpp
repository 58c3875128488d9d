#include "shelfbeam/placement/windows/window_mips.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/random_table.hpp"
#include "unit/placement/windows/min_cost.hpp"

namespace shelfbeam {
namespace {

using detail::window_mip_bound;
using detail::WindowMipOptions;

const PlacementProblem sums{.model = CommunicationModel::cooperative};

double bound_of(const SignalTable& table, const PlacementProblem& problem, const std::vector<double>& cost,
                WindowMipOptions options, unsigned threads = 1) {
  options.effort.until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  return window_mip_bound({table, problem}, cost, options, milp::backends().front(), {.threads = threads});
}

std::vector<double> random_costs(test::RandomTables& random, std::size_t columns, bool is_count) {
  std::vector<double> cost(columns, 1.0);
  for (double& c : cost)
    if (!is_count) c = random.chance(0.1) ? 0 : random.real(0, 3);
  return cost;
}

// Both models, mounting points, pairs, installed units and any costs.
TEST(WindowMips, NeverExceedTheMinimum) {
  test::RandomTables random(91, {.labels = 12, .transceivers = 8, .mounts = true, .conflicts = true});
  int compared = 0, tight = 0;
  for (int repeat = 0; repeat < 800; ++repeat) {
    const SignalTable table = random.next();
    const PlacementProblem& problem = repeat % 3 == 0 ? test::covering : sums;
    const std::vector<double> cost = random_costs(random, table.columns(), repeat % 2 == 0);
    const double minimum = test::min_cost(table, problem, cost);
    if (!std::isfinite(minimum)) continue;
    const auto windows = static_cast<std::size_t>(random.whole(1, 4));
    const double goal = minimum * random.real(0.9, 1.5);
    const double bound = bound_of(table, problem, cost, {.goal = goal, .windows = windows});
    ASSERT_LE(bound, minimum * (1 + 1e-12));
    ASSERT_LE(bound, goal);
    ++compared;
    tight += bound > std::min(goal, minimum) - 1e-3 * minimum ? 1 : 0;
  }
  EXPECT_GT(compared, 100);
  EXPECT_GT(tight, compared / 2);
}

TEST(WindowMips, OneWindowGivesTheMinimum) {
  test::RandomTables random(92);
  for (int repeat = 0; repeat < 30; ++repeat) {
    const SignalTable table = test::scattered_table(random, 20, 10, 0.2);
    const std::vector<double> cost = random_costs(random, table.columns(), repeat % 2 == 0);
    const double minimum = test::min_cost(table, sums, cost);
    if (!std::isfinite(minimum)) continue;
    const double bound = bound_of(table, sums, cost, {.goal = 2 * minimum + 1, .windows = 1});
    ASSERT_LE(bound, minimum * (1 + 1e-12));
    ASSERT_GT(bound, minimum * (1 - 1e-3) - 1e-6);
  }
}

TEST(WindowMips, ReachTheSameBoundOnAnyNumberOfThreads) {
  test::RandomTables random(93);
  const SignalTable table = test::scattered_table(random, 60, 30);
  const std::vector<double> cost(table.columns(), 1.0);
  const WindowMipOptions options{.goal = 100, .effort = {.steps = 20}, .windows = 3};
  EXPECT_EQ(bound_of(table, sums, cost, options, 1), bound_of(table, sums, cost, options, 2));
}

// Selections without a column that every cheap one needs cost more.
TEST(WindowMips, BoundSelectionsWithoutSomeColumns) {
  test::RandomTables random(94);
  int more = 0;
  for (int repeat = 0; repeat < 20; ++repeat) {
    const SignalTable table = test::scattered_table(random, 20, 10, 0.2);
    std::vector<double> cost(table.columns(), 1.0);
    const double all = test::min_cost(table, sums, cost);
    cost[0] = 1000;
    const double without = test::min_cost(table, sums, cost);
    cost[0] = 1;
    if (!(without < 1000)) continue;
    const double bound = bound_of(table, sums, cost, {.goal = 100, .windows = 1, .without = {0}});
    ASSERT_LE(bound, without * (1 + 1e-12));
    more += bound > all + 0.5 ? 1 : 0;
  }
  EXPECT_GT(more, 0);
}

// Negative control: the bound of another problem, with one more label, is often too large for this one.
TEST(WindowMips, AnotherLabelRaisesTheBound) {
  test::RandomTables random(95);
  int too_much = 0;
  for (int repeat = 0; repeat < 100; ++repeat) {
    std::vector<std::vector<double>> matrix(8, std::vector<double>(8));
    for (auto& row : matrix)
      for (double& a : row) a = random.real(0, 0.6);
    const std::vector<double> cost(8, 1.0);
    const double minimum = test::min_cost(test::make_table(matrix, 8), sums, cost);
    std::vector<double> row(8, 0.0);
    row[static_cast<std::size_t>(random.whole(0, 7))] = 1;
    matrix.push_back(row);
    if (!std::isfinite(minimum)) continue;
    const double bound = bound_of(test::make_table(matrix, 8), sums, cost, {.goal = 100, .windows = 2});
    too_much += bound > minimum + 1e-6 ? 1 : 0;
  }
  EXPECT_GT(too_much, 5);
}

}  // namespace
}  // namespace shelfbeam
