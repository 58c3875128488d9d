#include "shelfbeam/placement/heuristic/greedy.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

using Columns = Selection;
using test::alone;
using test::coop;

double harmonic(std::size_t m) {
  double sum = 0;
  for (std::size_t i = 1; i <= m; ++i) sum += 1.0 / static_cast<double>(i);
  return sum;
}

/// The sum of c(S_j): units of cost 1 if lexicographic.
double total(const SignalTable& table, const PlacementProblem& problem, const Columns& selected) {
  const bool counts = problem.combination == Combination::lexicographic;
  double sum = 0;
  for (const std::uint32_t j : selected)
    sum += objective_coefficients(table, problem)[j] + (counts ? 1.0 : table.transceivers[j].cost);
  return sum;
}

/// Its minimum, which greedy approximates.
double min_cost(SignalTable table, PlacementProblem problem) {
  if (problem.combination == Combination::lexicographic)
    for (auto& unit : table.transceivers) unit.cost = 1;
  problem.combination = Combination::weighted;
  return test::BruteForce(table, problem).best_sum;
}

TEST(PlacementGreedy, FollowsAlgorithm1ByHand) {
  // S_0 = {0,1,2}, S_1 = {3,4}, S_2 = {0,1,3,4}, S_3 = {2}: S_2 first (4 labels), then S_0 and S_3 tie with
  // one.
  SignalTable table =
      test::make_table({{1, 0, 1, 0}, {1, 0, 1, 0}, {1, 0, 0, 1}, {0, 1, 1, 0}, {0, 1, 1, 0}}, 4);
  EXPECT_EQ(greedy_selection({table, {alone}}), (Columns{0, 2}));
  // With a cost of links S_3 (one link) is better than S_0 (three) in the second step: 1 + 1 against 1 + 3.
  EXPECT_EQ(greedy_selection({table, {alone, Objective::links}}), (Columns{2, 3}));
  // Weighted: S_2 at 10 loses to S_0 (1/3 each) and S_1 (1/2 each).
  table.transceivers[2].cost = 10;
  EXPECT_EQ(greedy_selection({table, {alone, Objective::count, Combination::weighted}}), (Columns{0, 1}));
  EXPECT_EQ(greedy_selection({table, {alone}}), (Columns{0, 2}));  // the count ignores costs
}

TEST(PlacementGreedy, StartsFromInstalledUnits) {
  SignalTable table = test::make_table({{1, 0, 1, 0}, {1, 0, 1, 0}, {1, 0, 0, 1}, {0, 1, 1, 0}}, 4);
  table.transceivers[1].installed = true;
  EXPECT_EQ(greedy_selection({table, {alone}}), (Columns{0, 1}));
}

TEST(PlacementGreedy, FillsTheDeficitIfUnitsCooperate) {
  // Unit 0 gives 0.6 + 0.6. Unit 1 gives more in sum, 5 + 0.1, but only 1 + 0.1 of it is missing.
  const SignalTable table = test::make_table({{0.6, 5.0, 0.4}, {0.6, 0.1, 0.4}}, 3);
  EXPECT_EQ(greedy_selection({table, {coop}}), (Columns{0, 2}));
}

// Chvatal's bound with every label, and H(m) exactly as stated: the classic family for which greedy takes m
// sets of cost 1/k and the optimum is one set of cost 1 + e.
TEST(PlacementGreedy, ReachesItsBoundOnTheClassicFamily) {
  const std::size_t m = 12;
  std::vector<std::vector<double>> matrix(m, std::vector<double>(m + 1, 0.0));
  for (std::size_t i = 0; i < m; ++i) matrix[i][i] = matrix[i][m] = 1;
  SignalTable table = test::make_table(matrix, m + 1);
  for (std::size_t j = 0; j < m; ++j) table.transceivers[j].cost = 1.0 / static_cast<double>(j + 1);
  table.transceivers[m].cost = 1 + 1e-6;
  const PlacementProblem problem{alone, Objective::count, Combination::weighted};
  const Columns selected = greedy_selection({table, problem});
  EXPECT_EQ(selected.size(), m);
  const double cost = total(table, problem, selected);
  EXPECT_NEAR(cost, harmonic(m), 1e-12);
  EXPECT_LE(cost, harmonic(m) * min_cost(table, problem));
  EXPECT_GT(cost, harmonic(m - 1) * min_cost(table, problem));  // no smaller guarantee holds
}

