#include <chrono>
#include <cmath>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "support/expect_input_error.hpp"
#include "support/processor_time.hpp"
#include "support/sanitizers.hpp"
#include "unit/placement/formula_instances.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

using Columns = Selection;
using test::alone;
using test::coop;

TEST(Placement, ExplainsUnreachableLabels) {
  const SignalTable table = test::make_table({{0.5, 0.4}, {1.0, 1.0}, {0.3, 0.8}}, 2);
  Placement found = place(table, {coop}, {});
  EXPECT_EQ(found.status, Status::infeasible);
  EXPECT_TRUE(found.selected.empty());
  EXPECT_TRUE(std::isinf(found.gap()));
  ASSERT_EQ(found.unreachable.size(), 1U);
  EXPECT_EQ(found.unreachable[0].label, 0U);
  EXPECT_EQ(found.unreachable[0].requirement, 1);
  EXPECT_DOUBLE_EQ(found.unreachable[0].max_signal, 0.9);

  found = place(table, {alone}, {.solver = SolverChoice::greedy});
  EXPECT_EQ(found.status, Status::infeasible);
  ASSERT_EQ(found.unreachable.size(), 2U);
  EXPECT_EQ(found.unreachable[0].max_signal, 0.5);
  EXPECT_EQ(found.unreachable[1].label, 2U);
  EXPECT_EQ(found.unreachable[1].max_signal, 0.8);
}

TEST(Placement, HandlesTablesWithoutLabelsOrUnits) {
  SignalTable no_labels = test::make_table({}, 3);
  for (const auto model : {coop, alone}) {
    Placement found = place(no_labels, {model}, {});
    EXPECT_EQ(found.status, Status::optimal);
    EXPECT_TRUE(found.selected.empty());
    EXPECT_EQ(found.objective_value, 0);
    EXPECT_EQ(place(test::make_table({}, 0), {model}, {}).status, Status::optimal);
    found = place(test::make_table({{}, {}}, 0), {model}, {});
    EXPECT_EQ(found.status, Status::infeasible);
    EXPECT_EQ(found.unreachable.size(), 2U);
    EXPECT_EQ(found.unreachable[0].max_signal, 0);
  }
  no_labels.transceivers[1].installed = true;
  const Placement found = place(no_labels, {coop, Objective::signal, Combination::weighted}, {});
  EXPECT_EQ(found.selected, Columns{1});
  EXPECT_EQ(found.objective_value, 1);
}

TEST(Placement, KeepsInstalledUnits) {
  SignalTable table = test::make_table({{1, 0, 1}, {0, 1, 1}}, 3);
  EXPECT_EQ(place(table, {coop}, {}).selected, Columns{2});
  table.transceivers[0].installed = true;
  for (const auto solver : {SolverChoice::mip, SolverChoice::greedy}) {
    const Placement found = place(table, {coop}, {.solver = solver});
    EXPECT_EQ(found.selected, (Columns{0, 1}));
    EXPECT_EQ(found.count_lower_bound, 2);
  }
}

TEST(Placement, ProvesThatOptionsConflict) {
  SignalTable table = test::make_table({{1, 0}, {0, 1}}, 2);
  table.mounts = {{0, 1}};
  for (const milp::Backend& backend : milp::backends())
    for (const auto model : {coop, alone}) {
      Placement found = place(table, {model}, {.backend = std::string(backend.name)});
      EXPECT_EQ(found.status, Status::infeasible);
      EXPECT_TRUE(found.unreachable.empty());
      EXPECT_TRUE(found.selected.empty());
      EXPECT_EQ(found.solver.backend, backend.full_name()) << "who proved it is told";
      EXPECT_EQ(found.bound_proof, BoundProof::solver);
      // Greedy proves nothing, and without time no solver does.
      found = place(table, {model}, {.solver = SolverChoice::greedy});
      EXPECT_EQ(found.status, Status::stopped);
      EXPECT_TRUE(found.selected.empty());
      EXPECT_TRUE(std::isinf(found.objective_value));
      EXPECT_EQ(found.count_lower_bound, 1);
      found = place(table, {model}, {.time_limit_s = 0});
      EXPECT_EQ(found.status, Status::stopped);
      EXPECT_TRUE(found.selected.empty());
    }
}

