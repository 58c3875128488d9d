#include "shelfbeam/placement/coverage/reach_annealing.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "unit/placement/coverage/weighed_tables.hpp"

namespace shelfbeam {
namespace {

// From all units, the annealing finds the fewest that reach a share of the weight, nearly always.
TEST(ReachAnnealing, FindsTheFewestUnits) {
  test::RandomTables tables(31, {.labels = 10, .transceivers = 12, .borderline = false, .weights = true});
  int asked = 0, optimal = 0, smaller_than_whole = 0;
  for (int k = 0; k < 400; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem;
    const detail::LabelWeights weights(table);
    const double target = weights.rounded_up(0.8 * weights.total());
    detail::Selection all(table.columns());
    std::iota(all.begin(), all.end(), 0U);
    if (table.rows() == 0 || test::weight_of(table, problem, all) < weights.in_table(target) ||
        weights.total() == 0)
      continue;
    ++asked;
    const detail::SearchInstance instance(table, problem);
    const detail::SearchMatrix matrix(table, problem.model);
    const auto found =
        detail::anneal_reach(instance, matrix, weights, target, all, {.steps = 5000}, 1, {.threads = 1});
    const detail::Selection selected = found.value_or(all);
    EXPECT_GE(test::weight_of(table, problem, selected), weights.in_table(target) * (1 - 1e-9));
    const auto best = test::BruteForce::weights(table, problem, test::Omission::nothing);
    std::size_t fewest = 0;
    while (!best[fewest] || best[fewest]->reached < weights.in_table(target) * (1 - 1e-9)) ++fewest;
    ASSERT_GE(selected.size(), fewest);
    optimal += selected.size() == fewest;
    smaller_than_whole += test::BruteForce(table, problem).fewest > fewest;
  }
  EXPECT_GT(asked, 200);
  EXPECT_GT(optimal, asked * 95 / 100);
  EXPECT_GT(smaller_than_whole, asked / 4) << "labels are missed on purpose";
}

}  // namespace
}  // namespace shelfbeam
