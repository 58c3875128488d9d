#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/placement_search.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

using Columns = Selection;
using milp::Result;
using milp::Termination;

constexpr PlacementProblem count_problem{};
const milp::SolveFunction real_solver = milp::backends().front().solve;

/// A solver that returns results from a list, then those of a real solver, and records its calls.
struct Script {
  std::vector<Result> answers;
  std::vector<milp::Model> asked;

  milp::SolveFunction function() {
    return [this](const milp::Model& model, const milp::SolveOptions& options, const RunControl& control) {
      asked.push_back(model);
      return asked.size() <= answers.size() ? answers[asked.size() - 1]
                                            : real_solver(model, options, control);
    };
  }
};

struct Found {
  Placement placement;
  bool solver_failed = false;  ///< another back end was asked
};

// The answer of this solver alone, from a known selection.
Found answer(const SignalTable& table, const PlacementProblem& problem, const std::optional<Columns>& start,
             const milp::SolveFunction& solve, double seconds = 1e8) {
  Found found;
  milp::Backend backends[] = {milp::backends().front(), milp::backends().front()};
  backends[0].solve = solve;
  backends[1].solve = [&](const auto&, const auto&, const auto&) {
    found.solver_failed = true;
    return Result{};
  };
  found.placement = detail::search_placement({table, problem}, start, backends, {.solver = SolverChoice::mip},
                                             Deadline(seconds), {.threads = 1});
  return found;
}

Found from_greedy(const SignalTable& table, const PlacementProblem& problem,
                  const milp::SolveFunction& solve) {
  return answer(table, problem, greedy_selection({table, problem}), solve);
}

// Unit 0 alone misses 5e-8 of label 0: less than the 1e-6 that solvers tolerate, more than the 1e-9 of the
// rule.
SignalTable nearly_met() {
  return test::make_table({{1 - 5e-8, 0.3, 0.2}, {1.0, 0.8, 0.4}}, 3);
}

// The rows of failures are added as needed.
TEST(SolverAlone, LetsUnitsFailAsNeeded) {
  const SignalTable table = test::make_table({{0.9, 0.8, 0.7, 0.3, 0.2}}, 5);
  Script script;
  script.answers = {{Termination::optimal, 2, 2, {0, 1, 1, 0, 0}}};
  const Found found = answer(table, {.redundant = true}, Columns{0, 1, 2, 3, 4}, script.function());
  EXPECT_EQ(found.placement.status, Status::optimal);
  EXPECT_EQ(found.placement.count(), 3U);
  ASSERT_GE(script.asked.size(), 2U);
  EXPECT_EQ(script.asked[0].rows[1].name, "L0_without_T0") << "the strongest unit is in from the start";
  EXPECT_NEAR(script.asked[0].rows[0].lower, 1.25, 1e-6) << "5 units at most, so 5/4";
  ASSERT_EQ(script.asked[1].rows.size(), 4U);
  EXPECT_EQ(script.asked[1].rows[2].name, "L0_without_T1");
  EXPECT_EQ(script.asked[1].rows[3].name, "L0_without_T2")
      << "whichever of the two fails, too little is left";
}