// Greedy takes the cheap unit 0. With unit 1 instead, as many labels are missed, so it stays.
TEST(Placement, SearchesIfGreedyIsStuck) {
  SignalTable table = test::make_table({{1, 0, 1}, {1, 0, 1}, {0, 1, 0}, {0, 1, 0}}, 3);
  table.transceivers[1].cost = 4;
  table.transceivers[2].cost = 3;
  table.mounts = {{0, 1}};
  const PlacementProblem problem{alone, Objective::count, Combination::weighted};
  const Placement greedy = place(table, problem, {.solver = SolverChoice::greedy});
  EXPECT_EQ(greedy.status, Status::stopped);
  EXPECT_TRUE(greedy.selected.empty());
  EXPECT_TRUE(std::isinf(greedy.gap()));
  const Placement found = place(table, problem, {});
  EXPECT_EQ(found.status, Status::optimal);
  EXPECT_EQ(found.selected, (Columns{1, 2}));
  EXPECT_EQ(found.objective_value, 7);
}

TEST(Placement, ReportsTheMethod) {
  const SignalTable table = test::make_table({{1, 1}}, 2), of_two = test::make_table({{1, 0}, {0, 1}}, 2);
  for (const milp::Backend& backend : milp::backends()) {
    const PlaceOptions by_mip{.solver = SolverChoice::mip, .backend = std::string(backend.name)};
    EXPECT_EQ(place(of_two, {}, by_mip).solver, (SolvedBy{Method::mip, backend.full_name()}));
    EXPECT_EQ(place(table, {}, by_mip).solver, SolvedBy{Method::mip}) << "one unit needs no proof";
  }
  for (const auto solver : {SolverChoice::automatic, SolverChoice::search})
    EXPECT_EQ(place(table, {}, {.solver = solver}).solver, SolvedBy{Method::search});
  const Placement greedy = place(table, {}, {.solver = SolverChoice::greedy});
  EXPECT_EQ(greedy.solver, SolvedBy{Method::greedy});
  EXPECT_EQ(greedy.status, Status::feasible);
}

// At least the time that the sink slept, and at most the time measured here.
TEST(Placement, ReportsItsTime) {
  class Sleeper : public ProgressSink {
   public:
    void report(Task, double, std::string_view) override {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      ++times;
    }
    int times = 0;
  } sleeper;
  const auto start = std::chrono::steady_clock::now();
  const Placement found = place(test::affine_lines(2), {alone}, {}, {.threads = 1, .progress = &sleeper});
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  ASSERT_GT(sleeper.times, 0);
  EXPECT_GE(found.seconds, 0.01 * sleeper.times);
  EXPECT_LE(found.seconds, passed.count());
}

TEST(Placement, RejectsUnsupportedProblems) {
  SignalTable table = test::make_table({{1, 1}}, 2);
  test::expect_input_error([&] { place(table, {}, {.backend = "cplex"}); }, "cplex");
  table.labels[0].requirement = 0;
  test::expect_input_error([&] { place(table, {}, {}); }, "label L0: ");
}

TEST(Placement, ReportsLinksWithoutCosts) {
  SignalTable table = test::make_table({{1, 1}}, 2);
  EXPECT_TRUE(place(table, {alone, Objective::links}, {}).unit_costs);
  EXPECT_FALSE(place(table, {alone, Objective::count}, {}).unit_costs);
  table.labels[0].link_cost = 2;
  EXPECT_FALSE(place(table, {alone, Objective::links}, {}).unit_costs);
}

void expect_stopped(const SignalTable& table, const Placement& found, double trivial_count_bound) {
  EXPECT_EQ(found.status, Status::stopped);
  EXPECT_TRUE(check_selection(table, {coop}, found.selected).met());
  EXPECT_GT(found.lower_bound, 0);
  EXPECT_LT(found.lower_bound, found.objective_value);
  EXPECT_GE(found.count_lower_bound, trivial_count_bound);
  EXPECT_GT(found.gap(), 0);
}

