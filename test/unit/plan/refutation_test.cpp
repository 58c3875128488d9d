#include "shelfbeam/plan/refutation.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/plan/bound_rows.hpp"
#include "shelfbeam/plan/tested_refutation.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "unit/placement/random_table.hpp"
#include "unit/plan/plan_store.hpp"

namespace shelfbeam {
namespace {

using Columns = Selection;

bool is_in(const Refutation::Leaf& leaf, const Columns& selected) {
  const auto contains = [](const Columns& set, std::uint32_t j) {
    return std::find(set.begin(), set.end(), j) != set.end();
  };
  return std::all_of(leaf.chosen.begin(), leaf.chosen.end(), [&](auto j) { return contains(selected, j); }) &&
         std::all_of(selected.begin(), selected.end(),
                     [&](auto j) { return contains(leaf.chosen, j) || contains(leaf.free, j); });
}

template <class Body>
void for_each_selection(std::size_t n, const Body& body) {
  for (std::uint32_t set = 0; set < 1U << n; ++set) {
    Columns selected;
    for (std::uint32_t j = 0; j < n; ++j)
      if ((set >> j & 1U) != 0) selected.push_back(j);
    body(selected);
  }
}

bool reaches_all(const std::vector<std::vector<double>>& matrix, const Columns& selected) {
  return std::all_of(matrix.begin(), matrix.end(), [&](const std::vector<double>& row) {
    double sum = 0;
    for (const std::uint32_t j : selected) sum += row[j];
    return sum >= 1;
  });
}

// On random matrices with prices: a refutation is found exactly if no selection of the budget reaches all
// labels, up to margins below 1e-4. Every selection of the budget is in a leaf whose weights refute it.
TEST(Refutation, HasEverySelectionInARefutedLeaf) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> signal(0, 0.9), price(0.5, 2);
  std::size_t found = 0, missed = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t m = 6, n = 9;
    std::vector<std::vector<double>> matrix(m, std::vector<double>(n));
    for (auto& row : matrix)
      for (double& value : row) value = random() % 3 == 0 ? signal(random) : 0.3 * signal(random);
    SelectionBudget limit{std::vector<double>(n, 1.0), static_cast<double>(2 + trial % 3)};
    if (trial % 2 == 1)
      for (double& one : limit.price) one = price(random);
    const SignalTable table = test::make_table(matrix, n);
    const RefutationSearch search =
        find_refutation(table, all_numbers<LabelId>(m), limit, {}, 100000, Deadline(60), {});
    bool is_possible = false;
    for_each_selection(n, [&](const Columns& selected) {
      double cost = 0;
      for (const std::uint32_t j : selected) cost += limit.price[j];
      if (cost > limit.budget) return;
      is_possible = is_possible || reaches_all(matrix, selected);
      if (!search.found) return;
      const Refutation& tree = *search.found;
      const bool is_refuted =
          std::any_of(tree.leaves.begin(), tree.leaves.end(), [&](const Refutation::Leaf& leaf) {
            if (!is_in(leaf, selected)) return false;
            double total = 0, planned = 0;
            const Refutation::Weights& weights = tree.weights[leaf.weights];
            for (std::size_t k = 0; k < weights.rows.size(); ++k)
              for (const std::uint32_t j : selected)
                total += weights.weight[k] * std::min(1.0, matrix[tree.labels[weights.rows[k]]][j]);
            for (const std::uint32_t j : selected) planned += tree.planned[leaf.weights][j];
            EXPECT_NEAR(planned, total, 1e-6);
            return total < 1;
          });
      ASSERT_TRUE(is_refuted) << trial;
    });
    ASSERT_FALSE(search.found && is_possible) << trial;
    if (search.found) ++found;
    if (!search.found && !is_possible) ++missed;
    if (!search.found && !search.counterexample.empty()) {
      double cost = 0;
      for (const std::uint32_t j : search.counterexample) cost += limit.price[j];
      EXPECT_LE(cost, limit.budget + 1e-9);
    }
  }
  EXPECT_GT(found, 60U);
  EXPECT_LE(missed, 1U);
}

