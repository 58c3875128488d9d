#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/placement/bound/count_bound.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"

#include "unit/milp/every_backend.hpp"
#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

using detail::LpBound;

class LpBounds : public testing::TestWithParam<milp::Backend> {
 protected:
  static LpBound bound(const SignalTable& table, const PlacementProblem& problem,
                       const std::vector<double>& cost, const detail::LpBoundOptions& options = {},
                       const RunControl& control = {}) {
    return lp_bound({table, problem}, cost, GetParam(), options, control);
  }
};

INSTANTIATE_TEST_SUITE_P(Every, LpBounds, test::every_backend, test::backend_name);

/// The relaxation with all rows at once; infinite if infeasible.
double relaxation(const milp::Backend& backend, const SignalTable& table, const PlacementProblem& problem) {
  milp::Model model = placement_model(table, problem);
  for (milp::Column& column : model.columns) column.integer = false;
  for (std::size_t i = 0; i < table.rows(); ++i)
    for (milp::Entry& entry : model.rows[i].entries) entry.value = std::min(entry.value, 1.0);
  return backend.solve(model, {}, {}).primal_bound;
}

// Never above the optimum; equal to the relaxation's value except for the cuts, which the count of an optimum
// as a limit allows.
TEST_P(LpBounds, LieBetweenRelaxationAndOptimum) {
  test::RandomTables random(29, {.labels = 12, .transceivers = 10, .mounts = true});
  int compared = 0, above_relaxation = 0, above_half = 0, wrong_above = 0;
  for (int k = 0; k < 600; ++k) {
    const SignalTable table = random.next();
    const PlacementProblem problem = random.next_problem();
    const test::BruteForce truth(table, problem);
    if (!truth.feasible) continue;
    const bool is_count = problem.combination == Combination::lexicographic;
    const double best = is_count ? static_cast<double>(truth.fewest) : truth.best_sum;
    const std::vector<double> cost = detail::Instance(table, problem).first_cost;
    const LpBound plain = bound(table, problem, cost);
    const std::size_t count = is_count ? truth.fewest : truth.of_best_sum.size();
    const detail::SelectionSet limit{.max_count = count};
    const LpBound cut = bound(table, problem, cost, {.selections = limit});
    const double relaxed = relaxation(GetParam(), table, problem);
    EXPECT_LE(plain.dual.bound, best + test::rounding(best)) << k;
    EXPECT_LE(cut.dual.bound, best + test::rounding(best)) << k;
    EXPECT_LE(plain.dual.bound, relaxed + 1e-6 * std::max(1.0, relaxed)) << k;
    EXPECT_GE(plain.dual.bound, relaxed - 1e-5 * std::max(1.0, relaxed)) << k;
    EXPECT_GE(cut.dual.bound, plain.dual.bound - 1e-6 * std::max(1.0, relaxed)) << k;
    EXPECT_TRUE(plain.complete) << k;
    ++compared;
    if (cut.dual.bound > relaxed + 1e-3 * best) ++above_relaxation;

    // The returned rows and multipliers prove the returned bound.
    ASSERT_EQ(cut.y.size(), cut.rows.size());
    EXPECT_EQ(dual_bound({table, problem}, cut.rows, cut.y, cost, limit).bound, cut.dual.bound);
    // Negative controls: with larger requirements the bound would be wrong, and half of every multiplier
    // proves less.
    SignalTable wrong = table;
    for (auto& label : wrong.labels) label.requirement *= 1.6, label.single_requirement *= 1.6;
    if (dual_bound({wrong, problem}, cut.rows, cut.y, cost, limit).bound > best + 1e-3 * best) ++wrong_above;
    std::vector<double> half = cut.y;
    for (double& y : half) y /= 2;
    if (dual_bound({table, problem}, cut.rows, half, cost, limit).bound < cut.dual.bound - 1e-3 * best)
      ++above_half;
  }
  EXPECT_GT(compared, 150);
  EXPECT_GT(above_relaxation, 10);
  EXPECT_GT(above_half, 75);
  EXPECT_GT(wrong_above, 10);
}

/// Labels that need two or three of many units.
SignalTable a_few_together(test::RandomTables& random) {
  std::vector<std::vector<double>> matrix(10, std::vector<double>(11, 0.0));
  for (auto& row : matrix)
    for (double& entry : row) entry = std::pow(random.real(0, 1), 2) * 0.8;
  return test::make_table(matrix, 11);
}