// A solver accepts unit 0 alone. The cut against it is as short as possible: the rejected selection is
// extended by units that are too weak to help, regardless of shared points.
TEST(SolverAlone, CutsOffRejectedSelections) {
  struct Case {
    SignalTable table;
    Columns cut;
  };
  // With 1e-9 and 2e-8, 2.8e-8 is missing; 3e-8 more would suffice.
  Case cases[] = {{nearly_met(), {1, 2}},
                  {test::make_table({{1 - 5e-8, 1e-9, 3e-8, 2e-8, 0.5, 0.5}}, 6), {2, 4, 5}},
                  {test::make_table({{1 - 5e-8, 2e-8, 1e-9, 0.5, 0.5}}, 5), {3, 4}}};
  cases[2].table.mounts = {{0, 3}, {1, 2}};
  for (const auto& [table, expected] : cases) {
    Script script;
    std::vector<double> claimed(table.columns(), 0.0);
    claimed[0] = 1;
    script.answers = {{Termination::optimal, 1, 1, claimed}};
    const Found found = answer(table, count_problem, {}, script.function());
    ASSERT_EQ(script.asked.size(), 2U);
    EXPECT_FALSE(found.solver_failed);
    EXPECT_EQ(found.placement.status, Status::optimal);
    EXPECT_EQ(found.placement.count(), 2U);
    EXPECT_EQ(found.placement.count_lower_bound, 2);
    const milp::Row& row = script.asked[1].rows.back();
    Columns cut;
    for (const milp::Entry& entry : row.entries) cut.push_back(entry.column);
    std::sort(cut.begin(), cut.end());
    EXPECT_EQ(cut, expected);
    EXPECT_EQ(row.lower, 1);

    for (const milp::Backend& backend : milp::backends()) {
      int calls = 0;
      const milp::SolveFunction counting = [&](const auto& model, const auto& options, const auto& control) {
        ++calls;
        return backend.solve(model, options, control);
      };
      EXPECT_EQ(answer(table, count_problem, {}, counting).placement.count(), 2U);
      EXPECT_GE(calls, 2) << backend.name << " has seen a cut";
    }
  }
}

TEST(SolverAlone, GivesUpOnASolverThatIgnoresCuts) {
  int calls = 0;
  const milp::SolveFunction stubborn = [&](const auto&, const auto&, const auto&) {
    ++calls;
    return Result{Termination::optimal, 1, 1, {1, 0, 0}};
  };
  const Found found = from_greedy(nearly_met(), count_problem, stubborn);
  EXPECT_EQ(calls, 2);
  EXPECT_TRUE(found.solver_failed);
  EXPECT_EQ(found.placement.status, Status::stopped);
  EXPECT_TRUE(check_selection(nearly_met(), count_problem, found.placement.selected).met());
  EXPECT_EQ(found.placement.count_lower_bound, 1);
}

// Two units are needed (greedy takes three); used with solvers that fail.
SignalTable greedy_trap() {
  return test::make_table({{1, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 1, 1}, {0, 1, 1}, {0, 1, 0}}, 3);
}

// Bounds are rounded up, and a bound equal to the selection's value is a proof, even if the solver was
// stopped.
TEST(SolverAlone, UsesPartialResultsOfSolvers) {
  const struct {
    Result result;
    bool is_failure;
    Status status;
    Columns selected;
    double bound;
  } cases[] = {
      {{}, true, Status::stopped, {0, 1, 2}, 1},
      {{Termination::infeasible, milp::infinity, milp::infinity, {}}, true, Status::stopped, {0, 1, 2}, 1},
      {{Termination::optimal, 0, 0, {0, 0, 0}}, true, Status::stopped, {0, 1, 2}, 1},
      {{Termination::optimal, 2, 2, {1, 1}}, true, Status::stopped, {0, 1, 2}, 1},
      {{Termination::limit, milp::infinity, 1.3, {}}, false, Status::stopped, {0, 1, 2}, 2},
      {{Termination::interrupted, 2, 1, {1, 1, 0}}, false, Status::stopped, {0, 1}, 1},
      {{Termination::limit, 2, 1.001, {1, 1, 0}}, false, Status::optimal, {0, 1}, 2}};
  for (const auto& one : cases) {
    SCOPED_TRACE(&one - cases);
    Script script;
    script.answers = {one.result};
    const auto [found, has_failed] =
        from_greedy(greedy_trap(), {CommunicationModel::non_cooperative}, script.function());
    EXPECT_EQ(script.asked.size(), 1U);
    EXPECT_EQ(has_failed, one.is_failure);
    EXPECT_EQ(found.status, one.status);
    EXPECT_EQ(found.selected, one.selected);
    EXPECT_EQ(found.count_lower_bound, one.bound);
    EXPECT_EQ(found.lower_bound, one.bound);
    const auto count = static_cast<double>(one.selected.size());
    EXPECT_NEAR(found.gap(), (count - one.bound) / count, 1e-12);
  }
}