/// Solves random problems of one kind. Without conflicts greedy finds a selection if there is one, whose cost
/// is at most factor(table, problem, selected) times the optimum; a factor of 1 would be too small.
template <class Factor>
void expect_within(std::uint64_t seed, const PlacementProblem& kind, const Factor& factor) {
  test::RandomTables tables(seed, {.redundant = kind.redundant});
  int solved = 0, above = 0;
  for (int k = 0; k < 2500 && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const SignalTable table = tables.next();
    PlacementProblem problem = tables.next_problem();
    problem.model = kind.model;
    problem.redundant = kind.redundant;
    const double least = min_cost(table, problem);
    const Columns selected = greedy_selection({table, problem});
    EXPECT_EQ(check_selection(table, problem, selected).met(), std::isfinite(least));
    if (!std::isfinite(least)) continue;
    ++solved;
    const double cost = total(table, problem, selected);
    EXPECT_GE(cost, least * (1 - 1e-12));
    if (const double most = factor(table, problem, selected); std::isfinite(most)) {
      EXPECT_LE(cost, most * least * (1 + 1e-9));
    }
    above += cost > least * (1 + 1e-9);
  }
  EXPECT_GT(solved, 700);
  EXPECT_GT(above, 30);
}

double of_all_labels(const SignalTable& table, const PlacementProblem&, const Columns&) {
  return std::max(1.0, harmonic(table.rows()));
}

// Wolsey's theorem for f(S) = sum_i min(1, sum_{j in S} a_ij): cost <= (1 + ln(G / g)) optimum, where G is
// missing after the installed units and g before the last step.
double of_what_was_lacking(const SignalTable& table, const PlacementProblem& problem,
                           const Columns& selected) {
  const auto lacking = [&](const Columns& chosen) {
    const Check check = check_selection(table, problem, chosen);
    double sum = 0;
    for (const std::uint32_t i : check.unmet) sum += 1 - check.signal[i] / table.labels[i].requirement;
    return sum;
  };
  Columns installed;
  for (const std::uint32_t j : selected)
    if (table.transceivers[j].installed) installed.push_back(j);
  double last = lacking(installed);  // the smallest g of any unit that may have been the last
  for (const std::uint32_t j : selected) {
    if (table.transceivers[j].installed) continue;
    Columns without = selected;
    std::erase(without, j);
    if (const double rest = lacking(without); rest > 0) last = std::min(last, rest);
  }
  return last > 0 ? 1 + std::log(lacking(installed) / last) : 1;
}

TEST(PlacementGreedySlow, CoversAndStaysWithinItsBound) {
  expect_within(21, {alone}, of_all_labels);
  expect_within(22, {coop}, of_what_was_lacking);
  // At most two units that reach a label count, which is a submodular function of integers, so H(m) holds.
  expect_within(24, {.model = alone, .redundant = true}, of_all_labels);
  // The only guarantee is a feasible selection.
  expect_within(24, {.model = coop, .redundant = true}, [](const auto&...) { return HUGE_VAL; });
}

// Greedy chooses unit 0 first, because it is cheap, and so occupies the point of unit 1, which alone reaches
// the last three labels. With unit 1 instead, two labels are missed instead of three, and unit 2 reaches
// these.
TEST(PlacementGreedy, ExchangesOptionsIfStuck) {
  SignalTable table = test::make_table({{1, 0, 1}, {1, 0, 1}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}}, 3);
  table.transceivers[1].cost = 4;
  table.transceivers[2].cost = 3;
  for (const auto model : {alone, coop}) {
    const PlacementProblem problem{model, Objective::count, Combination::weighted};
    table.mounts.clear();
    EXPECT_EQ(greedy_selection({table, problem}), (Columns{0, 1}));
    table.mounts = {{0, 1}};
    EXPECT_EQ(greedy_selection({table, problem}), (Columns{1, 2}));
    EXPECT_TRUE(check_selection(table, problem, Columns{1, 2}).met());
  }
}