TEST(Placement, StopsAtTheTimeLimitWithItsIncumbent) {
  const SignalTable table = test::dense_table(200, 100);
  for (const milp::Backend& backend : milp::backends())
    for (const double limit : {0.0, 0.3}) {
      const test::ProcessorTime spent;
      const Placement found =
          place(table, {coop, Objective::signal},
                {.backend = std::string(backend.name), .time_limit_s = limit}, {.threads = 1});
      EXPECT_LT(spent.seconds(), 20 * test::slowness);
      expect_stopped(table, found, 1);
    }
}

// Each label needs 4 units at 0.25; the linear program proves 8.
TEST(Placement, StopsAtTheStepLimitWithItsIncumbent) {
  const SignalTable table = test::dense_table(40, 30);
  for (const milp::Backend& backend : milp::backends()) {
    const PlaceOptions options{.backend = std::string(backend.name), .time_limit_s = 0, .step_limit = 100};
    const Placement once = place(table, {coop, Objective::signal}, options, {.threads = 1});
    expect_stopped(table, once, 8);
    const Placement twice = place(table, {coop, Objective::signal}, options, {.threads = 1});
    EXPECT_EQ(twice.selected, once.selected);
    EXPECT_EQ(twice.lower_bound, once.lower_bound);
  }
}

// Rows of three units out of many. The MIP would solve the reduced problem, but the search alone does not use
// it. It reports this, and its bound is its own.
TEST(Placement, SearchNeedsNoMip) {
  const SignalTable table = test::cube_cycles(5);
  const PlacementProblem problem{alone};
  const Placement with_mip = place(table, problem, {.step_limit = 100});
  EXPECT_EQ(with_mip.bound_proof, BoundProof::solver) << "negative control";
  const Placement search = place(table, problem, {.solver = SolverChoice::search, .step_limit = 100});
  EXPECT_TRUE(check_selection(table, problem, search.selected).met());
  EXPECT_NE(search.bound_proof, BoundProof::solver);
  EXPECT_EQ(search.status, Status::stopped);
  EXPECT_GT(search.count_lower_bound, 1);
  EXPECT_EQ(search.solver.method, Method::search);
}

// Greedy finds no feasible selection, so the search has no start.
TEST(Placement, SearchReportsAMissingStart) {
  SignalTable table = test::make_table({{1, 0}, {0, 1}}, 2);
  table.mounts = {{0, 1}};
  const Placement found = place(table, {}, {.solver = SolverChoice::search});
  EXPECT_EQ(found.status, Status::stopped);
  EXPECT_FALSE(found.has_selection());
  EXPECT_EQ(found.solver, SolvedBy{Method::search});
}

TEST(Placement, SeedsDoNotChangeTheValue) {
  const Placement proven = place(test::affine_lines(3), {alone}, {.seed = 1ULL << 40});
  EXPECT_EQ(proven.status, Status::optimal);
  EXPECT_EQ(proven.objective_value, 18) << "as with the seed of other tests";
  std::set<Selection> unproven;
  for (const std::uint64_t seed : {1ULL, 1ULL << 40})
    for (const std::uint64_t steps : {1U, 10U, 10U})
      unproven.insert(place(test::cube_cycles(5), {alone},
                            {.solver = SolverChoice::search, .step_limit = steps, .seed = seed})
                          .selected);
  EXPECT_EQ(unproven.size(), 4U) << "the same steps, the same selection; others, another";
}

TEST(Placement, ReturnsASelectionWhenCancelled) {
  CancelToken token;
  token.request();
  const SignalTable table = test::dense_table(200, 100);
  const Placement found = place(table, {coop}, {}, {.cancel = &token});
  EXPECT_EQ(found.status, Status::stopped);
  EXPECT_TRUE(check_selection(table, {coop}, found.selected).met());
}

}  // namespace
}  // namespace shelfbeam
