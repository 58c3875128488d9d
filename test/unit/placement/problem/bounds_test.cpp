#include "shelfbeam/placement/problem/bounds.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

// Compares both bounds with enumeration; with one unit more, the same bounds must sometimes be wrong.
TEST(PlacementBounds, HoldForEverySelection) {
  test::RandomTables plain(3), with_options(4, {.mounts = true});
  int tight = 0;
  for (int k = 0; k < 2000; ++k) {
    test::RandomTables& tables = k % 2 == 0 ? plain : with_options;
    const SignalTable table = tables.next();
    PlacementProblem problem = tables.next_problem();
    problem.combination = Combination::weighted;
    const test::BruteForce brute(table, problem);
    if (!brute.feasible) continue;
    const std::size_t count = detail::Instance(table, problem).trivial_count_bound();
    EXPECT_LE(count, brute.fewest);
    tight += count == brute.fewest;

    const std::vector<double> cost = detail::Instance(table, problem).first_cost;
    const CostBounds bounds(table, cost);
    const double slack = 1e-12 * brute.best_sum;
    EXPECT_LE(bounds.cheapest(brute.fewest), brute.best_sum + slack);
    EXPECT_LE(bounds.fewest(brute.best_sum), brute.fewest);
    const CostBounds second(table, objective_coefficients(table, problem));
    EXPECT_LE(second.cheapest(brute.fewest), brute.best_at_fewest * (1 + 1e-12));
  }
  EXPECT_GT(tight, 50);
}

TEST(PlacementBounds, AlwaysIncludeInstalledUnits) {
  SignalTable table = test::make_table({{1, 1, 1, 1}}, 4);
  table.transceivers[1].installed = true;
  const std::vector<double> cost = {5, 10, 1, 2};
  const CostBounds bounds(table, cost);
  EXPECT_EQ(bounds.cheapest(0), 10);
  EXPECT_EQ(bounds.cheapest(1), 10);
  EXPECT_EQ(bounds.cheapest(3), 13);
  EXPECT_EQ(bounds.cheapest(9), 18);
  EXPECT_EQ(bounds.fewest(10), 1U);
  EXPECT_EQ(bounds.fewest(10.1), 2U);
  EXPECT_EQ(bounds.fewest(15.1), 3U);
  EXPECT_EQ(detail::Instance(table, {}).trivial_count_bound(), 1U);
  table.entries[1].signal = 0.5;
  EXPECT_EQ(detail::Instance(table, {}).trivial_count_bound(), 2U);
}

TEST(PlacementBounds, RoundUpToTheStepOfCosts) {
  const SignalTable table = test::make_table({}, 2);
  const CostBounds whole(table, std::vector<double>{1, 2});
  EXPECT_EQ(whole.rounded(4.3), 5);
  EXPECT_EQ(whole.rounded(4.0000001), 4);  // within a solver's tolerance
  EXPECT_EQ(whole.rounded(4.00001), 5);
  EXPECT_EQ(whole.rounded(3.9999999), 4);
  EXPECT_EQ(whole.rounded(-INFINITY), -INFINITY);
  EXPECT_EQ(whole.rounded(1e7 + 0.25), 1e7 + 0.25);  // bounds are not accurate enough there
  EXPECT_NEAR(whole.below(5), 4, 1e-6);
  const CostBounds halves(table, std::vector<double>{1, 2.5});
  EXPECT_EQ(halves.step(), 0.5);
  EXPECT_EQ(halves.rounded(4.3), 4.5);
  EXPECT_NEAR(halves.below(5), 4.5, 1e-6);
  const CostBounds real(table, std::vector<double>{1, std::sqrt(2)});
  EXPECT_EQ(real.step(), 0);
  EXPECT_EQ(real.rounded(4.3), 4.3);
  EXPECT_LT(real.below(5), 5);
  EXPECT_GT(real.below(5), 5 - 1e-8);
  const CostBounds vast(table, std::vector<double>{1, 1e12});
  EXPECT_NEAR(vast.below(1e11 + 10), 1e11 + 9 + 0.01, 1e-4);  // with the margin for rounding
  EXPECT_LT(vast.tolerance(1e11), 1);
}

}  // namespace
}  // namespace shelfbeam