// If many leaves stay open, the test expects the number of batches that refutes them. The open leaves keep
// their weights, although others are dropped.
TEST(Refutation, OpenLeavesAreTestedAgain) {
  test::PlanStore store;
  store.across = 40;
  SimulationOptions options{EstimatorKind::reuse};
  options.samples = 20'000;
  options.seed = 5;
  SignalMatrix matrix = simulate(store.scene(), options).matrix;
  store.threshold = 1.04 * test::best_pair(matrix).min_signal;
  const Scene scene = store.scene();
  matrix = simulate(scene, options).matrix;
  const SignalTable table = make_signal_table(matrix);
  const SelectionBudget limit{std::vector<double>(table.columns(), 1.0), 2};
  const RefutationSearch search =
      find_refutation(table, all_numbers<LabelId>(table.rows()), limit, {}, 100000, Deadline(60), {});
  ASSERT_TRUE(search.found);
  Refutation tree = *search.found;
  ASSERT_EQ(tree.leaves.size(), 1U);
  const std::uint32_t last = static_cast<std::uint32_t>(tree.labels.size()) - 1;
  tree.weights.insert(tree.weights.begin(), {{last}, {1.0}});
  tree.planned.insert(tree.planned.begin(), std::vector<double>(table.columns(), 0.5));
  tree.leaves[0].weights = 1;
  tree.leaves.resize(40, tree.leaves[0]);
  tree.leaves.push_back({{}, {0}, 0});  // refuted at once
  const auto prepared = prepare(scene, options, false);
  const auto test = [&](const Refutation& tested, double batches, std::uint64_t seed) {
    return test_refutation(*prepared, tested, table, {{}, seed, static_cast<std::uint32_t>(batches)}, 0.001,
                           Deadline(60), {});
  };
  const TestedRefutation first = test(tree, 32, 7);
  ASSERT_EQ(first.open.size(), 40U);
  ASSERT_LE(first.needed, 4 * 32);
  EXPECT_GT(first.needed, 32);
  tree.leaves = first.open;
  const Refutation open = used_part(tree);
  ASSERT_EQ(open.weights.size(), 1U);
  EXPECT_EQ(open.leaves[0].weights, 0U);
  EXPECT_EQ(open.planned, search.found->planned);
  EXPECT_EQ(open.labels, search.found->labels);
  EXPECT_EQ(open.weights[0].weight, search.found->weights[0].weight);
  const TestedRefutation second = test(open, 1.5 * first.needed, 8);
  EXPECT_TRUE(second.open.empty());
  tree.leaves.resize(1);
  EXPECT_GT(test(tree, 32, 7).needed, 1e9) << "one leaf is rather split";
}

// A selection that just suffices, by 0.02 percent, is refuted at a level of 5 % in at most 5 % of the tests,
// with trees that the noise of the planning matrix allows. The test fails with probability below 1e-3 at
// exactly 5 %. Control: limits at a level of 80 % do not pass.
TEST(RefutationSlow, SeldomRefutesASelectionThatSuffices) {
  test::PlanStore store;
  SimulationOptions options{EstimatorKind::reuse};
  options.relative_error = RelativeError{0.002, 0.02, std::uint64_t{1} << 36};
  options.seed = 1234567;
  const SignalMatrix truth = simulate(store.scene(), options).matrix;
  const auto n = static_cast<std::uint32_t>(truth.columns());
  const test::BestPair best = test::best_pair(truth);
  store.threshold = best.min_signal / 1.0002;
  const Scene scene = store.scene();
  options.relative_error.reset();
  options.samples = 2000;
  const SelectionBudget limit{std::vector<double>(n, 1.0), 2};
  const auto prepared = prepare(scene, options, false);
  std::size_t trees = 0, refuted = 0, refuted_by_control = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    options.seed = seed;
    const SignalMatrix matrix = simulate(scene, options).matrix;
    const SignalTable table = make_signal_table(matrix);
    const RefutationSearch search =
        find_refutation(raised_table(table, matrix, 0.1, 64 * 131), all_numbers<LabelId>(truth.rows()), limit,
                        {}, 100000, Deadline(60), {});
    if (!search.found) continue;
    ++trees;
    const auto is_refuted = [&](double level) {
      const TestedRefutation tested =
          test_refutation(*prepared, *search.found, table, {{}, 1000000 + seed, 64}, level, Deadline(60), {});
      return std::none_of(tested.open.begin(), tested.open.end(),
                          [&](const Refutation::Leaf& leaf) { return is_in(leaf, best.units); });
    };
    refuted += is_refuted(0.05);
    refuted_by_control += is_refuted(0.8);
  }
  RecordProperty("trees", static_cast<int>(trees));
  RecordProperty("refuted", static_cast<int>(refuted));
  RecordProperty("by_control", static_cast<int>(refuted_by_control));
  ASSERT_GT(trees, 33U);
  const double expected = 0.05 * static_cast<double>(trees);
  const double max_refuted = expected + 3.1 * std::sqrt(0.95 * expected);
  EXPECT_LE(static_cast<double>(refuted), max_refuted);
  EXPECT_GT(static_cast<double>(refuted_by_control), max_refuted);
}

}  // namespace
}  // namespace shelfbeam
