#include "shelfbeam/placement/placement_search.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/enumeration.hpp"
#include "unit/placement/formula_instances.hpp"

namespace shelfbeam {
namespace {

using test::alone;
using test::compare;
using test::coop;
using test::Tally;

TEST(PlacementSearch, EqualsEnumerationWithoutAMip) {
  const Tally tally = test::compare_random(17, 500, {.transceivers = 11},
                                           {.solver = SolverChoice::search, .step_limit = test::ample_steps});
  EXPECT_EQ(tally.count(BoundProof::solver), 0);
}

// On several threads, trees find selections in varying order; the result must not depend on it.
TEST(PlacementSearchSlow, IsTheSameForAnyNumberOfThreadsWithTies) {
  test::RandomTables random(11);
  int open = 0;
  for (int k = 0; k < 2; ++k) {
    const SignalTable table = test::scattered_table(random, 250, 150, 0.034);
    const Placement one = place(table, {}, {}, {.threads = 1});
    ASSERT_EQ(one.status, Status::optimal);
    open += !one.ties_settled;
    for (const unsigned threads : {2U, 4U}) {
      const Placement more = place(table, {}, {}, {.threads = threads});
      EXPECT_EQ(more.selected, one.selected);
      EXPECT_EQ(more.ties_settled, one.ties_settled);
    }
  }
  EXPECT_GT(open, 0);
}

// Costs whose ratio exceeds the precision of a number: the search must not claim what it cannot distinguish.
TEST(PlacementSearch, IsNotMisledByOneDual) {
  test::RandomTables random(16, {.transceivers = 9});
  Tally tally;
  for (int k = 0; k < 300 && !HasFailure(); ++k) {
    SignalTable table = random.next();
    for (auto& unit : table.transceivers)
      if (random.chance(0.2)) unit.cost = std::pow(10.0, random.whole(5, 18));
    PlacementProblem problem = random.next_problem();
    problem.combination = Combination::weighted;
    SCOPED_TRACE(testing::Message() << "case " << k);
    compare(table, problem, place(table, problem, {.step_limit = 10000}, {.threads = 1}), tally);
  }
  EXPECT_GT(tally.optimal, 100);
}

TEST(PlacementSearch, StopsWithValidBoundsAtAnyTime) {
  test::RandomTables random(17, {.transceivers = 12, .mounts = true});
  Tally tally;
  CancelToken token;
  token.request();
  for (int k = 0; k < 300 && !HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = random.next();
    const PlacementProblem problem = random.next_problem();
    for (const double limit : {0.0, 1e-6, 1e-4, 1e300}) {
      const Placement answer =
          limit > 1 ? place(table, problem, {.time_limit_s = limit}, {.threads = 1, .cancel = &token})
                    : place(table, problem, {.time_limit_s = limit}, {.threads = 1});
      if (answer.status == Status::stopped && !answer.has_selection()) continue;
      compare(table, problem, answer, tally);
    }
  }
  EXPECT_GT(tally.stopped, 100);
}

// Table sizes determine the methods of the search, and these tables are small.
Tally run_with(std::uint64_t seed, int cases, const test::RandomTableLimits& tables,
               const detail::SearchLimits& limits) {
  test::RandomTables random(seed, tables);
  const auto backends = milp::backends();
  Tally tally;
  for (int k = 0; k < cases && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = random.next();
    const PlacementProblem problem = random.next_problem();
    const auto greedy = greedy_selection({table, problem});
    if (!check_selection(table, problem, greedy).met()) continue;
    compare(table, problem,
            detail::search_placement({table, problem}, greedy, backends, {.step_limit = 20000}, Deadline(1e8),
                                     {.threads = 1}, limits),
            tally);
  }
  return tally;
}

TEST(PlacementSearchSlow, EqualsEnumerationWithoutTrees) {
  const detail::SearchLimits without_trees{.max_units_of_trees = 0, .small_answer = 0};
  for (const std::uint64_t seed : {21U, 22U}) {
    const Tally tally =
        run_with(seed, 300, seed == 21 ? test::RandomTableLimits{.transceivers = 11} : test::beyond_the_paper,
                 without_trees);
    EXPECT_GT(tally.optimal, 60);
    EXPECT_LT(tally.stopped, tally.optimal / 5);
    EXPECT_GT(tally.count(BoundProof::solver), 5);
    EXPECT_GT(tally.count(BoundProof::dual), 20);
    EXPECT_EQ(tally.count(BoundProof::log), 0);
  }
}

// A valid placement requires neither the dense matrix nor a solver of whole models.
TEST(PlacementSearch, IsValidWithoutDenseMatrixAndMip) {
  const detail::SearchLimits nothing{.max_units_of_trees = 0,
                                     .max_cells_of_trees = 0,
                                     .max_cells_of_local_search = 0,
                                     .small_answer = 0,
                                     .max_mip_entries = 0};
  const Tally tally = run_with(23, 300, test::beyond_the_paper, nothing);
  EXPECT_GT(tally.optimal, 50);
  EXPECT_GT(tally.stopped, 20);
}

milp::Result lies(const milp::Model& model, const milp::SolveOptions&, const RunControl&) {
  milp::Result result;
  result.termination = milp::Termination::optimal;
  result.primal_bound = result.dual_bound = 1e6;
  result.solution.assign(model.columns.size(), 1.0);
  return result;
}

milp::Result fails(const milp::Model&, const milp::SolveOptions&, const RunControl&) {
  return {};
}

// A wrong solver is detected or harmless; after a failing solver, the next is used.
TEST(PlacementSearch, SurvivesSolversThatFailAndLie) {
  test::RandomTables random(24, {.transceivers = 10});
  Tally tally;
  int by_the_next = 0;
  for (int k = 0; k < 100 && !HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    milp::Backend bad = milp::backends().front();
    bad.name = "bad";
    bad.solve = k % 2 == 0 ? lies : fails;
    const milp::Backend both[] = {bad, milp::backends().back()};
    const SignalTable table = random.next();
    const PlacementProblem problem = random.next_problem();
    const auto greedy = greedy_selection({table, problem});
    if (!check_selection(table, problem, greedy).met()) continue;
    const Placement answer =
        detail::search_placement({table, problem}, greedy, both, {.step_limit = test::ample_steps},
                                 Deadline(1e8), {.threads = 1}, {.max_units_of_trees = 0, .small_answer = 0});
    compare(table, problem, answer, tally);
    by_the_next += answer.solver.backend == milp::backends().back().full_name();
  }
  EXPECT_GT(tally.optimal, 30);
  EXPECT_GT(by_the_next, 4);
}

// Costs that solvers cannot distinguish: their proof is valid within their gap.
TEST(PlacementSearch, AcceptsASolverWithinItsGap) {
  test::RandomTables random(25, {.labels = 30, .transceivers = 20, .borderline = false});
  int proven = 0;
  for (int k = 0; k < 20; ++k) {
    SignalTable table = random.next();
    for (auto& unit : table.transceivers) unit.cost = 1 + 1e-8 * random.real(0, 1), unit.installed = false;
    const PlacementProblem problem{coop, Objective::count, Combination::weighted};
    const auto greedy = greedy_selection({table, problem});
    if (!check_selection(table, problem, greedy).met() || greedy.empty()) continue;
    const auto backends = milp::backends();
    const Placement answer =
        detail::search_placement({table, problem}, greedy, backends, {.step_limit = test::ample_steps},
                                 Deadline(1e8), {.threads = 1}, {.max_units_of_trees = 0, .small_answer = 0});
    EXPECT_EQ(answer.status, Status::optimal);
    EXPECT_LT(answer.gap(), 1e-6);
    proven += answer.bound_proof == BoundProof::solver;
  }
  EXPECT_GT(proven, 1);
}

// Without a proof, a bound on the count is none on the second objective.
TEST(PlacementSearch, ClaimsNoOptimumWithoutAProof) {
  const SignalTable table = test::make_table({{5, 1, 0.5}, {5, 1, 0.5}}, 3);
  const PlacementProblem problem{coop, Objective::signal};
  for (const auto solver : {SolverChoice::search, SolverChoice::greedy}) {
    const Placement answer =
        detail::search_placement({table, problem}, Selection{0}, milp::backends(),
                                 {.solver = solver, .proves = false}, Deadline(1e8), {.threads = 1});
    EXPECT_EQ(answer.status, Status::stopped);
    EXPECT_EQ(answer.lower_bound, 1) << "both signals of the cheapest unit, 0.5 each";
  }
}

TEST(PlacementSearch, EndsASolverByEveryLimit) {
  const SignalTable table =
      test::make_table({{1, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 1, 1}, {0, 1, 1}, {0, 1, 0}}, 3);
  CancelToken token;
  token.request();
  const milp::Backend& backend = milp::backends().front();
  const auto run = [&](const PlaceOptions& options, const Deadline& deadline, const RunControl& control) {
    return detail::search_placement({table, {alone}}, Selection{0, 1, 2}, {&backend, 1}, options, deadline,
                                    control);
  };
  const PlaceOptions by_mip{.solver = SolverChoice::mip};
  for (const Placement& found :
       {run(by_mip, Deadline(0), {}), run(by_mip, Deadline(1e8), {.cancel = &token})}) {
    EXPECT_EQ(found.status, Status::stopped);
    EXPECT_EQ(found.selected, (Selection{0, 1, 2}));
    EXPECT_EQ(found.count_lower_bound, 1);
    EXPECT_TRUE(found.steps.empty());
  }
  PlaceOptions with_steps = by_mip;
  with_steps.step_limit = 1000;
  EXPECT_EQ(run(with_steps, Deadline(1e8), {}).status, Status::optimal);
}

TEST(PlacementSearch, ReportsNoSelectionBeforeThereIsOne) {
  struct Watcher : ProgressSink {
    void report(Task, double, std::string_view) override { ++reports; }
    void bounds(double incumbent, double) override { is_finite = is_finite && std::isfinite(incumbent); }
    int reports = 0;
    bool is_finite = true;
  } watcher;
  SignalTable table = test::make_table({{1, 0, 1, 0}, {0, 1, 0, 1}}, 4);
  table.mounts = {{0, 1}, {2, 3}};
  const Placement found =
      detail::search_placement({table, {}}, {}, milp::backends(), {.solver = SolverChoice::mip},
                               Deadline(1e8), {.progress = &watcher});
  EXPECT_EQ(found.count(), 2U);
  EXPECT_EQ(found.bound_proof, BoundProof::solver);
  EXPECT_GT(watcher.reports, 0);
  EXPECT_TRUE(watcher.is_finite);
}

// A higher cost is not a tie, however small the difference.
TEST(PlacementSearch, PrefersTheCheaperOfTwoSimilarUnits) {
  SignalTable table = test::make_table({{1, 2}}, 2);
  table.transceivers[1].cost = 1 + 5e-10;
  const PlacementProblem problem{coop, Objective::count, Combination::weighted};
  const Placement answer = place(table, problem, {});
  EXPECT_EQ(answer.selected, Selection{0});
  EXPECT_EQ(answer.lower_bound, 1);
  table.transceivers[1].cost = 1;
  EXPECT_EQ(place(table, problem, {}).selected, Selection{1}) << "the wider margin";
  table.entries[1].signal = 1;
  table.transceivers[0].id = "T2";
  EXPECT_EQ(place(table, problem, {}).selected, Selection{1}) << "the first by id";
}

// Greedy takes the unit that reaches most labels and is in conflict with all others.
TEST(PlacementSearch, FindsASelectionIfGreedyIsStuck) {
  std::vector<std::vector<double>> matrix(40, std::vector<double>(6, 0.0));
  for (std::size_t i = 0; i < matrix.size(); ++i) matrix[i][i % 4] = matrix[i][4] = 1;
  matrix[0][4] = 0;
  SignalTable table = test::make_table(matrix, 6);
  table.conflicts = {{0, 4}, {1, 4}, {2, 4}, {3, 4}};
  for (const auto model : {coop, alone}) {
    const auto greedy = greedy_selection({table, {model}});
    ASSERT_FALSE(check_selection(table, {model}, greedy).met());
    const auto found = detail::first_selection({table, {model}}, greedy, 10, 1, {});
    ASSERT_TRUE(found);
    EXPECT_TRUE(check_selection(table, {model}, *found).met());
    const Placement answer = place(table, {model}, {});
    EXPECT_EQ(answer.count(), 4U);
    EXPECT_EQ(answer.status, Status::optimal);
  }
  table.conflicts.emplace_back(0, 1);
  EXPECT_FALSE(detail::first_selection({table, {coop}}, {}, 10, 1, {}));
  EXPECT_EQ(place(table, {coop}, {}).status, Status::infeasible);
}

// The relaxation of A27 is half of its optimum of 18.
TEST(PlacementSearch, AsksAMipFirstWhereRelaxationsSayLittle) {
  const SignalTable table = test::affine_lines(3);
  const auto branches = [&](SolverChoice solver) {
    const Placement found = place(table, {alone}, {.solver = solver, .step_limit = 100});
    return std::ranges::count(found.steps, "branch and bound", &SearchStep::name);
  };
  EXPECT_EQ(branches(SolverChoice::automatic), 0);
  EXPECT_EQ(branches(SolverChoice::search), 1);
}

// A proof would take more than five minutes.
TEST(PlacementSearchSlow, IsCloseToBestKnownWithoutProof) {
  const struct {
    SignalTable table;
    std::uint64_t steps;
    std::size_t best, found, min_bound;
  } known[] = {{test::colourings(10, 4), 100, 25, 25, 1}, {test::affine_lines(4), 1000, 61, 62, 27}};
  for (const auto& [table, steps, best, count, min_bound] : known) {
    const Placement found = place(table, {alone}, {.step_limit = steps});
    EXPECT_TRUE(check_selection(table, {alone}, found.selected).met());
    EXPECT_LE(found.count(), count);
    EXPECT_GE(found.count_lower_bound, min_bound);
    EXPECT_LE(found.count_lower_bound, best);
  }
}

}  // namespace
}  // namespace shelfbeam