// Two points with two options each: {0, 3} and {1, 2} reach both labels, {0, 2} and {1, 3} only one.
SignalTable two_points() {
  SignalTable table = test::make_table({{1, 0, 1, 0}, {0, 1, 0, 1}}, 4);
  table.mounts = {{0, 1}, {2, 3}};
  return table;
}

// There is no start and no preprocessing: infeasibility rests on the solver alone, also near the rule's edge.
// Half of the tables have options. Optima are proven within a relative gap of 1e-6.
TEST(SolverAloneSlow, EqualsEnumerationWithoutAStart) {
  for (const milp::Backend& backend : milp::backends()) {
    test::RandomTables plain(43), with_options(44, {.mounts = true});
    int infeasible = 0, optimal = 0, stopped = 0;
    for (int k = 0; k < 1500; ++k) {
      SCOPED_TRACE(testing::Message() << backend.name << " " << k);
      test::RandomTables& tables = k % 2 == 0 ? plain : with_options;
      const SignalTable table = tables.next();
      const PlacementProblem problem = tables.next_problem();
      const test::BruteForce brute(table, problem);
      const Placement found = answer(table, problem, {}, backend.solve).placement;
      if (found.status == Status::stopped) {
        ++stopped;
        continue;
      }
      ASSERT_EQ(found.status == Status::infeasible, !brute.feasible);
      (brute.feasible ? optimal : infeasible) += 1;
      if (!brute.feasible) continue;
      const double best = brute.best(problem);
      EXPECT_NEAR(found.objective_value, best, 2e-6 * best);
    }
    EXPECT_GT(infeasible, 200);
    EXPECT_GT(optimal, 500);
    EXPECT_LE(stopped, 15)
        << "without a start, prices far above the minimum hide it in the solver's tolerance";
  }
}

TEST(SolverAlone, MayStopWithoutASelection) {
  for (const auto combination : {Combination::lexicographic, Combination::weighted}) {
    const PlacementProblem problem{CommunicationModel::cooperative, Objective::links, combination};
    const Found nothing = answer(two_points(), problem, {}, real_solver, 0);
    EXPECT_EQ(nothing.placement.status, Status::stopped);
    EXPECT_TRUE(nothing.placement.selected.empty());
    EXPECT_TRUE(std::isinf(nothing.placement.objective_value));
    EXPECT_TRUE(std::isinf(nothing.placement.gap()));
    EXPECT_EQ(nothing.placement.count_lower_bound, 1);
    EXPECT_GE(nothing.placement.lower_bound, 2);  // a unit has two links

    Script script;
    script.answers = {{Termination::limit, milp::infinity, 1.5, {}}};
    const Found stopped = answer(two_points(), problem, {}, script.function());
    EXPECT_EQ(script.asked.size(), 1U);
    EXPECT_FALSE(stopped.solver_failed);
    EXPECT_EQ(stopped.placement.status, Status::stopped);
    EXPECT_TRUE(std::isinf(stopped.placement.objective_value));

    script.asked.clear();
    script.answers = {Result{}};
    EXPECT_TRUE(answer(two_points(), problem, {}, script.function()).solver_failed);
  }
}

TEST(SolverAlone, NoSolverSelectsTwoUnitsAtAPoint) {
  for (const Columns& claimed : {Columns{0, 1}, Columns{0, 1, 2}}) {
    Script script;
    std::vector<double> solution(4, 0.0);
    for (const std::uint32_t j : claimed) solution[j] = 1;
    script.answers = {{Termination::optimal, static_cast<double>(claimed.size()), 1, solution}};
    const Found found = answer(two_points(), count_problem, {}, script.function());
    EXPECT_TRUE(found.solver_failed);
    EXPECT_TRUE(found.placement.selected.empty());
    EXPECT_EQ(found.placement.status, Status::stopped);
  }
}

