#include "shelfbeam/placement/scenarios/scenario_annealing.hpp"

#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/placement/scenarios/scenario_search.hpp"

#include "unit/placement/scenarios/random_scenarios.hpp"

namespace shelfbeam {
namespace {

using test::RandomScenarios;
using test::Rule;

class ScenarioAnnealingOf : public testing::TestWithParam<Rule> {};

// Starts from all candidates that exclude no others.
TEST_P(ScenarioAnnealingOf, FindsTheFewestUnits) {
  RandomScenarios random(5);
  int found = 0, fewest = 0;
  for (int k = 0; k < 60; ++k) {
    SCOPED_TRACE(k);
    const PlacementProblem problem{
        .model = k % 3 == 0 ? CommunicationModel::non_cooperative : CommunicationModel::cooperative,
        .redundant = k % 5 == 0};
    const ScenarioTable scenarios = random.next(k % 2 == 1);
    const MissAllowance allowance = random.allowance(GetParam());
    const Selection start = k % 2 == 1 ? Selection{0, 3, 4, 6, 7} : Selection{0, 1, 2, 3, 4, 5, 6, 7};
    if (allowance.excess(misses_of(scenarios, problem, start)) > 0) continue;
    const double best = test::best_by_enumeration(scenarios, problem, allowance);
    ScenarioAnnealing annealing(scenarios, problem, allowance);
    const auto selected = annealing.next(start, 1, {.steps = 50000}, {}).value_or(start);
    std::uint32_t set = 0;
    for (const std::uint32_t j : selected) set |= 1U << j;
    const std::optional<double> value = test::value_of_set(scenarios, problem, allowance, set);
    ASSERT_TRUE(value) << "breaks a rule";
    ++found;
    fewest += *value == best ? 1 : 0;
  }
  EXPECT_GT(found, 10);
  EXPECT_GE(fewest, found - 1) << "the excused cases may hold a walk at a local optimum";
}

INSTANTIATE_TEST_SUITE_P(Every, ScenarioAnnealingOf, testing::Values(Rule::label, Rule::shop, Rule::total),
                         [](const auto& test) {
                           return test.param == Rule::label  ? "Labels"
                                  : test.param == Rule::shop ? "Shop"
                                                             : "Total";
                         });

// Spreading keeps the count, the price and the allowance, and reaches a reserve in some cases.
TEST(ScenarioAnnealing, SpreadsAtNoHigherPrice) {
  RandomScenarios random(6);
  int spread = 0;
  for (int k = 0; k < 20; ++k) {
    const PlacementProblem problem{.combination =
                                       k % 2 == 0 ? Combination::spend : Combination::lexicographic};
    const ScenarioTable scenarios = random.next(false);
    const MissAllowance allowance = random.allowance(Rule::label);
    const Selection start{0, 1, 2, 3, 4, 5};
    const auto excess = [&](const auto& selected, double reserve) {
      return allowance.excess(misses_of(scenarios, problem, selected, reserve));
    };
    if (excess(start, 1) > 0 || excess(start, 1.2) == 0) continue;
    ScenarioAnnealing annealing(scenarios, problem, allowance);
    const auto selected = annealing.spread(start, detail::for_seconds(1), {});
    EXPECT_LE(scenario_value(scenarios, problem, selected), scenario_value(scenarios, problem, start));
    EXPECT_EQ(excess(selected, 1), 0U);
    spread += excess(selected, 1.2) == 0 ? 1 : 0;
  }
  EXPECT_GT(spread, 0);
}

}  // namespace
}  // namespace shelfbeam
