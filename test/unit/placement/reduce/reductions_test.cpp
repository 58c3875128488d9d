#include "shelfbeam/placement/reduce/reductions.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

using detail::reduce_cover;
using detail::Reduction;
using test::covering;

constexpr double infinite = std::numeric_limits<double>::infinity();

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

bool holds_pair(const Selection& selected, const Pairs& forbidden) {
  const auto in = [&](std::uint32_t j) { return std::count(selected.begin(), selected.end(), j) > 0; };
  return std::any_of(forbidden.begin(), forbidden.end(),
                     [&](const auto& pair) { return in(pair.first) && in(pair.second); });
}

/// The minimum cost of `fixed` with any of `columns` that reach the labels, with at most one unit per
/// mounting point and without conflicts.
double min_cost(const SignalTable& table, const std::vector<double>& cost, const Selection& fixed,
                const Selection& columns, const std::vector<LabelId>& labels, const Pairs& forbidden) {
  double best = infinite;
  for (std::uint32_t set = 0; set < (std::uint32_t{1} << columns.size()); ++set) {
    Selection selected = fixed;
    for (std::size_t k = 0; k < columns.size(); ++k)
      if ((set >> k & 1U) != 0) selected.push_back(columns[k]);
    double sum = 0;
    for (const std::uint32_t j : selected) sum += cost[j];
    if (sum >= best || holds_pair(selected, forbidden)) continue;
    const Check check = check_selection(table, covering, selected);
    const bool met = std::none_of(check.unmet.begin(), check.unmet.end(), [&](std::uint32_t i) {
      return std::binary_search(labels.begin(), labels.end(), i);
    });
    if (met && check.crowded.empty()) best = sum;
  }
  return best;
}

double min_cost(const SignalTable& table, const std::vector<double>& cost, const Pairs& forbidden) {
  Selection installed, others;
  for (std::uint32_t j = 0; j < table.columns(); ++j)
    (table.transceivers[j].installed ? installed : others).push_back(j);
  return min_cost(table, cost, installed, others, all_numbers<LabelId>(table.rows()), forbidden);
}

/// The same after a reduction: solves the parts one by one, and checks every label at the end.
double reduced_min_cost(const SignalTable& table, const std::vector<double>& cost, const Reduction& reduction,
                        const Pairs& forbidden) {
  if (reduction.infeasible || holds_pair(reduction.forced, forbidden)) return infinite;
  double sum = 0;
  for (const std::uint32_t j : reduction.forced) sum += cost[j];
  const double forced = sum;
  for (const detail::CoverPart& part : reduction.parts)
    sum += min_cost(table, cost, reduction.forced, part.columns, part.labels, forbidden) - forced;
  return sum;
}

struct Case {
  SignalTable table;
  std::vector<double> cost;
  Pairs forbidden;
  std::vector<bool> pinned;
};

/// Two or three units of its half of the shop reach every label; reductions rarely solve such problems.
SignalTable two_halves(test::RandomTables& random) {
  std::vector<std::vector<double>> matrix(static_cast<std::size_t>(random.whole(6, 14)),
                                          std::vector<double>(10, 0.0));
  for (auto& row : matrix) {
    const std::size_t first = random.chance(0.5) ? 0 : 5;
    for (int k = random.whole(2, 3); k > 0; --k)
      row[first + static_cast<std::size_t>(random.whole(0, 4))] = 1;
  }
  SignalTable table = test::make_table(matrix, 10);
  if (random.chance(0.3)) table.mounts = {{1, 3}, {4, 6}};
  table.transceivers[3].installed = random.chance(0.1);
  return table;
}

Case random_case(test::RandomTables& random) {
  Case made{random.chance(0.5) ? two_halves(random) : random.next(), {}, {}, {}};
  const auto n = static_cast<int>(made.table.columns());
  const bool whole = random.chance(0.5);
  for (int j = 0; j < n; ++j) made.cost.push_back(whole ? random.whole(0, 3) : random.real(0, 3));
  made.pinned.assign(made.table.columns(), false);
  if (n > 1 && random.chance(0.4)) {
    for (int k = random.whole(1, 3); k > 0; --k) {
      const auto a = static_cast<std::uint32_t>(random.whole(0, n - 1));
      const auto b = static_cast<std::uint32_t>(random.whole(0, n - 1));
      if (a == b || (made.table.transceivers[a].installed && made.table.transceivers[b].installed)) continue;
      made.forbidden.emplace_back(a, b);
      made.pinned[a] = made.pinned[b] = true;
    }
  }
  return made;
}

std::size_t columns_left(const Reduction& reduction) {
  std::size_t count = 0;
  for (const detail::CoverPart& part : reduction.parts) count += part.columns.size();
  return count;
}

