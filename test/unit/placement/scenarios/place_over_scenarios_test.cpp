#include "shelfbeam/placement/scenarios/place_over_scenarios.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "unit/placement/scenarios/random_scenarios.hpp"

namespace shelfbeam {
namespace {

using test::best_by_enumeration;
using test::RandomScenarios;
using test::Rule;

struct ScenariosCase {
  PlacementProblem problem;
  Rule rule = Rule::label;
};

class PlaceOverScenarios : public testing::TestWithParam<ScenariosCase> {};

TEST_P(PlaceOverScenarios, EqualsEnumeration) {
  const auto& [problem, rule] = GetParam();
  RandomScenarios random(1);
  int proven = 0, found = 0, differs = 0;
  const bool is_hard = problem.redundant || problem.model == CommunicationModel::non_cooperative;
  // Searches take longer for the shop and in total; hard cases often have no answer.
  const int cases = rule != Rule::label ? 14 : is_hard ? 40 : 20;
  const double strength = is_hard ? 2.5 : 1;
  for (int k = 0; k < cases; ++k) {
    SCOPED_TRACE(k);
    const ScenarioTable scenarios = random.next(k % 2 == 1, strength);
    const MissAllowance allowance = random.allowance(rule);
    const ScenarioPlacement placement = place_over_scenarios(scenarios, problem, allowance, {});
    const double best = best_by_enumeration(scenarios, problem, allowance);
    EXPECT_LE(placement.lower_bound, best);
    if (placement.has_selection()) {
      EXPECT_GE(placement.value, best);
      EXPECT_EQ(misses_of(scenarios, problem, placement.selected), placement.misses);
      EXPECT_EQ(allowance.excess(placement.misses), 0U);
    }
    found += best < test::infinite ? 1 : 0;
    proven += best < test::infinite && placement.is_proven() ? 1 : 0;
    EXPECT_EQ(placement.value, best);
    const MissAllowance none{.of_label = std::vector<std::uint32_t>(5, 0)};
    differs += best_by_enumeration(scenarios, problem, none) != best ? 1 : 0;
  }
  EXPECT_GE(found, 5);
  EXPECT_EQ(proven, found);
  EXPECT_GE(differs, 3) << "the allowances matter";
}

INSTANTIATE_TEST_SUITE_P(
    Every, PlaceOverScenarios,
    testing::Values(ScenariosCase{}, ScenariosCase{{.model = CommunicationModel::non_cooperative}},
                    ScenariosCase{{.combination = Combination::spend}}, ScenariosCase{{.redundant = true}},
                    ScenariosCase{{.model = CommunicationModel::non_cooperative, .redundant = true}},
                    ScenariosCase{{}, Rule::shop},
                    ScenariosCase{{.model = CommunicationModel::non_cooperative}, Rule::shop},
                    ScenariosCase{{}, Rule::total},
                    ScenariosCase{{.combination = Combination::spend}, Rule::total}),
    [](const auto& test) {
      const PlacementProblem& problem = test.param.problem;
      const Rule rule = test.param.rule;
      return std::string(problem.model == CommunicationModel::cooperative ? "Cooperative" : "Alone") +
             (problem.combination == Combination::spend ? "ByPrice" : "") +
             (problem.redundant ? "WithFailure" : "") +
             (rule == Rule::shop    ? "OfShop"
              : rule == Rule::total ? "InTotal"
                                    : "");
    });

TEST(ScenarioMisses, AllowancesAreBinomial) {
  EXPECT_EQ(allowed_misses(0.95, 100), 5U);
  EXPECT_EQ(allowed_misses(0.95, 50), 2U);
  EXPECT_EQ(allowed_misses(0.9, 30), 3U);
  EXPECT_EQ(allowed_misses(1, 100), 0U);
  // P(N > 1) of two trials with probability 1/2 is 1/4, P(N > 0) is 3/4.
  EXPECT_EQ(widened_misses(0.5, 2, 0.25), 1U);
  EXPECT_EQ(widened_misses(0.5, 2, 0.2), 2U);
  EXPECT_EQ(widened_misses(0.5, 2, 0.75), 0U);
  EXPECT_GT(widened_misses(0.95, 100, 1e-4), allowed_misses(0.95, 100));
  // Without a miss in 59 scenarios, an availability below 95 % has a probability below 0.95^59 = 4.8 %.
  EXPECT_EQ(proving_misses(0.95, 58, 0.05), std::nullopt);
  EXPECT_EQ(proving_misses(0.95, 59, 0.05), 0U);
}

TEST(PlaceOverScenariosRules, NamesLabelsOutOfReach) {
  RandomScenarios random(2);
  ScenarioTable scenarios = random.next(false);
  for (std::ptrdiff_t j = 0; j < 8; ++j) std::fill_n(scenarios.signal.begin() + (j * 5 + 2) * 8, 8, 0.0F);
  const MissAllowance allowance{.of_label = std::vector<std::uint32_t>(5, 3)};
  const ScenarioPlacement placement = place_over_scenarios(scenarios, {}, allowance, {});
  EXPECT_EQ(placement.unreachable, std::vector<LabelId>{2});
  EXPECT_FALSE(placement.has_selection());
}

}  // namespace
}  // namespace shelfbeam