TEST(SolverAlone, StopsBetweenTheTwoObjectives) {
  const PlacementProblem problem{CommunicationModel::non_cooperative, Objective::links};
  SignalTable table =
      test::make_table({{1, 1, 0, 1}, {1, 0, 1, 1}, {1, 1, 0, 0}, {1, 0, 1, 0}, {0, 0, 1, 1}}, 4);
  // Two units suffice. Links: {0, 2} 7, {0, 3} 7, {1, 2} 5.
  Script count_unproven;
  count_unproven.answers = {{Termination::limit, 2, 1, {1, 0, 0, 1}}};
  Placement found = from_greedy(table, problem, count_unproven.function()).placement;
  EXPECT_EQ(count_unproven.asked.size(), 1U);
  EXPECT_EQ(found.status, Status::stopped);
  EXPECT_EQ(found.count_lower_bound, 1);
  EXPECT_EQ(found.objective_value, 7);
  EXPECT_EQ(found.lower_bound, 2);  // the unit with the lowest cost

  Script second_unproven;
  second_unproven.answers = {{Termination::optimal, 2, 2, {1, 0, 0, 1}}, {Termination::limit, 7, 4.2, {}}};
  found = from_greedy(table, problem, second_unproven.function()).placement;
  EXPECT_EQ(second_unproven.asked.size(), 2U);
  EXPECT_EQ(found.status, Status::stopped);
  EXPECT_EQ(found.count_lower_bound, 2);
  EXPECT_EQ(found.objective_value, 7);
  EXPECT_EQ(found.lower_bound, 5);  // 4.2 rounded up; the two cheapest units, 2 + 3, give the same
  EXPECT_NEAR(found.gap(), 2.0 / 7, 1e-12);

  Script impossible;
  impossible.answers = {{Termination::optimal, 2, 2, {1, 0, 0, 1}},
                        {Termination::infeasible, milp::infinity, milp::infinity, {}}};
  const Found contradicted = from_greedy(table, problem, impossible.function());
  EXPECT_TRUE(contradicted.solver_failed) << "the known selection is feasible";
  EXPECT_EQ(contradicted.placement.status, Status::stopped);

  found = from_greedy(table, problem, real_solver).placement;
  EXPECT_EQ(found.selected, (Columns{1, 2}));
  EXPECT_EQ(found.status, Status::optimal);
  ASSERT_EQ(found.steps.size(), 2U);
  EXPECT_EQ(found.steps[0].name, "MIP");
  EXPECT_EQ(found.steps[1].name, "second objective, MIP");
}

// The bound contradicts a known selection of two units.
TEST(SolverAlone, IgnoresABoundAboveAKnownSelection) {
  Script script;
  script.answers = {{Termination::optimal, 3, 3, {1, 1, 1}}};
  const Found found =
      answer(greedy_trap(), {CommunicationModel::non_cooperative}, Columns{0, 1}, script.function());
  EXPECT_TRUE(found.solver_failed);
  EXPECT_EQ(found.placement.status, Status::stopped);
  EXPECT_EQ(found.placement.selected, (Columns{0, 1}));
  EXPECT_EQ(found.placement.count_lower_bound, 1);
  EXPECT_EQ(found.placement.bound_proof, BoundProof::trivial);
}

// Bounds are lowered by more than a step, so that rounding cannot close the gap.
TEST(SolverAlone, ProvesSumsOfManySteps) {
  SignalTable table = test::make_table({{1, 0, 1}, {0, 1, 1}}, 3);
  const double prices[] = {8'000'001, 9'000'003, 16'000'001};
  for (std::size_t j = 0; j < 3; ++j) table.transceivers[j].cost = prices[j];
  const PlacementProblem problem{CommunicationModel::cooperative, Objective::count, Combination::weighted};
  for (const milp::Backend& backend : milp::backends()) {
    const Placement found = answer(table, problem, Columns{0, 1}, backend.solve).placement;
    EXPECT_EQ(found.status, Status::optimal) << backend.name;
    EXPECT_EQ(found.selected, Columns{2}) << backend.name;
  }
}