// Never above the minimum count and often better than the relaxation. Case distinctions prove more than one
// linear program, and never that the minimum count is infeasible.
TEST_P(LpBounds, OfTheCountAreRaisedByLimitsAndCases) {
  test::RandomTables random(31, {.labels = 12, .transceivers = 11, .mounts = true});
  CancelToken cancelled;
  cancelled.request();
  int better = 0, exact = 0, open = 0, closed = 0;
  for (int k = 0; k < 500; ++k) {
    SCOPED_TRACE(k);
    const SignalTable table = random.chance(0.3) ? random.next() : a_few_together(random);
    const PlacementProblem problem{
        .model = random.chance(0.9) ? CommunicationModel::cooperative : CommunicationModel::non_cooperative,
        .redundant = random.chance(0.2)};
    const test::BruteForce truth(table, problem);
    if (!truth.feasible) continue;
    const detail::CountBound found = detail::count_bound({table, problem}, GetParam(), {.effort = {}}, {});
    ASSERT_LE(found.count, truth.fewest);
    ASSERT_GE(static_cast<double>(found.count), found.relaxation.dual.bound);
    EXPECT_TRUE(found.complete);
    better += static_cast<double>(found.count) >= found.relaxation.dual.bound + 1;
    exact += found.count == truth.fewest;
    if (problem.model == CommunicationModel::non_cooperative) continue;

    const std::vector<double> ones(table.columns(), 1.0);
    for (const std::size_t most : {truth.fewest - std::min<std::size_t>(truth.fewest, 1), truth.fewest}) {
      const LpBound limited = bound(table, problem, ones, {.selections = {.max_count = most}});
      const auto is_shown = [&](double seconds, const RunControl& control) {
        return prove_count_exceeds({table, problem}, GetParam(), {.max_count = most}, limited,
                                   detail::for_seconds(seconds), control);
      };
      if (most == truth.fewest) {
        ASSERT_FALSE(is_shown(milp::infinity, {}));
      } else if (limited.dual.bound < static_cast<double>(most) + 1e-6) {
        ++open;
        if (!is_shown(milp::infinity, {})) continue;
        ++closed;
        EXPECT_FALSE(is_shown(0, {})) << "no time";
        EXPECT_FALSE(is_shown(milp::infinity, {.cancel = &cancelled}));
      }
    }
  }
  EXPECT_GT(better, 0);
  EXPECT_GT(exact, 75);
  EXPECT_GT(open, 50);
  EXPECT_GT(closed, open / 8);
}

// The second objective at the minimum count: the count is part of the LP and of its bound.
TEST_P(LpBounds, OfTheSecondaryObjectiveUseTheCount) {
  test::RandomTables random(37, {.labels = 12, .transceivers = 10, .mounts = true});
  int compared = 0, better = 0;
  for (int k = 0; k < 800; ++k) {
    const SignalTable table = random.next();
    PlacementProblem problem = random.next_problem();
    problem.combination = Combination::lexicographic;
    const test::BruteForce truth(table, problem);
    if (!truth.feasible || truth.best_at_fewest == 0) continue;
    const std::vector<double> cost = objective_coefficients(table, problem);
    const LpBound with = bound(table, problem, cost, {.selections = {truth.fewest, truth.fewest}});
    const LpBound without = bound(table, problem, cost);
    EXPECT_LE(with.dual.bound, truth.best_at_fewest + test::rounding(truth.best_at_fewest)) << k;
    EXPECT_GE(with.dual.bound, without.dual.bound - 1e-6 * truth.best_at_fewest) << k;
    ++compared;
    if (with.dual.bound > without.dual.bound + 0.01 * truth.best_at_fewest) ++better;
  }
  EXPECT_GT(compared, 50);
  EXPECT_GT(better, 20);
}

// Two units each give 0.8 to one label and 0.2 to the four others: the relaxation is 3.125, and four units
// leave some label at 0.8.
TEST_P(LpBounds, OfTheCountTestSmallerCounts) {
  std::vector<std::vector<double>> matrix(5, std::vector<double>(10, 0.2));
  for (std::size_t i = 0; i < 5; ++i) matrix[i][2 * i] = matrix[i][2 * i + 1] = 0.8;
  const detail::CountBound found =
      detail::count_bound({test::make_table(matrix, 10), {}}, GetParam(), {.effort = {}}, {});
  EXPECT_LT(found.relaxation.dual.bound, 4);
  EXPECT_EQ(found.count, 5U);
  EXPECT_TRUE(found.complete);
}

TEST_P(LpBounds, EndWithoutTimeOrWhenCancelled) {
  SignalTable table = test::make_table({{1, 1, 0}, {0, 1, 1}, {1, 0, 1}}, 3);
  const PlacementProblem problem{.model = CommunicationModel::non_cooperative};
  const std::vector<double> cost(3, 1.0);
  table.transceivers[0].installed = true;
  const LpBound timeless = bound(table, problem, cost, {.effort = {.until = {}}});
  EXPECT_FALSE(timeless.complete);
  EXPECT_NEAR(timeless.dual.bound, 1, 1e-9);  // the installed unit
  EXPECT_EQ(timeless.y.size(), timeless.rows.size());
  CancelToken token;
  token.request();
  EXPECT_NEAR(bound(table, problem, cost, {}, {.cancel = &token}).dual.bound, 1, 1e-9);
  EXPECT_NEAR(bound(table, problem, cost).dual.bound, 2, 1e-9);
}

TEST_P(LpBounds, DoNotDependOnThreads) {
  const SignalTable table =
      read_signal_table(SHELFBEAM_SOURCE_DIR "/test/data/instances/thesis_s1_e0.txt.gz");
  const std::vector<double> cost(table.columns(), 1.0);
  const LpBound one = bound(table, {}, cost, {}, {.threads = 1});
  const LpBound two = bound(table, {}, cost, {}, {.threads = 2});
  EXPECT_EQ(one.rows, two.rows);
  EXPECT_EQ(one.dual.bound, two.dual.bound);
  EXPECT_TRUE(one.complete);
  EXPECT_GT(one.dual.bound, 3);
  EXPECT_LE(one.dual.bound, 5);
}

// 680 x 600; fewer rows suffice.
TEST_P(LpBounds, OfTheSupermarketNeedFewRows) {
  const SignalTable table =
      read_signal_table(SHELFBEAM_SOURCE_DIR "/test/data/instances/super_s1_e0_part.txt.gz");
  const LpBound found = bound(table, {}, std::vector<double>(table.columns(), 1.0));
  EXPECT_TRUE(found.complete);
  EXPECT_GT(found.dual.bound, 21.3);
  EXPECT_LE(found.dual.bound, 26);
  EXPECT_LT(found.labels.size(), 500U);
}

}  // namespace
}  // namespace shelfbeam
