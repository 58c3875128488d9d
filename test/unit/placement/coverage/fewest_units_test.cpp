#include "shelfbeam/placement/coverage/fewest_units.hpp"

#include <gtest/gtest.h>

#include "shelfbeam/placement/io/placement_file.hpp"

#include "support/expect_input_error.hpp"
#include "unit/placement/coverage/weighed_tables.hpp"

namespace shelfbeam {
namespace {

using test::BruteForce;
using test::Omission;
using test::weighed_tables;
using test::weight_of;

/// How often `fewest_units` differs from brute force with this rule omitted.
int count_differences(std::uint64_t seed, int cases, Omission omission, SolverChoice solver) {
  test::RandomTables tables(seed, weighed_tables);
  int result = 0, infeasible = 0, by_mip = 0;
  for (int k = 0; k < cases; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    const double share = tables.chance(0.1) ? 1 : tables.real(0.05, 1);
    const auto best = BruteForce::weights(table, problem, omission);
    double total = 0;
    for (const auto& label : table.labels) total += omission == Omission::weights ? 1 : label.weight;
    std::size_t fewest = 0;
    while (fewest < best.size() && (!best[fewest] || best[fewest]->reached < share * total * (1 - 1e-9)))
      ++fewest;
    const FewestUnits found =
        fewest_units(table, problem, share, {.solver = solver, .step_limit = 1 << 20}, {.threads = 1});
    infeasible += found.status == Status::infeasible;
    by_mip += found.solver.method == Method::mip;
    EXPECT_TRUE(omission != Omission::nothing || found.status == Status::infeasible ||
                found.count_lower_bound <= fewest)
        << "never a bound above the optimum";
    const bool is_equal =
        fewest == best.size()
            ? found.status == Status::infeasible && found.weight.upper_bound <= share * total * (1 + 1e-9)
            : found.status == Status::optimal && found.selected.size() == fewest &&
                  weight_of(table, problem, found.selected) >= share * total * (1 - 2e-9);
    result += is_equal ? 0 : 1;
  }
  EXPECT_GT(infeasible, cases / 20);
  EXPECT_LT(infeasible, cases * 3 / 4);
  EXPECT_TRUE(solver != SolverChoice::mip || by_mip > cases / 50) << by_mip;
  return result;
}

TEST(FewestUnits, EqualsBruteForce) {
  EXPECT_EQ(count_differences(94, 1500, Omission::nothing, SolverChoice::search), 0);
  for (const Omission omission :
       {Omission::mounts, Omission::conflicts, Omission::failure, Omission::weights, Omission::tolerance})
    EXPECT_GT(count_differences(94, 300, omission, SolverChoice::search), 1) << static_cast<int>(omission);
}

TEST(FewestUnits, EqualsBruteForceByMip) {
  EXPECT_LE(count_differences(95, 800, Omission::nothing, SolverChoice::mip), 1);
}

TEST(FewestUnits, ByHand) {
  const SignalTable table =
      test::make_table({{1, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 1, 1}, {0, 1, 1}, {0, 1, 0}}, 3);
  FewestUnits found = fewest_units(table, {}, 4.0 / 6, {});
  EXPECT_EQ(found.selected, Selection{2});
  EXPECT_EQ(found.target, 4) << "a share of labels is rounded up, but not because of its own rounding";
  EXPECT_EQ(found.status, Status::optimal);
  found = fewest_units(table, {}, 0.67, {});
  EXPECT_EQ(found.selected.size(), 2U);
  EXPECT_GE(found.reached, 5U);
  EXPECT_EQ(found.count_lower_bound, 2U);
  found = fewest_units(table, {.redundant = true}, 0.8, {});
  EXPECT_EQ(found.status, Status::infeasible);
  EXPECT_LT(found.weight.upper_bound, 0.8 * 6);
  EXPECT_FALSE(found.has_selection);
}

TEST(FewestUnits, IsWritten) {
  SignalTable table = test::make_table({{1, 0}, {0, 1}}, 2);
  table.labels[1].weight = 0.1;
  FewestUnits found = fewest_units(table, {}, 0.5, {});
  found.solver = {Method::search};
  EXPECT_EQ(fewest_units_json(found, table), R"({
  "format": 2,
  "model": "cooperative",
  "survives_failure": false,
  "reach": 0.5,
  "target": 0.6,
  "selected": [
    "T0"
  ],
  "count": 1,
  "count_lower_bound": 1,
  "labels": 2,
  "reached": 1,
  "reached_weight": 1.0,
  "total_weight": 1.1,
  "reachable": 1.1,
  "bound_proof": "trivial",
  "status": "optimal",
  "too_large": false,
  "solver": "search",
  "backend": null,
  "missed": [
    "L1"
  ]
}
)");
}

TEST(FewestUnits, RejectsUnsupportedProblems) {
  SignalTable table = test::make_table({{1, 1}}, 2);
  test::expect_input_error([&] { fewest_units(table, {}, 1, {.backend = "cplex"}); }, "cplex");
  table.labels[0].requirement = 0;
  test::expect_input_error([&] { fewest_units(table, {}, 1, {}); }, "label L0: ");
}

}  // namespace
}  // namespace shelfbeam
