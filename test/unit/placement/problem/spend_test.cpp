#include "shelfbeam/placement/problem/spend.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

constexpr PlacementProblem by_default{.combination = Combination::automatic};

enum class Prices { few_types, hundredths, real };

void set_prices(SignalTable& table, Prices prices, test::RandomTables& random) {
  for (auto& unit : table.transceivers) switch (prices) {
      case Prices::few_types:
        unit.cost = random.chance(0.5) ? 120 : 45;
        break;
      case Prices::hundredths:
        unit.cost = random.whole(0, 30'000) / 100.0;
        break;
      case Prices::real:
        unit.cost = random.real(0, 3);
        break;
    }
}

// By enumeration: the minimum new spend, and the minimum count at that spend (to 1e-9 of it).
std::pair<double, std::size_t> cheapest(const SignalTable& table, const PlacementProblem& problem) {
  const auto answers = test::BruteForce::answers(table, problem);
  const auto spend = [&](const auto& answer) {
    double sum = 0;
    for (const std::uint32_t j : answer.columns)
      if (!table.transceivers[j].installed) sum += table.transceivers[j].cost;
    return sum;
  };
  std::pair best{std::numeric_limits<double>::infinity(), std::size_t{0}};
  for (const auto& answer : answers) best.first = std::min(best.first, spend(answer));
  best.second = table.columns();
  for (const auto& answer : answers)
    if (spend(answer) <= best.first * (1 + 1e-9)) best.second = std::min(best.second, answer.columns.size());
  return best;
}

// 120 random questions that have an answer, for each kind of prices, with installed units, mounting points,
// conflicts and failures.
TEST(Spend, EqualsExhaustiveSearch) {
  int count_first_is_dearer = 0, free_units_matter = 0;
  for (const Prices prices : {Prices::few_types, Prices::hundredths, Prices::real}) {
    test::RandomTables random(
        41 + static_cast<std::uint64_t>(prices),
        {.labels = 8, .transceivers = 11, .mounts = true, .conflicts = true, .redundant = true});
    for (int k = 0, solvable = 0; solvable < 120; ++k) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(prices) << ", question " << k);
      SignalTable table = random.next();
      set_prices(table, prices, random);
      PlacementProblem problem = random.next_problem();
      problem.objective = Objective::count;
      problem.combination = Combination::spend;
      const Placement answer = place(table, problem, {}, {.threads = 1});
      const auto [spend, count] = cheapest(table, problem);
      if (std::isinf(spend)) {
        EXPECT_EQ(answer.status, Status::infeasible);
        continue;
      }
      ASSERT_EQ(answer.status, Status::optimal);
      EXPECT_TRUE(check_selection(table, problem, answer.selected).met());
      const double rounding = prices == Prices::real ? 1e-6 : 1e-12;
      EXPECT_NEAR(answer.objective_value, spend, rounding * spend);
      EXPECT_NEAR(answer.lower_bound, spend, rounding * spend);
      EXPECT_EQ(answer.count(), count);
      EXPECT_LE(answer.count_lower_bound, static_cast<double>(count));
      EXPECT_EQ(answer.problem.combination, Combination::spend);
      EXPECT_DOUBLE_EQ(price_of(table, answer.selected).to_spend, answer.objective_value);
      ++solvable;
      // The controls: other objectives give other answers.
      problem.combination = Combination::lexicographic;
      const Placement fewest = place(table, problem, {}, {.threads = 1});
      if (price_of(table, fewest.selected).to_spend > spend * (1 + 1e-6)) ++count_first_is_dearer;
      if (price_of(table, answer.selected).total > answer.objective_value) ++free_units_matter;
    }
  }
  EXPECT_GT(count_first_is_dearer, 18);
  EXPECT_GT(free_units_matter, 18);
}

TEST(Spend, IsTheDefaultOnlyWherePricesOfCandidatesDiffer) {
  SignalTable table = test::make_table({{1, 1, 0}, {0, 1, 1}}, 3);
  EXPECT_EQ(resolved(by_default, table).combination, Combination::lexicographic);
  table.transceivers[0].cost = 2;
  EXPECT_EQ(resolved(by_default, table).combination, Combination::spend);
  table.transceivers[0].installed = true;
  EXPECT_EQ(resolved(by_default, table).combination, Combination::lexicographic)
      << "an installed unit is free";
  table.transceivers[1].cost = 2;
  PlacementProblem links = by_default;
  links.objective = Objective::links;
  EXPECT_EQ(resolved(links, table).combination, Combination::lexicographic);
  EXPECT_EQ(resolved({.combination = Combination::lexicographic}, table).combination,
            Combination::lexicographic);
}

