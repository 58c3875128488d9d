#include "shelfbeam/placement/coverage/coverage_curve.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include <gtest/gtest.h>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/answer/weak_spots.hpp"
#include "shelfbeam/placement/coverage/coverage_bound.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/coverage/weighed_tables.hpp"

namespace shelfbeam {
namespace {

using test::BruteForce;

// The labels that single units reach bound those of two: 4 and 3 of 6 labels, although 7 together.
TEST(CoverageBound, ByHand) {
  const SignalTable table =
      test::make_table({{1, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 1, 1}, {0, 1, 1}, {0, 1, 0}}, 3);
  const PlacementProblem problem{CommunicationModel::non_cooperative};
  const detail::LabelWeights weights(table);
  const detail::Instance instance(table, problem);
  CoverageBound bound(instance, weights, 2);
  EXPECT_EQ(bound.weight(1), 6) << "nothing is known yet";
  bound.improve(1, 4, CoverageAim::lowest, {.steps = 1}, {});
  EXPECT_EQ(bound.weight(1), 4) << "one step with all multipliers 1";
  EXPECT_EQ(bound.weight(2), 6);
}

// The bound is valid for every number of units after any number of steps towards any of them, and often but
// not always tight.
TEST(CoverageBound, HoldsForAnySteps) {
  test::RandomTableLimits limits = test::unweighed_tables;
  limits.weights = true;
  test::RandomTables tables(81, limits);
  int tight = 0, loose = 0, all = 0;
  for (int k = 0; k < 3000; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    const auto best = BruteForce::weights(table, problem);
    const detail::LabelWeights weights(table);
    const detail::Instance instance(table, problem);
    CoverageBound bound(instance, weights, table.columns());
    for (int times = tables.whole(1, 3); times > 0; --times) {
      const auto units = static_cast<std::size_t>(tables.whole(0, static_cast<int>(table.columns())));
      if (!best[units]) continue;
      bound.improve(units, tables.chance(0.5) ? best[units]->reached : 0,
                    tables.chance(0.5) ? CoverageAim::lowest : CoverageAim::reached,
                    {.steps = static_cast<std::uint64_t>(tables.whole(0, 60))}, {});
    }
    for (std::size_t units = 0; units < best.size(); ++units) {
      if (!best[units]) continue;
      const double above = weights.in_table(bound.weight(units)) - best[units]->reached;
      const double rounding = 1e-8 * weights.in_table(weights.total());
      ASSERT_GE(above, -rounding) << k << " with " << units;
      ++all;
      tight += above <= rounding;
      loose += above > rounding;
    }
  }
  EXPECT_GT(tight, all / 2);
  EXPECT_GT(loose, all / 100);
}

// A table of many rows, so that several tasks sum them.
TEST(CoverageBound, DependsNeitherOnThreadsNorOnEarlierCounts) {
  test::RandomTables tables(83, {.labels = 3000, .transceivers = 30, .borderline = false});
  const auto installed_in = [](const SignalTable& table) {
    return static_cast<std::size_t>(
        std::count_if(table.transceivers.begin(), table.transceivers.end(),
                      [](const SignalTable::Transceiver& unit) { return unit.installed; }));
  };
  int compared = 0, lowered = 0;
  for (int k = 0; k < 60; ++k) {
    const SignalTable table = tables.next();
    const std::size_t installed = installed_in(table), units = installed + 2;
    if (table.entries.size() < 40'000 || installed == 0 || units > table.columns()) continue;
    const PlacementProblem problem;
    const detail::LabelWeights weights(table);
    const auto bound_after = [&](unsigned threads, bool looks_at_installed) {
      const ThreadLimit allowed(threads);
      const detail::Instance instance(table, problem);
      CoverageBound bound(instance, weights, table.columns());
      if (looks_at_installed) bound.improve(installed, 0, CoverageAim::lowest, {.steps = 100}, {});
      bound.improve(units, 0, CoverageAim::lowest, {.steps = 100}, {});
      return bound.weight(units);
    };
    const double alone = with_threads(1, [&] { return bound_after(1, false); });
    EXPECT_EQ(with_threads(4, [&] { return bound_after(4, false); }), alone);
    EXPECT_EQ(with_threads(4, [&] { return bound_after(4, true); }), alone);
    ++compared;
    lowered += alone < weights.total();
  }
  EXPECT_GT(compared, 3);
  EXPECT_GT(lowered, 0);
}

TEST(PlacementCurve, EnclosesTheOptimumForEveryCount) {
  test::RandomTables tables(82, test::unweighed_tables);
  int points = 0, by_enumeration = 0;
  for (int k = 0; k < 6000; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    const BruteForce brute(table, problem);
    if (!brute.feasible) continue;
    const Selection& selected = brute.at_fewest;
    std::size_t first = 0;
    for (const auto& unit : table.transceivers) first += unit.installed ? 1 : 0;
    const auto best = BruteForce::budgets(table, problem);
    const CoverageCurve found = coverage_curve(table, problem, selected);
    EXPECT_TRUE(found.is_complete);
    EXPECT_EQ(found.selected, selected) << "fewer units do not exist";
    const std::vector<CurvePoint>& curve = found.points;
    first = std::max<std::size_t>(1, first);
    ASSERT_EQ(curve.size(), selected.size() < first ? 0 : selected.size() - first + 1);
    for (std::size_t p = 0; p < curve.size(); ++p) {
      ASSERT_EQ(curve[p].units, first + p);
      const std::size_t reached = best[curve[p].units]->reached;
      ASSERT_LE(curve[p].at_least, reached) << k;
      ASSERT_GE(curve[p].at_most, reached) << k;
      ASSERT_TRUE(p == 0 ||
                  (curve[p].at_least >= curve[p - 1].at_least && curve[p].at_most >= curve[p - 1].at_most));
      // The enumeration decides small tables.
      ASSERT_EQ(curve[p].at_least, curve[p].at_most) << k;
      ++points;
      by_enumeration += curve[p].miss_proof == BoundProof::log;
    }
    if (!curve.empty()) {
      ASSERT_EQ(curve.back().at_least, table.rows());
    }
  }
  EXPECT_GT(points, 2000);
  EXPECT_GT(by_enumeration, points / 100);
}

TEST(PlacementCurve, WeighsLabels) {
  test::RandomTableLimits limits = test::unweighed_tables;
  limits.weights = true;
  test::RandomTables tables(85, limits);
  int points = 0;
  for (int k = 0; k < 1500; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    const BruteForce brute(table, problem);
    if (!brute.feasible || !has_weights(table)) continue;
    const auto best = BruteForce::weights(table, problem);
    double all = 0;
    for (const auto& label : table.labels) all += label.weight;
    for (const CurvePoint& point : coverage_curve(table, problem, brute.at_fewest).points) {
      const double reached = best[point.units]->reached;
      ASSERT_TRUE(point.weight);
      ASSERT_NEAR(point.weight->at_least, reached, 2e-9 * reached) << k;
      ASSERT_GE(point.weight->at_most, reached * (1 - 2e-9)) << k;
      ASSERT_LE(point.weight->at_most, reached + 2e-9 * all) << k;
      ASSERT_LE(point.at_least, point.at_most);
      ++points;
    }
  }
  EXPECT_GT(points, 300);
}

// Compares with omitting one unit after the other.
TEST(Critical, AreTheLabelsThatOnlyOneUnitReaches) {
  test::RandomTables tables(83, {.redundant = true});
  int some = 0, none_where_one_may_fail = 0;
  for (int k = 0; k < 3000; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    Selection selected;
    for (std::uint32_t j = 0; j < table.columns(); ++j)
      if (tables.chance(0.5)) selected.push_back(j);
    PlacementProblem nothing_fails = problem;
    nothing_fails.redundant = false;
    const Check with_all = check_selection(table, nothing_fails, selected);
    const auto critical = critical_units(table, problem, selected);
    ASSERT_EQ(critical.size(), selected.size());
    std::size_t labels = 0;
    for (std::size_t s = 0; s < selected.size(); ++s) {
      Selection others = selected;
      std::vector<LabelId> expected;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(s));
      const Check without = check_selection(table, nothing_fails, others);
      std::set_difference(without.unmet.begin(), without.unmet.end(), with_all.unmet.begin(),
                          with_all.unmet.end(), std::back_inserter(expected));
      EXPECT_EQ(critical[s].unit, selected[s]);
      ASSERT_EQ(critical[s].labels, expected) << k;
      labels += expected.size();
    }
    some += labels > 0;
    if (problem.redundant && check_selection(table, problem, selected).met()) {
      EXPECT_EQ(labels, 0U);
      ++none_where_one_may_fail;
    }
  }
  EXPECT_GT(some, 1000);
  EXPECT_GT(none_where_one_may_fail, 100);
}

CoverageCurve curve_of(std::vector<CurvePoint> points, Selection selected) {
  return {std::move(points), std::move(selected)};
}

TEST(PlacementCurve, AgreesWithItsPlacement) {
  const SignalTable table = test::make_table({{1, 0, 1}, {1, 0, 0}, {0, 1, 1}}, 3);
  Placement stopped;
  stopped.selected = {0, 1, 2};
  stopped.objective_value = 3;
  stopped.count_lower_bound = stopped.lower_bound = 1;
  stopped.ties_settled = true;

  // The curve found that two units suffice, and proved that one does not.
  Placement placement = stopped;
  CoverageCurve curve = curve_of({{1, 2, 2}, {2, 3, 3}, {3, 3, 3}}, {0, 1});
  reconcile_bounds(placement, curve, table);
  EXPECT_EQ(placement.selected, (Selection{0, 1}));
  EXPECT_EQ(placement.objective_value, 2);
  EXPECT_EQ(placement.count_lower_bound, 2);
  EXPECT_EQ(placement.lower_bound, 2);
  EXPECT_EQ(placement.bound_proof, BoundProof::dual);
  EXPECT_EQ(placement.status, Status::optimal);
  EXPECT_FALSE(placement.ties_settled);
  EXPECT_EQ(curve.points.size(), 2U);

  // The placement proved that fewer than two miss a label.
  placement = stopped;
  placement.count_lower_bound = placement.lower_bound = 2;
  placement.bound_proof = BoundProof::log;
  curve = curve_of({{1, 2, 3}, {2, 2, 3}, {3, 3, 3}}, placement.selected);
  reconcile_bounds(placement, curve, table);
  EXPECT_EQ(curve.points[0].at_most, 2U);
  EXPECT_EQ(curve.points[1].at_most, 3U);
  EXPECT_EQ(placement.bound_proof, BoundProof::log);
  EXPECT_EQ(placement.count(), 3U);
  EXPECT_EQ(placement.status, Status::stopped);

  // With a second objective the bound on the count rises, that of the objective stays, and costs are not a
  // count.
  placement = stopped;
  placement.problem = {CommunicationModel::non_cooperative, Objective::links};
  placement.objective_value = 99;
  curve = curve_of({{1, 2, 2}, {2, 3, 3}, {3, 3, 3}}, {0, 1});
  reconcile_bounds(placement, curve, table);
  EXPECT_EQ(placement.objective_value, 3);
  EXPECT_EQ(placement.count_lower_bound, 2);
  EXPECT_EQ(placement.lower_bound, 1);
  EXPECT_EQ(placement.status, Status::stopped);
  placement = stopped;
  placement.problem.combination = Combination::weighted;
  curve = curve_of({{1, 2, 2}, {2, 3, 3}, {3, 3, 3}}, {0, 1});
  reconcile_bounds(placement, curve, table);
  EXPECT_EQ(placement.count(), 3U);
  EXPECT_EQ(placement.lower_bound, 1);
}

// The greedy method's placement and bound are often not optimal, and the curve is often better.
TEST(PlacementCurve, ContradictsNoPlacement) {
  test::RandomTables tables(84, test::unweighed_tables);
  int fewer = 0, raised = 0;
  for (int k = 0; k < 9000; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    Placement placement = place(table, problem, {.solver = SolverChoice::greedy});
    if (!placement.has_selection()) continue;
    const Placement before = placement;
    CoverageCurve curve = coverage_curve(table, problem, placement.selected);
    reconcile_bounds(placement, curve, table);
    const BruteForce brute(table, problem);
    ASSERT_TRUE(check_selection(table, problem, placement.selected).met());
    ASSERT_LE(placement.count_lower_bound, static_cast<double>(brute.fewest));
    ASSERT_LE(placement.lower_bound, placement.objective_value * (1 + 1e-12));
    for (const CurvePoint& point : curve.points) {
      const bool is_enough = static_cast<double>(point.units) >= placement.count_lower_bound;
      ASSERT_EQ(point.at_most == table.rows(), is_enough || table.rows() == 0) << k;
      ASSERT_LE(point.at_least, point.at_most) << k;
      ASSERT_TRUE(point.at_least < table.rows() || point.units >= placement.count() ||
                  problem.combination == Combination::weighted);
    }
    fewer += placement.count() < before.count();
    raised += placement.count_lower_bound > before.count_lower_bound;
  }
  EXPECT_GT(fewer, 10);
  EXPECT_GT(raised, 100);
}

// Without the limit this takes about ten seconds.
TEST(PlacementCurve, ReportsTheTimeLimit) {
  const SignalTable table = test::dense_table(3000, 800);
  const Placement greedy = place(table, {}, {.solver = SolverChoice::greedy});
  const CoverageCurve curve =
      coverage_curve(table, {}, greedy.selected, {.threads = 1},
                     std::chrono::steady_clock::now() + std::chrono::milliseconds(300));
  EXPECT_FALSE(curve.is_complete);
  EXPECT_EQ(curve.points.size(), greedy.count());
  EXPECT_EQ(curve.points.back().at_least, table.rows());
  EXPECT_NE(placement_json(greedy, table, curve).find("\"curve_complete\": false"), std::string::npos);
}

// A selection certified by independent samples is not replaced by one that they have not examined.
TEST(PlacementCurve, KeepsACertifiedSelection) {
  const SignalTable table =
      test::make_table({{1, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 1, 1}, {0, 1, 1}, {0, 1, 0}}, 3);
  Placement greedy = place(table, {}, {.solver = SolverChoice::greedy});
  ASSERT_EQ(greedy.count(), 3U);
  Placement certified = greedy;
  add_curve(greedy, table, 60);
  const CoverageCurve curve = add_curve(certified, table, 60, {}, true);
  EXPECT_EQ(greedy.count(), 2U);
  EXPECT_EQ(certified.count(), 3U);
  EXPECT_EQ(certified.count_lower_bound, greedy.count_lower_bound);
  ASSERT_EQ(curve.points.size(), 3U);
  EXPECT_EQ(curve.points[1].at_least, table.rows()) << "but it is told";
}

TEST(PlacementCurve, IsWritten) {
  const SignalTable table = test::make_table({{1, 0}, {1, 0}, {0, 1}}, 2);
  const Placement found = place(table, {}, {});
  const std::string json = placement_json(found, table, coverage_curve(table, {}, found.selected));
  const auto expect = [&](const std::string& part) {
    std::string flat = json;
    std::erase_if(flat, [](char c) { return c == ' ' || c == '\n'; });
    EXPECT_NE(flat.find(part), std::string::npos) << part << flat;
  };
  expect(
      R"("curve":[{"units":1,"at_least":2,"at_most":2},{"units":2,"at_least":3,"at_most":3}],"curve_complete":true)");
  expect(
      R"("critical":[{"unit":"T0","count":2,"labels":["L0","L1"]},{"unit":"T1","count":1,"labels":["L2"]}])");
}

}  // namespace
}  // namespace shelfbeam
