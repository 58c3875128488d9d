#include "shelfbeam/placement/coverage/coverage_annealing.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "unit/placement/coverage/weighed_tables.hpp"

namespace shelfbeam {
namespace {

constexpr test::RandomTableLimits weighed{
    .labels = 10, .transceivers = 12, .borderline = false, .weights = true};

double max_weight(const SignalTable& table, const PlacementProblem& problem, std::size_t units) {
  const auto best = test::BruteForce::weights(table, problem, test::Omission::nothing);
  return best[units] ? best[units]->reached : 0;
}

PlacementProblem any_rule(test::RandomTables& tables) {
  return {.model = tables.chance(0.5) ? CommunicationModel::cooperative : CommunicationModel::non_cooperative,
          .redundant = tables.chance(0.3)};
}

// From all units, the annealing finds the fewest that reach a share of the weight, nearly always.
TEST(CoverageAnnealing, FindsTheFewestUnits) {
  test::RandomTables tables(31, weighed);
  int asked = 0, optimal = 0, smaller_than_whole = 0;
  for (int k = 0; k < 600; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem = any_rule(tables);
    const detail::LabelWeights weights(table);
    const double target = weights.rounded_up(0.8 * weights.total());
    Selection all(table.columns());
    std::iota(all.begin(), all.end(), 0U);
    if (table.rows() == 0 || test::weight_of(table, problem, all) < weights.in_table(target) ||
        weights.total() == 0)
      continue;
    ++asked;
    const detail::Instance instance(table, problem);
    const detail::CoverageAnnealing annealing(instance, weights);
    const auto found = annealing.for_fewer(target, all, {.steps = 5000}, 1, {.threads = 1});
    const Selection selected = found.value_or(all);
    EXPECT_GE(test::weight_of(table, problem, selected), weights.in_table(target) * (1 - 1e-9));
    std::size_t fewest = 0;
    while (max_weight(table, problem, fewest) < weights.in_table(target) * (1 - 1e-9)) ++fewest;
    ASSERT_GE(selected.size(), fewest);
    optimal += selected.size() == fewest;
    smaller_than_whole += test::BruteForce(table, problem).fewest > fewest;
  }
  EXPECT_GT(asked, 200);
  EXPECT_GT(optimal, asked * 95 / 100);
  EXPECT_GT(smaller_than_whole, asked / 4) << "labels are missed on purpose";
}

// From the first units, the annealing finds as many of the largest weight, nearly always.
TEST(CoverageAnnealing, FindsTheLargestWeight) {
  test::RandomTables tables(32, weighed);
  int asked = 0, optimal = 0, better = 0;
  for (int k = 0; k < 600; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem = any_rule(tables);
    const detail::LabelWeights weights(table);
    Selection start(std::min<std::size_t>(4, table.columns()));
    std::iota(start.begin(), start.end(), 0U);
    const auto is_installed = [](const SignalTable::Transceiver& unit) { return unit.installed; };
    if (weights.total() == 0 || start.empty() ||
        std::any_of(table.transceivers.begin(), table.transceivers.end(), is_installed))
      continue;
    ++asked;
    const detail::Instance instance(table, problem);
    const detail::CoverageAnnealing annealing(instance, weights);
    const double before = test::weight_of(table, problem, start);
    const auto found = annealing.for_more(0, start, {.steps = 5000}, 1, {.threads = 1});
    const double after = found ? test::weight_of(table, problem, *found) : before;
    const double best = max_weight(table, problem, start.size()), rounding = 1e-9 * best;
    ASSERT_TRUE(!found || found->size() == start.size());
    ASSERT_LE(after, best + rounding);
    optimal += after >= best - rounding;
    better += after > before;
  }
  EXPECT_GT(asked, 300);
  EXPECT_GT(optimal, asked * 95 / 100);
  EXPECT_GT(better, asked / 6) << "the start is seldom optimal";
}

}  // namespace
}  // namespace shelfbeam
