#include "shelfbeam/placement/coverage/max_coverage.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "support/expect_input_error.hpp"
#include "unit/milp/every_backend.hpp"
#include "unit/placement/brute_force.hpp"
#include "unit/placement/coverage/weighed_tables.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

using test::alone;
using test::BruteForce;
using test::coop;
using test::dense_table;

constexpr test::RandomTableLimits pairs_only{
    .labels = 8, .transceivers = 10, .conflicts = true, .redundant = true};

/// A valid number of units, including 0, mostly fewer than half.
std::size_t few_units(test::RandomTables& tables, const SignalTable& table) {
  return static_cast<std::size_t>(tables.whole(
      static_cast<int>(test::installed(table)),
      std::max(static_cast<int>(test::installed(table)), static_cast<int>(table.columns()) / 2)));
}

void expect_consistent(const SignalTable& table, const PlacementProblem& problem, std::size_t units,
                       const MaxCoverage& reach) {
  const Check check = check_selection(table, problem, reach.selected);
  EXPECT_TRUE(check.allowed());
  EXPECT_EQ(check.unmet, reach.missed);
  EXPECT_EQ(table.rows() - check.unmet.size(), reach.reached);
  EXPECT_LE(reach.selected.size(), units);
  EXPECT_TRUE(std::is_sorted(reach.selected.begin(), reach.selected.end()));
  for (std::uint32_t j = 0; j < table.columns(); ++j)
    EXPECT_TRUE(!table.transceivers[j].installed ||
                std::binary_search(reach.selected.begin(), reach.selected.end(), j));
}

void run(const milp::Backend& backend, std::uint64_t seed, int cases) {
  test::RandomTables with_all(seed, test::unweighed_tables), with_pairs(seed + 1000, pairs_only);
  int stopped = 0, one_more_reaches_more = 0;
  for (int k = 0; k < cases && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    test::RandomTables& tables = k % 8 < 4 ? with_all : with_pairs;
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    const std::size_t units = few_units(tables, table);
    const auto brute = BruteForce::budgets(table, problem);
    const BruteForce::Budget best = brute[std::min(units, table.columns())].value();
    const MaxCoverage reach = maximise_coverage(
        table, problem, units,
        {.solver = SolverChoice::mip, .backend = std::string(backend.name), .step_limit = 1 << 20},
        {.threads = 1});
    expect_consistent(table, problem, units, reach);
    EXPECT_LE(reach.reached, best.reached);
    EXPECT_GE(reach.upper_bound, best.reached);
    if (reach.status == Status::optimal) {
      EXPECT_EQ(reach.reached, best.reached);
      EXPECT_EQ(reach.upper_bound, best.reached);
      EXPECT_EQ(reach.selected.size(), best.units);
    } else {
      ++stopped;
    }
    one_more_reaches_more += units < table.columns() && brute[units + 1]->reached != best.reached;
  }
  EXPECT_GT(one_more_reaches_more, cases / 4);  // negative control
  EXPECT_LE(stopped, cases / 500);  // solvers sometimes give up on tables that are made to mislead them
}

class PlacementBudget : public testing::TestWithParam<milp::Backend> {};

INSTANTIATE_TEST_SUITE_P(Every, PlacementBudget, test::every_backend, test::backend_name);

TEST_P(PlacementBudget, EqualsEnumeration) {
  run(GetParam(), 71, 500);
}

// Without an exact solver: never more than possible, never a smaller bound, and both are often tight.
TEST(MaxCoverage, GreedyAndItsBoundEncloseTheOptimum) {
  test::RandomTables tables(73, test::unweighed_tables);
  int met = 0, tight = 0, below = 0, loose = 0, cases = 1500;
  for (int k = 0; k < cases; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    const std::size_t units = few_units(tables, table);
    const std::size_t best = BruteForce::budgets(table, problem)[units].value().reached;
    const MaxCoverage reach = maximise_coverage(table, problem, units, {.solver = SolverChoice::greedy});
    expect_consistent(table, problem, units, reach);
    ASSERT_LE(reach.reached, best) << k;
    ASSERT_GE(reach.upper_bound, best) << k;
    EXPECT_EQ(reach.status, reach.reached == reach.upper_bound ? Status::optimal : Status::feasible);
    met += reach.reached == best;
    tight += reach.upper_bound == best;
    below += reach.reached < best;      // negative controls: greedy is not always optimal,
    loose += reach.upper_bound > best;  // and the bound not always tight
  }
  EXPECT_GT(met, cases * 9 / 10);
  EXPECT_GT(tight, cases / 2);
  EXPECT_GT(below, 2);
  EXPECT_GT(loose, 25);
}

/// How often `maximise_coverage` differs from brute force with this rule omitted.
int differences(std::uint64_t seed, int cases, test::Omission omission, const PlaceOptions& options) {
  test::RandomTables tables(seed, test::weighed_tables);
  int result = 0;
  for (int k = 0; k < cases; ++k) {
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    const std::size_t units = test::some_units(tables, table);
    const auto best = BruteForce::weights(table, problem, omission)[units];
    const MaxCoverage reach = maximise_coverage(table, problem, units, options, {.threads = 1});
    EXPECT_EQ(reach.weight.has_value(), has_weights(table));
    const double reached = reach.weight ? reach.weight->reached : static_cast<double>(reach.reached);
    const double bound = reach.weight ? reach.weight->upper_bound : static_cast<double>(reach.upper_bound);
    if (best && omission == test::Omission::nothing) {
      EXPECT_LE(reached, best->reached * (1 + 1e-9)) << k;
      EXPECT_GE(bound, best->reached * (1 - 1e-9)) << k;
    }
    const bool is_equal = best && test::are_equal(reached, best->reached) &&
                          test::are_equal(bound, best->reached) && reach.status == Status::optimal &&
                          reach.selected.size() == best->units &&
                          test::are_equal(test::weight_of(table, problem, reach.selected), best->reached);
    result += is_equal ? 0 : 1;
  }
  return result;
}