TEST(Spend, ReportsThePriceOfTheAnswer) {
  // Unit 1 reaches both labels; units 0 and 2 together cost less.
  SignalTable table = test::make_table({{1, 1, 0}, {0, 1, 1}}, 3);
  EXPECT_FALSE(place(table, by_default, {}).price);
  table.currency = "EUR";
  EXPECT_EQ(place(table, by_default, {}).price->total, 1);
  for (auto& unit : table.transceivers) unit.cost = 45.5;
  table.transceivers[1].cost = 120;
  const Placement cheap = place(table, by_default, {});
  EXPECT_EQ(cheap.selected, (Selection{0, 2}));
  EXPECT_EQ(cheap.objective_value, 91);
  EXPECT_EQ(cheap.lower_bound, 91);
  EXPECT_EQ(cheap.price->currency, "EUR");
  EXPECT_EQ(cheap.price->total, 91);
  EXPECT_EQ(cheap.price->to_spend, 91);
  table.transceivers[1].installed = true;
  const Placement kept = place(table, by_default, {});
  EXPECT_EQ(kept.selected, (Selection{1}));
  EXPECT_EQ(kept.price->total, 120);
  EXPECT_EQ(kept.price->to_spend, 0);
}

TEST(Spend, OfTwoSelectionsOfOnePriceTheSmallerIsChosen) {
  SignalTable table = test::make_table({{1, 1, 0}, {0, 1, 1}}, 3);
  for (auto& unit : table.transceivers) unit.cost = 0.1;
  table.transceivers[2].cost = 0.2;
  table.transceivers[1].cost = 0.3;  // less than 0.1 + 0.2 only as floating-point numbers
  EXPECT_EQ(place(table, by_default, {}).selected, (Selection{1}));
}

// With one odd price, the bound of the count is one of the spend.
TEST(Spend, OfOneOddPriceIsBoundedByTheCount) {
  test::RandomTables random(8);
  SignalTable table = test::scattered_table(random, 60, 40);
  for (auto& unit : table.transceivers) unit.cost = 1;
  const PlaceOptions search{.solver = SolverChoice::search, .step_limit = 300};
  const Placement counted = place(table, {.combination = Combination::lexicographic}, search, {.threads = 1});
  table.transceivers[17].cost = 1.01;
  const Placement best = place(table, by_default, {.step_limit = 1 << 20}, {.threads = 1});
  const Placement placement = place(table, by_default, search, {.threads = 1});
  ASSERT_EQ(best.status, Status::optimal);
  EXPECT_GE(placement.lower_bound, counted.lower_bound);
  EXPECT_LE(placement.lower_bound, best.objective_value);
  EXPECT_LE(placement.count(), counted.count());
  EXPECT_GE(placement.objective_value, best.objective_value);
}

TEST(Spend, BoundOfAnInterruptedSearchIsBelowTheOptimum) {
  test::RandomTables random(7);
  SignalTable table = test::scattered_table(random, 60, 40);
  set_prices(table, Prices::few_types, random);
  const Placement best = place(table, by_default, {.step_limit = 1 << 20}, {.threads = 1});
  ASSERT_EQ(best.status, Status::optimal);
  for (const std::uint64_t steps : {1, 4, 16, 64, 256}) {
    const Placement stopped =
        place(table, by_default, {.solver = SolverChoice::search, .step_limit = steps}, {.threads = 1});
    EXPECT_GE(stopped.objective_value, best.objective_value);
    EXPECT_LE(stopped.lower_bound, best.objective_value);
    EXPECT_LE(stopped.lower_bound, stopped.objective_value);
  }
  const Placement greedy = place(table, by_default, {.solver = SolverChoice::greedy});
  EXPECT_EQ(greedy.status, Status::feasible);
  EXPECT_LE(greedy.lower_bound, best.objective_value);
}

TEST(Spend, ExportedModelHasTheNewSpendAsItsObjective) {
  SignalTable table = test::make_table({{1, 1, 0}, {0, 1, 1}}, 3);
  table.transceivers[0].cost = 7;
  table.transceivers[1].installed = true;
  const milp::Model model = placement_model(table, resolved(by_default, table));
  EXPECT_EQ(model.columns[0].cost, 7);
  EXPECT_EQ(model.columns[1].cost, 0);
  EXPECT_EQ(model.columns[2].cost, 1);
}

TEST(Spend, StepOfPrices) {
  EXPECT_DOUBLE_EQ(price_step(std::vector{60.5, 100.0, 121.0}), 0.5);
  EXPECT_DOUBLE_EQ(price_step(std::vector{24.9, 12.95}), 0.05);
  EXPECT_EQ(price_step(std::vector{std::sqrt(2.0), 1.0}), 0);
}

}  // namespace
}  // namespace shelfbeam
