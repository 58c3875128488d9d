#include "shelfbeam/placement/windows/window_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "shelfbeam/placement/bound/lp_bound.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/random_table.hpp"
#include "unit/placement/windows/min_cost.hpp"

namespace shelfbeam {
namespace {

using detail::reduce_cover;
using detail::Reduction;
using detail::window_bound;
using detail::WindowBound;
using test::covering;

const milp::Backend& backend() {
  return milp::backends().front();
}

/// Labels at random points of a square hall, candidates on a grid of 1 m that reach discs.
SignalTable disc_cover(int side, double radius, std::uint64_t seed) {
  test::RandomTables random(seed);
  std::vector<std::vector<double>> matrix;
  for (int i = 0; i < 8 * side * side; ++i) {
    const double x = random.real(0, side), y = random.real(0, side);
    std::vector<double>& row = matrix.emplace_back();
    for (int a = 0; a <= side; ++a)
      for (int b = 0; b <= side; ++b) row.push_back(std::hypot(x - a, y - b) <= radius ? 1 : 0);
  }
  return test::make_table(matrix, matrix.front().size());
}

// Mounting points, pairs, installed units and any costs.
TEST(WindowBound, NeverExceedsTheMinimum) {
  test::RandomTables random(74, {.labels = 12, .transceivers = 9, .mounts = true, .conflicts = true});
  int compared = 0, tight = 0;
  for (int repeat = 0; repeat < 800; ++repeat) {
    const SignalTable table = random.next();
    std::vector<double> cost(table.columns(), 1.0);
    for (double& c : cost) c = repeat % 2 == 0 ? 1 : random.chance(0.1) ? 0 : random.real(0, 3);
    const double minimum = test::min_cost(table, covering, cost);
    std::vector<bool> pinned(table.columns(), false);
    for (const auto& [a, b] : table.conflicts) pinned[a] = pinned[b] = true;
    const Reduction reduction = reduce_cover({table, covering}, cost, pinned);
    if (!std::isfinite(minimum) || reduction.infeasible) continue;
    const auto windows = static_cast<std::size_t>(random.whole(1, 4));
    const WindowBound found =
        window_bound({table, covering}, cost, reduction,
                     {.known = minimum, .effort = {.steps = 200'000}, .windows = windows}, backend(), {}, {});
    ASSERT_LE(found.bound, minimum);
    ++compared;
    tight += found.bound > minimum - 1e-6 * (1 + minimum) ? 1 : 0;
  }
  EXPECT_GT(compared, 100);
  EXPECT_GT(tight, compared / 2);
}

TEST(WindowBound, ExceedsTheLpOnDiscs) {
  const SignalTable table = disc_cover(10, 2.1, 75);
  const std::vector<double> cost(table.columns(), 1.0);
  const double lp = detail::lp_bound({table, covering}, cost, backend(), {}, {}).dual.bound;
  const Reduction reduction = reduce_cover({table, covering}, cost);
  std::vector<double> bounds;
  for (const unsigned threads : {1U, 2U}) {
    double fewest = 1e6;
    const auto heuristic = [&](const Selection& selected) {
      EXPECT_TRUE(check_selection(table, covering, selected).met());
      fewest = std::min(fewest, static_cast<double>(selected.size()));
      return fewest;
    };
    bounds.push_back(window_bound({table, covering}, cost, reduction,
                                  {.known = 15, .effort = {.steps = 1'000'000}, .windows = 2}, backend(),
                                  heuristic, {.threads = threads})
                         .bound);
    EXPECT_EQ(std::ceil(bounds.back()), fewest);  // proven optimal
  }
  EXPECT_LT(lp, 11);
  EXPECT_GT(bounds[0], lp + 0.35);
  EXPECT_EQ(bounds[0], bounds[1]);
}

// Columns that no selection of the sought count contains are excluded.
TEST(WindowBound, ExclusionsKeepBetterSelections) {
  test::RandomTables random(78);
  int proven = 0, excluded = 0;
  for (int repeat = 0; repeat < 100; ++repeat) {
    std::vector<std::vector<double>> matrix(12, std::vector<double>(10, 0.0));
    for (auto& row : matrix)
      for (double& a : row) a = random.chance(0.25) ? 1 : 0;
    const SignalTable table = test::make_table(matrix, 10);
    const std::vector<double> cost(10, 1.0);
    const double minimum = test::min_cost(table, covering, cost);
    if (!std::isfinite(minimum)) continue;
    // Without column dominance, so that some rows and columns are left.
    const Reduction reduction = reduce_cover({table, covering}, cost, std::vector<bool>(10, true));
    const auto found = [&](double known) {
      return window_bound({table, covering}, cost, reduction,
                          {.known = known, .step = 1, .effort = {.steps = 400'000}, .windows = 3}, backend(),
                          {}, {});
    };
    const WindowBound of_more = found(minimum + 1);
    ASSERT_LE(of_more.bound, minimum);
    for (const std::uint32_t j : of_more.useless) {
      std::vector<double> with_j = cost;
      with_j[j] -= 100;
      ASSERT_GT(test::min_cost(table, covering, with_j) + 100, minimum);
      ++excluded;
    }
    proven += found(minimum).bound > minimum - 1 ? 1 : 0;
  }
  EXPECT_GT(excluded, 20);
  EXPECT_GT(proven, 40);
}

// Negative control: if a label that a minimum selection misses is added, the bound proves too much.
TEST(WindowBound, AnotherLabelRaisesTheBound) {
  test::RandomTables random(76);
  int too_much = 0;
  for (int repeat = 0; repeat < 60; ++repeat) {
    std::vector<std::vector<double>> matrix(8, std::vector<double>(8, 0.0));
    for (auto& row : matrix)
      for (double& a : row) a = random.chance(0.4) ? 1 : 0;
    const std::vector<double> cost(8, 1.0);
    const double minimum = test::min_cost(test::make_table(matrix, 8), covering, cost);
    std::vector<double> row(8, 0.0);
    row[static_cast<std::size_t>(random.whole(0, 7))] = 1;
    matrix.push_back(row);
    const SignalTable table = test::make_table(matrix, 8);
    const Reduction reduction = reduce_cover({table, covering}, cost);
    if (reduction.infeasible || !std::isfinite(minimum)) continue;
    too_much +=
        window_bound({table, covering}, cost, reduction,
                     {.known = minimum, .effort = {.steps = 200'000}, .windows = 2}, backend(), {}, {})
                    .bound > minimum + 1e-6
            ? 1
            : 0;
  }
  EXPECT_GT(too_much, 10);
}

}  // namespace
}  // namespace shelfbeam
