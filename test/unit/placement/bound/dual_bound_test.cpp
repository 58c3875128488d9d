#include "shelfbeam/placement/bound/dual_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

using detail::BoundRow;
using detail::DualBound;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Restricts selections: some unit gives a label at least this share of its requirement. A share of 0 is no
/// restriction.
struct Strongest {
  std::uint32_t label = 0;
  double share = 0;

  bool holds(const SignalTable& table, const PlacementProblem& problem, const Selection& selected) const {
    if (share == 0) return true;
    const double requirement = requirement_of(table.labels[label], problem.model);
    for (const SignalEntry& entry : table.row(label)) {
      const bool is_chosen = std::count(selected.begin(), selected.end(), entry.transceiver) > 0;
      const bool is_enough = problem.model == CommunicationModel::cooperative
                                 ? entry.signal / requirement >= share
                                 : is_met(entry.signal, requirement);
      if (is_chosen && is_enough) return true;
    }
    return false;
  }
};

/// The minimum cost of such a selection, and of such selections that contain each column.
struct Least {
  double cost = infinite;
  std::vector<double> with;

  Least(const SignalTable& table, const PlacementProblem& problem, const std::vector<double>& costs,
        const detail::SelectionSet& selections, const Strongest& strongest = {})
      : with(table.columns(), infinite) {
    for (std::uint32_t set = 0; set < (std::uint32_t{1} << table.columns()); ++set) {
      Selection selected;
      double sum = 0;
      bool holds_installed = true;
      for (std::uint32_t j = 0; j < table.columns(); ++j) {
        const bool in = (set >> j & 1U) != 0;
        if (in) selected.push_back(j), sum += costs[j];
        holds_installed = holds_installed && (in || !table.transceivers[j].installed);
      }
      if (!holds_installed || selected.size() < selections.min_count ||
          selected.size() > selections.max_count)
        continue;
      const auto is_out = [&](std::uint32_t j) {
        return std::count(selections.without.begin(), selections.without.end(), j) > 0;
      };
      if (std::any_of(selected.begin(), selected.end(), is_out)) continue;
      if (!strongest.holds(table, problem, selected)) continue;
      if (!check_selection(table, problem, selected).met()) continue;
      cost = std::min(cost, sum);
      for (const std::uint32_t j : selected) with[j] = std::min(with[j], sum);
    }
  }
};

/// A row per label and, for selections of limited size, cuts of random shares.
std::vector<BoundRow> random_rows(const SignalTable& table, std::size_t max_units,
                                  test::RandomTables& random) {
  std::vector<BoundRow> rows;
  for (std::uint32_t i = 0; i < table.rows(); ++i) {
    rows.push_back({i});
    for (int k = 0; k < 2; ++k)
      rows.push_back({i, random.real(0, 1.1) / static_cast<double>(std::max<std::size_t>(max_units, 1))});
  }
  return rows;
}