// Greedy never chooses a conflict and keeps installed units. Mostly it finds a feasible selection if there is
// one; otherwise the exact search continues. (It fails more than three times as often if it cannot exchange
// options.)
TEST(PlacementGreedy, RespectsConflicts) {
  test::RandomTables points(23, {.mounts = true}),
      all(25, {.mounts = true, .conflicts = true, .redundant = true});
  int solved = 0, stuck = 0, crowded = 0, too_close = 0;
  for (int k = 0; k < 6000; ++k) {
    test::RandomTables& tables = k % 2 == 0 ? points : all;
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    const Columns selected = greedy_selection({table, problem});
    const Check check = check_selection(table, problem, selected);
    ASSERT_TRUE(check.allowed()) << k;
    for (std::uint32_t j = 0; j < table.columns(); ++j)
      ASSERT_TRUE(!table.transceivers[j].installed ||
                  std::find(selected.begin(), selected.end(), j) != selected.end());
    const bool feasible = test::BruteForce(table, problem).feasible;
    ASSERT_TRUE(feasible || !check.met());
    solved += feasible && check.met();
    stuck += feasible && !check.met();
    // Negative control: without knowledge of points and conflicts, greedy breaks them.
    SignalTable ignorant = table;
    ignorant.mounts.clear();
    ignorant.conflicts.clear();
    const Check broken = check_selection(table, problem, greedy_selection({ignorant, problem}));
    crowded += !broken.crowded.empty();
    too_close += !broken.too_close.empty();
  }
  EXPECT_GT(solved, 1500);
  EXPECT_LT(stuck, solved / 12);
  EXPECT_GT(stuck, 0);
  EXPECT_GT(crowded, 400);
  EXPECT_GT(too_close, 200);
}

// Two units of 0.6 and 0.5 reach the label, and either may fail, so a third is needed. After the first two
// steps, the signal after the worst failure is still below the requirement.
TEST(PlacementGreedy, ContinuesUntilAnyUnitMayFail) {
  const SignalTable table = test::make_table({{0.6, 0.5, 0.5, 0.1}}, 4);
  const PlacementProblem problem{.redundant = true};
  EXPECT_EQ(greedy_selection({table, problem}), (Columns{0, 1, 2}));
  EXPECT_TRUE(check_selection(table, problem, Columns{0, 1, 2}).met());
  EXPECT_EQ(
      greedy_selection({test::make_table({{1, 0, 7}, {1, 1, 0}}, 3), {.model = alone, .redundant = true}}),
      (Columns{0, 1, 2}));
}

// When its effort is over, the method reaches the other labels one by one.
TEST(PlacementGreedy, EndsWithASelectionWhenItsEffortIsOver) {
  test::RandomTables tables(26);
  int more = 0;
  for (int k = 0; k < 2000; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    const bool is_feasible = check_selection(table, problem, greedy_selection({table, problem})).met();
    for (const std::uint64_t steps : {0, 1, 2}) {
      const Columns selected = greedy_selection({table, problem}, {.steps = steps});
      ASSERT_EQ(check_selection(table, problem, selected).met(), is_feasible) << k;
      more += selected.size() > greedy_selection({table, problem}).size();
    }
  }
  EXPECT_GT(more, 300) << "the limited effort has no effect";
}

TEST(PlacementGreedy, HandlesTablesWithoutLabelsOrUnits) {
  EXPECT_TRUE(greedy_selection({test::make_table({}, 3), {}}).empty());
  EXPECT_TRUE(greedy_selection({test::make_table({}, 0), {}}).empty());
}

}  // namespace
}  // namespace shelfbeam