TEST(SolverAlone, DropsNegligibleCoefficientsAndStaysExact) {
  // Four entries of 9e-9 are removed from the row, although three of them are needed: 1 - 2e-8 misses 1.9e-8.
  const SignalTable table = test::make_table({{1 - 2e-8, 9e-9, 9e-9, 9e-9, 9e-9}}, 5);
  for (const milp::Backend& backend : milp::backends()) {
    const Found found = from_greedy(table, count_problem, backend.solve);
    EXPECT_EQ(found.placement.status, Status::optimal) << backend.name;
    EXPECT_EQ(found.placement.count(), 4U) << backend.name;
  }
}

// A cost of 5 beside costs of 1e-8: solvers cannot distinguish the latter unless expensive units are
// excluded.
TEST(SolverAlone, DistinguishesSmallCostsBesideLargeOnes) {
  SignalTable table = test::make_table({{0.75, 0.5, 1.0, 0.25, 1.0}, {0.25, 0.25, 0.5, 0.5, 1.0}}, 5);
  for (auto& unit : table.transceivers) unit.cost = 0;
  table.transceivers[4].cost = 5;
  for (auto& label : table.labels) label.signal_cost = 1e-8;
  const PlacementProblem problem{CommunicationModel::cooperative, Objective::signal, Combination::weighted};
  const double best = test::BruteForce(table, problem).best_sum;
  for (const milp::Backend& backend : milp::backends()) {
    const Placement found = answer(table, problem, Columns{0, 1, 2, 3}, backend.solve).placement;
    EXPECT_EQ(found.status, Status::optimal) << backend.name;
    EXPECT_NEAR(found.objective_value / best, 1, 1e-9) << backend.name;
    EXPECT_NEAR(found.lower_bound / best, 1, 2e-6) << backend.name;
  }
}

// For any stopping point of a solver, bounds hold and selections reach all labels; without one, results are
// exact.
TEST(SolverAlone, BoundsHoldAtAnyStop) {
  test::RandomTables plain(41), with_options(42, {.mounts = true});
  int stopped = 0, optimal = 0, control = 0, empty_handed = 0;
  for (int k = 0; k < 800; ++k) {
    SCOPED_TRACE(k);
    test::RandomTables& tables = k % 2 == 0 ? plain : with_options;
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    const test::BruteForce brute(table, problem);
    if (!brute.feasible) continue;
    const milp::SolveFunction moody = [&](const auto& model, const auto& options, const auto& run) {
      Result result = real_solver(model, options, run);
      if (tables.chance(0.5)) return result;
      result.termination = tables.chance(0.5) ? Termination::limit : Termination::interrupted;
      if (tables.chance(0.5)) result.dual_bound *= tables.real(0, 1);
      if (tables.chance(0.2)) result.dual_bound = -milp::infinity;
      if (tables.chance(0.5)) result.solution.clear();
      return result;
    };
    std::optional<Columns> start = greedy_selection({table, problem});
    if (!check_selection(table, problem, *start).met() || (k % 2 == 1 && tables.chance(0.3))) start.reset();
    const Placement found = answer(table, problem, start, moody).placement;
    const double best = brute.best(problem);
    const double slack = 2e-6 * best;
    const bool has_answer = std::isfinite(found.objective_value);
    ASSERT_TRUE(has_answer ? check_selection(table, problem, found.selected).met()
                           : !start && found.selected.empty() && found.status == Status::stopped);
    empty_handed += !has_answer;
    EXPECT_LE(found.count_lower_bound, static_cast<double>(brute.fewest));
    EXPECT_LE(found.lower_bound, best + slack);
    EXPECT_LE(found.lower_bound, found.objective_value);
    EXPECT_TRUE(found.status != Status::optimal || found.objective_value <= best + slack);
    (found.status == Status::optimal ? optimal : stopped) += 1;
    control += found.objective_value > best + slack;  // incumbents of stopped runs are not always the best
  }
  EXPECT_GT(stopped, 100);
  EXPECT_GT(optimal, 100);
  EXPECT_GT(control, 10);
  EXPECT_GT(empty_handed, 10);
}

}  // namespace
}  // namespace shelfbeam