TEST(MaxCoverage, EqualsBruteForce) {
  const PlaceOptions by_search{.solver = SolverChoice::search, .step_limit = 1 << 20};
  EXPECT_EQ(differences(92, 800, test::Omission::nothing, by_search), 0);
  // Negative controls: the comparison notices a rule that one side does not follow.
  for (const test::Omission omission :
       {test::Omission::mounts, test::Omission::conflicts, test::Omission::failure, test::Omission::weights,
        test::Omission::tolerance})
    EXPECT_GT(differences(92, 300, omission, by_search), 3) << static_cast<int>(omission);
}

TEST(MaxCoverage, WeighsLabelsInTheMip) {
  // Solvers sometimes give up on tables that are made to mislead them, and weights of six decimals are beyond
  // their accuracy: the bound then stays a little above the value.
  EXPECT_LE(
      differences(93, 300, test::Omission::nothing, {.solver = SolverChoice::mip, .step_limit = 1 << 20}), 8);
}

// Unit 2 is the greedy choice; 0 and 1 together reach one label more.
TEST(MaxCoverage, ByHand) {
  const SignalTable table =
      test::make_table({{1, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 1, 1}, {0, 1, 1}, {0, 1, 0}}, 3);
  for (const auto model : {coop, alone}) {
    MaxCoverage reach = maximise_coverage(table, {model}, 1, {});
    EXPECT_EQ(reach.selected, Selection{2});
    EXPECT_EQ(reach.reached, 4U);
    EXPECT_EQ(reach.upper_bound, 4U);
    EXPECT_EQ(reach.missed, (std::vector<LabelId>{2, 5}));
    for (const std::size_t units : {std::size_t{2}, std::size_t{3}, std::size_t{50}, std::size_t{1} << 32,
                                    std::numeric_limits<std::size_t>::max()}) {
      reach = maximise_coverage(table, {model}, units, {});
      EXPECT_EQ(reach.selected, (Selection{0, 1})) << "fewest units that reach all";
      EXPECT_EQ(reach.status, Status::optimal);
    }
    EXPECT_EQ(maximise_coverage(table, {.model = model, .redundant = true}, 1, {}).upper_bound, 0U);
    EXPECT_EQ(maximise_coverage(table, {.model = model, .redundant = true}, 3, {}).reached, 4U);
  }
}

// No step was interrupted, so the result is not marked as stopped.
TEST(MaxCoverage, ReportsATableThatIsTooLarge) {
  const SignalTable table = dense_table(900, 450);  // 405,000 entries
  const MaxCoverage reach = maximise_coverage(table, {}, 8, {.step_limit = 1000});
  EXPECT_TRUE(reach.too_large);
  EXPECT_EQ(reach.status, Status::feasible);
  EXPECT_EQ(reach.solver.method, Method::search);
  EXPECT_EQ(reach.bound_proof, BoundProof::dual);
  EXPECT_GT(reach.gap(), 0);
  EXPECT_LT(reach.gap(), 1);
  EXPECT_FALSE(maximise_coverage(dense_table(20, 10), {}, 3, {}).too_large);
}

// Without the limit this takes about ten seconds of search, and as much for the bound.
TEST(MaxCoverage, RespectsTheTimeLimit) {
  const SignalTable table = dense_table(4000, 1000);
  const MaxCoverage reach = maximise_coverage(table, {}, 7, {.time_limit_s = 0.2}, {.threads = 1});
  EXPECT_EQ(reach.status, Status::stopped);
  EXPECT_LT(reach.reached, reach.upper_bound);
  const MaxCoverage small =
      maximise_coverage(dense_table(200, 100), {}, 7, {.time_limit_s = 0.2}, {.threads = 1});
  EXPECT_EQ(small.status, Status::stopped);
}

TEST(MaxCoverage, IsWritten) {
  const SignalTable table = test::make_table({{1, 0}, {0, 1}}, 2);
  MaxCoverage reach = maximise_coverage(table, {}, 1, {});
  reach.solver = {Method::mip, "highs"};
  EXPECT_EQ(coverage_json(reach, table), R"({
  "format": 2,
  "model": "cooperative",
  "survives_failure": false,
  "at_most": 1,
  "selected": [
    "T0"
  ],
  "count": 1,
  "labels": 2,
  "reached": 1,
  "reached_upper_bound": 1,
  "gap": 0.0,
  "bound_proof": "dual",
  "status": "optimal",
  "too_large": false,
  "solver": "mip",
  "backend": "highs",
  "missed": [
    "L1"
  ]
}
)");
}

TEST(MaxCoverage, RejectsUnsupportedProblems) {
  SignalTable table = test::make_table({{1, 1}}, 2);
  test::expect_input_error([&] { maximise_coverage(table, {}, 1, {.backend = "cplex"}); }, "cplex");
  table.transceivers[0].installed = table.transceivers[1].installed = true;
  test::expect_input_error([&] { maximise_coverage(table, {}, 1, {}); }, "number of units: ", "2 units");
  table.labels[0].requirement = 0;
  test::expect_input_error([&] { maximise_coverage(table, {}, 2, {}); }, "label L0: ");
}

}  // namespace
}  // namespace shelfbeam