TEST(Reductions, KeepTheOptimum) {
  test::RandomTables random(41, {.labels = 14, .transceivers = 9, .mounts = true});
  int infeasible = 0, shrunk = 0, forced = 0, several = 0, with_pairs = 0;
  int without_costs = 0, without_pins = 0, without_points = 0;
  for (int k = 0; k < 2500; ++k) {
    const Case one = random_case(random);
    const double expected = min_cost(one.table, one.cost, one.forbidden);
    const Reduction reduction = reduce_cover({one.table, covering}, one.cost, one.pinned);
    const double found = reduced_min_cost(one.table, one.cost, reduction, one.forbidden);
    if (expected == infinite) {
      ++infeasible;
      EXPECT_EQ(found, infinite) << k;
      continue;
    }
    ASSERT_FALSE(reduction.infeasible) << k;
    ASSERT_NEAR(found, expected, 1e-9) << k;
    if (columns_left(reduction) + 2 < one.table.columns()) ++shrunk;
    if (reduction.parts.size() > 1) ++several;
    if (!reduction.forced.empty()) ++forced;
    if (!one.forbidden.empty()) ++with_pairs;

    // Negative controls: ignoring costs, other constraints or mounting points misses the optimum.
    const std::vector<double> ones(one.cost.size(), 1.0);
    const auto lost = [&](const Reduction& wrong) {
      return reduced_min_cost(one.table, one.cost, wrong, one.forbidden) > expected + 1e-9;
    };
    if (lost(reduce_cover({one.table, covering}, ones, one.pinned))) ++without_costs;
    if (lost(reduce_cover({one.table, covering}, one.cost))) ++without_pins;
    SignalTable conflicts = one.table;
    conflicts.mounts.clear();
    if (lost(reduce_cover({conflicts, covering}, one.cost, one.pinned))) ++without_points;
  }
  EXPECT_GT(infeasible, 40);
  EXPECT_GT(shrunk, 200);
  EXPECT_GT(several, 20);
  EXPECT_GT(forced, 200);
  EXPECT_GT(with_pairs, 120);
  EXPECT_GT(without_costs, 20);
  EXPECT_GT(without_pins, 4);
  EXPECT_GT(without_points, 4);
}

TEST(Reductions, SolveEasyInstances) {
  // Only unit 1 reaches label 2, and it also reaches label 1. Unit 0 then replaces unit 2 at a lower cost.
  const SignalTable table = test::make_table({{1, 0, 1}, {1, 1, 1}, {0, 1, 0}}, 3);
  const Reduction reduction = reduce_cover({table, covering}, std::vector<double>{1, 5, 2});
  EXPECT_EQ(reduction.forced, (Selection{0, 1}));
  EXPECT_TRUE(reduction.parts.empty());
  EXPECT_FALSE(reduction.infeasible);
}

TEST(Reductions, SplitIntoParts) {
  const SignalTable table = test::make_table({{1, 1, 0, 0, 0, 0},
                                              {0, 0, 0, 1, 1, 0},
                                              {0, 1, 1, 0, 0, 0},
                                              {1, 0, 1, 0, 0, 0},
                                              {0, 0, 0, 0, 1, 1},
                                              {0, 0, 0, 1, 0, 1}},
                                             6);
  const std::vector<double> cost(6, 1.0);
  const Reduction reduction = reduce_cover({table, covering}, cost);
  ASSERT_EQ(reduction.parts.size(), 2U);
  EXPECT_EQ(reduction.parts[0].labels, (std::vector<LabelId>{0, 2, 3}));
  EXPECT_EQ(reduction.parts[0].columns, (Selection{0, 1, 2}));
  EXPECT_EQ(reduction.parts[1].labels, (std::vector<LabelId>{1, 4, 5}));
  // Shared points, or unknown constraints, keep parts together.
  SignalTable shared = table;
  shared.mounts = {{2, 3}};
  EXPECT_EQ(reduce_cover({shared, covering}, cost).parts.size(), 1U);
  EXPECT_EQ(reduce_cover({table, covering}, cost, {true, false, false, false, true, false}).parts.size(), 1U);
}

TEST(Reductions, DetectUnreachableLabels) {
  EXPECT_TRUE(reduce_cover({test::make_table({{1, 0}, {0, 0}}, 2), covering}, std::vector<double>(2, 1.0))
                  .infeasible);
  // Each label has a unit, but both units are options of one point.
  SignalTable table = test::make_table({{1, 0}, {0, 1}}, 2);
  table.mounts = {{0, 1}};
  EXPECT_TRUE(reduce_cover({table, covering}, std::vector<double>(2, 1.0)).infeasible);
}

TEST(Reductions, ShrinkTheSupermarket) {
  const SignalTable table =
      read_signal_table(SHELFBEAM_SOURCE_DIR "/test/data/instances/super_s1_e0_part.txt.gz");
  const Reduction reduction = reduce_cover({table, covering}, std::vector<double>(table.columns(), 1.0));
  std::size_t labels = 0;
  for (const detail::CoverPart& part : reduction.parts) labels += part.labels.size();
  EXPECT_LT(labels, 300U);
  EXPECT_LT(columns_left(reduction), 250U);
}

}  // namespace
}  // namespace shelfbeam
