// Tests certified bounds on the cost, and the bounds of the models where one unit alone must reach a label.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/plan/bound_goal.hpp"
#include "shelfbeam/plan/plan.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "unit/plan/plan_store.hpp"

namespace shelfbeam {
namespace {

// Units in the middle cost less than those at the sides.
void set_prices(SignalTable& table) {
  for (std::size_t j = 0; j < table.columns(); ++j) table.transceivers[j].cost = j % 3 == 1 ? 60.5 : 100;
}

PlanOptions priced_options(std::uint64_t seed) {
  PlanOptions options;
  options.simulation = SimulationOptions{EstimatorKind::reuse};
  options.simulation.samples = 4096;
  options.simulation.seed = seed;
  options.problem.combination = Combination::weighted;
  options.place.step_limit = 1 << 20;
  options.budget.samples = 8'000'000;
  options.table = [](const SignalMatrix& matrix) {
    SignalTable table = make_signal_table(matrix);
    set_prices(table);
    return table;
  };
  return options;
}

TEST(CertifiedCost, IsTheMinimumOfTheMatrix) {
  test::PlanStore store;
  for (const auto model : {CommunicationModel::cooperative, CommunicationModel::non_cooperative})
    for (const bool redundant : {false, true}) {
      PlanOptions options = priced_options(7);
      options.problem.model = model;
      options.problem.redundant = redundant;
      store.threshold = redundant ? 0.04 : 0.075;
      const Plan plan = make_plan(store.scene(), options);
      ASSERT_TRUE(plan.certificate);
      EXPECT_FALSE(plan.certificate->open);
      EXPECT_TRUE(plan.certificate->all_reached());
      EXPECT_NEAR(plan.certificate->cost_lower_bound, plan.placement.objective_value, 1e-9);
      EXPECT_EQ(plan.certificate->count_lower_bound, 0U);
      EXPECT_GT(plan.certificate->bound_labels, 0U) << "one unit is enough";
    }
}

// A sum that depends on simulated signals is not certified.
TEST(CertifiedCost, IsAbsentWhereItDependsOnSignals) {
  PlanOptions options = priced_options(7);
  options.problem.objective = Objective::signal;
  const Plan plan = make_plan(test::PlanStore().scene(), options);
  ASSERT_TRUE(plan.certificate);
  EXPECT_TRUE(plan.certificate->all_reached());
  EXPECT_EQ(plan.certificate->cost_lower_bound, 0);
  EXPECT_EQ(plan.certificate->count_lower_bound, 0U);
}

// A selection of a given cost just suffices, by 0.02 %, and many matrices suggest that more is needed: they
// are the control. A bound above its cost is wrong. At a confidence of 80 %, all rounds together have 10 %
// for the bound; the test fails with probability below 1e-3 at exactly 10 %.
TEST(CertifiedCostSlow, SelectionThatJustSufficesIsSeldomExcluded) {
  for (const bool has_prices : {false, true}) {
    test::PlanStore store;
    PlanOptions options = priced_options(0);
    options.simulation.relative_error = RelativeError{0.002, 0.02, std::uint64_t{1} << 36};
    options.simulation.seed = 1234567;
    const SignalMatrix truth = simulate(store.scene(), options.simulation).matrix;
    options.simulation.relative_error.reset();
    options.simulation.samples = 2000;
    options.budget.samples = 200'000;
    if (!has_prices) {
      options.problem = {.model = CommunicationModel::non_cooperative};
      options.table = {};
    }
    // Two units: any, or two cheap ones.
    double largest = 0;
    for (std::size_t a = 0; a < truth.columns(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        if (has_prices && (a % 3 != 1 || b % 3 != 1)) continue;
        double least = 1e9;
        for (std::size_t i = 0; i < truth.rows(); ++i) {
          const double first = truth.mean[truth.at(i, a)], second = truth.mean[truth.at(i, b)];
          least = std::min(least, has_prices ? first + second : std::max(first, second));
        }
        largest = std::max(largest, least);
      }
    store.threshold = largest / 1.0002;
    const Scene scene = store.scene();
    const double cost = has_prices ? 121 : 2;
    constexpr int plans = 24;
    options.confidence = 0.8;
    int wrong = 0, naive = 0;
    for (int seed = 1; seed <= plans; ++seed) {
      options.simulation.seed = static_cast<std::uint64_t>(seed);
      const Plan plan = make_plan(scene, options);
      if (!plan.certificate) continue;
      const double bound = has_prices ? plan.certificate->cost_lower_bound
                                      : static_cast<double>(plan.certificate->count_lower_bound);
      wrong += bound > cost + 1e-6 ? 1 : 0;
      options.confidence.reset();
      naive += make_plan(scene, options).placement.lower_bound > cost + 1e-6 ? 1 : 0;
      options.confidence = 0.8;
    }
    RecordProperty(has_prices ? "weighted" : "single", wrong);
    RecordProperty(has_prices ? "weighted_naive" : "single_naive", naive);
    EXPECT_LE(wrong, 0.1 * plans + 3.1 * std::sqrt(0.09 * plans));
    EXPECT_GT(naive, 0.2 * plans);
  }
}

BoundGoal goal_of(const std::vector<double>& prices, double lower_bound) {
  SignalTable table;
  for (const double price : prices) table.transceivers.push_back({"", price});
  Placement placement;
  placement.problem.combination = Combination::weighted;
  placement.lower_bound = lower_bound;
  return bound_goal(table, placement);
}

TEST(BoundGoal, RoundsToPossibleCosts) {
  const BoundGoal goal = goal_of({60.5, 100, 121}, 150);
  EXPECT_DOUBLE_EQ(goal.step, 0.5);
  EXPECT_DOUBLE_EQ(goal.value, 150);
  EXPECT_DOUBLE_EQ(goal.rounded(149.7), 150);
  EXPECT_NEAR(goal.below(150).budget, 149.5, 1e-3);
  EXPECT_EQ(goal.max_units_below(150), 1U) << "60.5 + 100 is more than 149.5";
  EXPECT_EQ(goal.max_units_below(161), 2U);
  EXPECT_EQ(goal_of({std::sqrt(2.0), 1}, 1).step, 0);
  const std::vector<double> targets = goal.targets(100);
  EXPECT_EQ(targets.front(), 150);
  EXPECT_TRUE(std::is_sorted(targets.rbegin(), targets.rend()));
  EXPECT_GT(targets.back(), 100);
}

// Sums of prices are rounded: every selection of a lower cost is within the budget, and none of the cost
// itself.
TEST(BoundGoal, BudgetsAllowForRounding) {
  for (const double price : {24.9, 12.95, 49.99, 1.2, 0.3, 9.9, 99.9})
    for (int units = 2; units <= 15; ++units) {
      const BoundGoal goal = goal_of(std::vector<double>(20, price), price * units);
      const SelectionBudget limit = goal.below(goal.value);
      double cost = 0;
      for (int k = 0; k + 1 < units; ++k) cost += price;
      EXPECT_LE(cost, limit.budget) << price << ' ' << units;
      EXPECT_GT(cost + price, limit.budget) << price << ' ' << units;
    }
}

// Free units are part of every selection of the budget, and no other selection enters it.
TEST(BoundGoal, FreeUnitsExcludeNothing) {
  const BoundGoal goal = goal_of({0, 0, 0, 2, 4, 0.5}, 4);
  const SelectionBudget limit = goal.below(4);
  double all_free = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_GT(limit.price[j], 0);
    all_free += limit.price[j];
  }
  EXPECT_LE(all_free + limit.price[3], limit.budget);
  EXPECT_GT(limit.price[4], limit.budget);
  EXPECT_EQ(limit.price[5], 0.5);
}

}  // namespace
}  // namespace shelfbeam