// Arbitrary multipliers: most prove little, none may prove too much.
TEST(DualBound, HoldsForAnyMultipliers) {
  test::RandomTables random(17, {.labels = 6, .transceivers = 8, .mounts = true});
  int tight = 0, useless = 0, too_much = 0;
  for (int k = 0; k < 1500; ++k) {
    const SignalTable table = random.next();
    const PlacementProblem problem = random.next_problem();
    std::vector<double> cost = detail::Instance(table, problem).first_cost;
    if (random.chance(0.2))
      for (double& c : cost) c *= random.real(-1, 1);
    const auto units = [&](int min) {
      return static_cast<std::size_t>(random.whole(min, static_cast<int>(table.columns())));
    };
    detail::SelectionSet selections{.max_count = units(0)};
    if (random.chance(0.3)) selections.min_count = selections.max_count;
    if (random.chance(0.1)) selections = {.min_count = units(0)};
    if (random.chance(0.3))
      for (std::uint32_t j = 0; j < table.columns(); ++j)
        if (!table.transceivers[j].installed && random.chance(0.2)) selections.without.push_back(j);
    Strongest strongest;
    if (table.rows() > 0 && random.chance(0.3))
      strongest = {static_cast<std::uint32_t>(random.whole(0, static_cast<int>(table.rows()) - 1)),
                   random.real(0.05, 1)};
    const Least least(table, problem, cost, selections, strongest);
    const Least min_of_all(table, problem, cost, {});
    std::vector<BoundRow> rows = random_rows(table, std::min(selections.max_count, table.columns()), random);
    if (strongest.share > 0) rows.push_back({.label = strongest.label, .strongest = strongest.share});
    const double largest = cost.empty() ? 1 : *std::max_element(cost.begin(), cost.end());
    for (int l = 0; l < 8; ++l) {
      std::vector<double> y;
      const double size = largest * std::pow(2.0, -l);
      for (std::size_t i = 0; i < rows.size(); ++i)
        y.push_back(random.chance(0.3) ? random.real(0, size) : 0);
      const DualBound dual = dual_bound({table, problem}, rows, y, cost, selections);
      ASSERT_LE(dual.bound, least.cost + test::rounding(least.cost)) << k;
      if (dual.bound > 0.7 * least.cost && least.cost > 0 && least.cost < infinite) ++tight;
      for (std::size_t j = 0; j < table.columns(); ++j) {
        ASSERT_LE(dual.if_chosen[j], least.with[j] + test::rounding(least.with[j])) << k;
        ASSERT_GE(dual.if_chosen[j], dual.bound - test::rounding(dual.bound));
      }

      // Negative control: without the restriction the same rows sometimes prove too much.
      if (dual.bound > min_of_all.cost + 1e-3 * largest) ++too_much;

      // No selection of this cost is lost.
      const double worth = least.cost;
      if (worth == infinite) continue;
      for (const std::uint32_t j : useless_columns(dual, worth + test::rounding(worth))) {
        EXPECT_GT(least.with[j], worth);
        ++useless;
      }
    }
  }
  EXPECT_GT(tight, 200);
  EXPECT_GT(too_much, 20);
  EXPECT_GT(useless, 500);
}

// The triangle: LP bound 1.5, and all reduced costs are 0.
TEST(DualBound, IsTheLpBoundAtItsMultipliers) {
  const SignalTable table = test::make_table({{1, 1, 0}, {0, 1, 1}, {1, 0, 1}}, 3);
  const std::vector<BoundRow> rows = {{0, {}}, {1, {}}, {2, {}}};
  const PlacementProblem problem{.model = CommunicationModel::non_cooperative};
  const std::vector<double> cost(3, 1.0);
  const DualBound dual = dual_bound({table, problem}, rows, std::vector<double>(3, 0.5), cost);
  EXPECT_NEAR(dual.bound, 1.5, 1e-12);
  EXPECT_LT(dual.bound, 1.5);
  for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(dual.reduced_cost[j], 0, 1e-12);

  // The same multipliers with a wrong sign, NaN or too large prove less, not more.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {-0.5, nan, infinite, 100.0, 1e300, 1e308})
    EXPECT_LT(dual_bound({table, problem}, rows, std::vector<double>{0.5, 0.5, wrong}, cost).bound, 1.5);
}

TEST(DualBound, UsesTheNumberOfUnits) {
  SignalTable table = test::make_table({{1, 1, 1, 1}}, 4);
  const std::vector<double> cost = {5, 2, 3, 1};
  const auto bound = [&](const detail::SelectionSet& count) {
    return dual_bound({table, {}}, {}, {}, cost, count);
  };
  EXPECT_NEAR(bound({}).bound, 0, 1e-12);
  const DualBound two = bound({.min_count = 2, .max_count = 2});
  EXPECT_NEAR(two.bound, 3, 1e-12);         // units 1 and 3
  EXPECT_NEAR(two.if_chosen[0], 6, 1e-12);  // with 3
  table.mounts = {{1, 3}};
  EXPECT_NEAR(bound({.min_count = 2, .max_count = 2}).bound, 4, 1e-12);
  table.transceivers[0].installed = true;
  const DualBound installed = bound({.min_count = 2, .max_count = 2});
  EXPECT_NEAR(installed.bound, 6, 1e-12);
  EXPECT_NEAR(installed.if_chosen[2], 8, 1e-12);
  EXPECT_EQ(bound({.max_count = 1}).if_chosen[2], infinite);
}

