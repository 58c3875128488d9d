#include "shelfbeam/placement/bound/multiplier_bound.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/placement/bound/lp_bound.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/enumeration.hpp"
#include "unit/placement/formula_instances.hpp"

namespace shelfbeam {
namespace {

constexpr PlacementProblem sum_alone{.model = CommunicationModel::non_cooperative,
                                     .combination = Combination::weighted};

detail::MultiplierBound bound(const SignalTable& table, const PlacementProblem& problem,
                              const std::vector<double>& cost, double known) {
  detail::MultiplierBoundOptions options;
  options.known = known;
  return detail::multiplier_bound({table, problem}, cost, options, {});
}

// All kinds of problems: the bound never exceeds the minimum, and the columns that it rules out are in no
// better selection. With a right-hand side of 1.3, it proves too much.
TEST(MultiplierBound, HoldsForEverySelection) {
  test::RandomTables plain(51), more(52, test::beyond_the_paper);
  int tight = 0, ruled_out = 0, too_much = 0;
  for (int k = 0; k < 2000; ++k) {
    SCOPED_TRACE(k);
    test::RandomTables& tables = k % 2 == 0 ? plain : more;
    SignalTable table = tables.next();
    PlacementProblem problem = tables.next_problem();
    problem.combination = Combination::weighted;
    const test::BruteForce truth(table, problem);
    if (!truth.feasible || !(truth.best_sum > 0)) continue;
    const std::vector<double> cost = detail::Instance(table, problem).first_cost;
    const auto found = bound(table, problem, cost, truth.best_sum);
    ASSERT_LE(found.dual.bound, truth.best_sum * (1 + 1e-9));
    tight += found.dual.bound > 0.9 * truth.best_sum;
    for (const std::uint32_t j : useless_columns(found.dual, truth.best_sum * (1 + 1e-9))) {
      ++ruled_out;
      ASSERT_EQ(std::count(truth.of_best_sum.begin(), truth.of_best_sum.end(), j), 0);
    }
    for (auto& label : table.labels) label.requirement *= 1.3, label.single_requirement *= 1.3;
    too_much += bound(table, problem, cost, truth.best_sum).dual.bound > truth.best_sum * (1 + 1e-6);
  }
  EXPECT_GT(tight, 300);
  EXPECT_GT(ruled_out, 300);
  EXPECT_GT(too_much, 20);
}

SignalTable random_cover(std::size_t rows, std::size_t columns, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<std::uint32_t>> of_row(rows);
  SignalTable table;
  for (std::uint32_t j = 0; j < columns; ++j)
    for (auto& row : of_row)
      if (random() % 20 == 0) row.push_back(j);
  table = test::cover_table(of_row, columns);
  for (auto& unit : table.transceivers) unit.cost = static_cast<double>(1 + random() % 100);
  return table;
}

// Wide covers, on which columns are priced: within a thousandth of the linear program.
TEST(MultiplierBound, ComesNearTheLinearProgram) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const SignalTable table = random_cover(120, 12000, seed);
    const std::vector<double> cost = detail::Instance(table, sum_alone).first_cost;
    const double of_lp =
        detail::lp_bound({table, sum_alone}, cost, milp::backends().front(), {}, {}).dual.bound;
    detail::MultiplierBoundOptions options;
    options.known = 1.2 * of_lp;
    for (std::uint32_t i = 0; i < table.rows(); ++i) options.rows.push_back({i});
    const auto found = detail::multiplier_bound({table, sum_alone}, cost, options, {});
    EXPECT_LE(found.dual.bound, of_lp * (1 + 1e-6));
    EXPECT_GE(found.dual.bound, of_lp * (1 - 1e-3));
  }
}

TEST(MultiplierBound, IsTheSameForAnyNumberOfThreads) {
  test::RandomTables random(7);
  const SignalTable table = test::scattered_table(random, 400, 60);
  const std::vector<double> ones(table.columns(), 1.0);
  detail::MultiplierBoundOptions options;
  options.known = 12;
  const auto with = [&](unsigned threads) {
    return detail::multiplier_bound({table, {}}, ones, options, {.threads = threads}).dual.if_chosen;
  };
  EXPECT_EQ(with(1), with(2));
}

}  // namespace
}  // namespace shelfbeam