// Labels that may be missed, each at the price of its weight: arbitrary multipliers of arbitrary rows never
// prove more missed weight than the best selection of so many units misses. With prices 1.5 times as high,
// the same multipliers often prove too much.
TEST(DualBound, HoldsForMissedLabels) {
  test::RandomTables random(23, {.labels = 6,
                                 .transceivers = 7,
                                 .mounts = true,
                                 .conflicts = true,
                                 .redundant = true,
                                 .weights = true});
  int tight = 0, too_much = 0;
  for (int k = 0; k < 1000; ++k) {
    const SignalTable table = random.next();
    const PlacementProblem problem = random.next_problem();
    const detail::Instance instance(table, problem);
    const auto best = test::BruteForce::weights(table, problem);
    const auto units = static_cast<std::size_t>(random.whole(0, static_cast<int>(table.columns())));
    const std::vector<BoundRow> rows = random_rows(table, units, random);
    std::vector<double> y, weight, dearer;
    for (std::size_t r = 0; r < rows.size(); ++r) y.push_back(random.chance(0.3) ? random.real(0, 2) : 0);
    double total = 0;
    for (const SignalTable::Label& label : table.labels) {
      weight.push_back(label.weight);
      dearer.push_back(1.5 * label.weight);
      total += label.weight;
    }
    const std::vector<double> nothing(table.columns(), 0.0);
    const auto bounds = [&](const std::vector<double>& price) {
      return bounds_by_count(instance, dual_sums(instance, rows, y, units, price), nothing).at_most;
    };
    const std::vector<double> missed = bounds(weight), wrong = bounds(dearer);
    const double all_reached = dual_bound(instance, rows, y, nothing, {.max_count = units}).bound;
    if (best[units]) {
      EXPECT_NEAR(bounds({})[units], all_reached, 1e-9 * (1 + std::abs(all_reached))) << k;
    }
    ASSERT_EQ(missed.size(), units + 1);
    for (std::size_t n = 0; n <= units; ++n) {
      if (!best[n]) {
        EXPECT_EQ(missed[n], infinite) << "more units are installed";
        continue;
      }
      const double least = total - best[n]->reached, allowed = 1e-9 * (1 + total);
      EXPECT_LE(missed[n], least + allowed) << k;
      tight += least > 0 && missed[n] > 0.9 * least;
      too_much += wrong[n] > least + allowed;
    }
  }
  EXPECT_GT(tight, 50);
  EXPECT_GT(too_much, 50);  // negative control
}

// Sums of many rows are divided among threads.
TEST(DualBound, SumsManyRowsOnAnyThreads) {
  test::RandomTables random(29, {.labels = 6, .transceivers = 7});
  const SignalTable table = random.next();
  const detail::Instance instance(table, {});
  std::vector<BoundRow> rows;
  std::vector<double> y;
  for (int k = 0; k < 5000; ++k) {
    rows.push_back({static_cast<std::uint32_t>(k % static_cast<int>(table.rows()))});
    y.push_back(random.real(0, 1));
  }
  const auto sums = [&](unsigned threads) {
    return with_threads(threads, [&] { return dual_sums(instance, rows, y, table.columns()); });
  };
  const detail::DualSums one = sums(1), four = sums(4);
  EXPECT_EQ(one.weight, four.weight);
  EXPECT_EQ(one.constant, four.constant);
  std::vector<double> by_hand(table.columns(), 0.0);
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (const SignalEntry& entry : table.row(rows[k].label))
      by_hand[entry.transceiver] +=
          y[k] * std::min(1.0, entry.signal / table.labels[rows[k].label].requirement);
  for (std::size_t j = 0; j < by_hand.size(); ++j)
    EXPECT_NEAR(one.weight[j], by_hand[j], 1e-9 * (1 + by_hand[j]));
}

TEST(DualBound, ProvesNothingFromInfiniteSums) {
  const SignalTable table = test::make_table({{1, 1}}, 2);
  const detail::Instance instance(table, {});
  const std::vector<BoundRow> rows{{0}, {0}};
  const std::vector<double> huge(2, 1e308), cost(2, 1.0);
  const auto bounds = bounds_by_count(instance, dual_sums(instance, rows, huge, 2), cost);
  EXPECT_EQ(bounds.at_most, std::vector<double>(3, -infinite));
}

TEST(DualBound, ExcludesColumnsInConflictWithInstalledUnits) {
  SignalTable table = test::make_table({{1, 0, 1}}, 3);
  table.transceivers[1].installed = true;
  table.conflicts.emplace_back(1, 2);
  const std::vector<BoundRow> rows{{0}};
  const std::vector<double> y{1}, cost{1, 1, 0};
  const DualBound bound = dual_bound({table, {}}, rows, y, cost);
  EXPECT_EQ(bound.if_chosen[2], infinite);
  EXPECT_NEAR(bound.bound, 2, 1e-8);
  table.conflicts.clear();
  EXPECT_NEAR(dual_bound({table, {}}, rows, y, cost).bound, 1, 1e-8) << "control: unit 2 costs nothing";
}

TEST(DualBound, UsesThePigeonholePrinciple) {
  // Three units suffice, but one of two must give a half.
  const SignalTable table = test::make_table({{0.6, 0.45, 0.45, 0.45}}, 4);
  const std::vector<double> cost = {1, 0, 0, 0};
  const auto bound = [&](double share, std::size_t max_units) {
    const std::vector<BoundRow> rows = {{0, share}};
    return dual_bound({table, {}}, rows, std::vector<double>{1.0}, cost, {.max_count = max_units}).bound;
  };
  EXPECT_NEAR(bound(0.46, 2), 1, 1e-9);
  EXPECT_LE(bound(0.3, 3), 0);
  // If all units together meet the requirement with signals below the share, the row is void.
  EXPECT_NEAR(bound(0.5, 2), 0, 1e-9);
  EXPECT_NEAR(bound(0.46, 3), 0, 1e-9);
  EXPECT_NEAR(bound(0.46, detail::SelectionSet().max_count), 0, 1e-9);
}

// Two units, of which one gives the label its requirement and the other half of it. Either a unit must give
// all, which leaves one unit, or the strong unit is excluded, which leaves none.
TEST(DualBound, UsesTheCasesOfALabel) {
  const SignalTable table = test::make_table({{1, 0.5}}, 2);
  const std::vector<double> price{1, 1};
  const BoundRow strong{.label = 0, .strongest = 1}, half{.label = 0, .strongest = 0.5}, plain{0};
  const auto bound = [&](const BoundRow& row, double y, const Selection& without) {
    return dual_bound({table, {}}, std::vector{row}, std::vector{y}, price, {.without = without});
  };
  EXPECT_NEAR(bound(strong, 1, {}).bound, 1, 1e-9);
  EXPECT_NEAR(bound(strong, 1, {}).if_chosen[1], 2, 1e-9) << "the strong one and this one";
  EXPECT_NEAR(bound(half, 1, {}).if_chosen[1], 1, 1e-9) << "at the share itself";
  EXPECT_NEAR(bound(plain, 2, {}).bound, 1, 1e-8);
  EXPECT_NEAR(bound(plain, 2, {0}).bound, 2, 1e-8);
  EXPECT_EQ(bound(plain, 2, {0}).if_chosen[0], infinite);
  SignalTable shared = table;
  shared.mounts = {{0, 1}};
  EXPECT_NEAR(
      dual_bound({shared, {}}, std::vector{plain}, std::vector{2.0}, price, {.without = {0, 1}}).bound, 2,
      1e-8)
      << "nothing is left of the point";
}

TEST(DualBound, CountsOneUnitPerMountingPoint) {
  // Units 0 and 1 reach label 0, units 2 and 3 label 1; units 1 and 2 are options of one point.
  SignalTable table = test::make_table({{1, 1, 0, 0}, {0, 0, 1, 1}}, 4);
  table.mounts = {{1, 2}};
  const std::vector<double> cost = {3, 1, 1, 3};
  const std::vector<BoundRow> rows = {{0, {}}, {1, {}}};
  const PlacementProblem problem{.model = CommunicationModel::non_cooperative};
  // With multiplier 3 per label: 6 - 2 (one of the two options) = 4, which is the optimum; 2 without the
  // point.
  EXPECT_NEAR(dual_bound({table, problem}, rows, std::vector<double>{3, 3}, cost).bound, 4, 1e-9);
  table.mounts.clear();
  EXPECT_NEAR(dual_bound({table, problem}, rows, std::vector<double>{3, 3}, cost).bound, 2, 1e-9);

  table.mounts = {{1, 2}};
  table.transceivers[2].installed = true;
  const DualBound installed = dual_bound({table, problem}, rows, std::vector<double>{3, 1}, cost);
  EXPECT_NEAR(installed.bound, 4, 1e-9);
  EXPECT_EQ(installed.if_chosen[1], infinite);
  EXPECT_EQ(useless_columns(installed, 4), (Selection{1, 3}));
}

}  // namespace
}  // namespace shelfbeam
