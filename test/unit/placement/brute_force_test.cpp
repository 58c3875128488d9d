#include "unit/placement/brute_force.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/milp/every_backend.hpp"
#include "unit/placement/enumeration.hpp"

namespace shelfbeam {
namespace {

using test::BruteForce;
using test::compare_random;
using test::Omission;

// Counts how often enumeration without one rule has another result, because comparisons with it must be able
// to fail. The checker must reject a better value that breaks the omitted rule.
TEST(BruteForce, DetectsEveryOmission) {
  struct Case {
    Omission omission;
    int least;  ///< of 500 problems
    bool (*is_reason)(const Check&);
    int noticed = 0;
  };
  const auto any = [](const Check&) { return true; };
  std::vector<Case> of_the_paper = {{Omission::last_label, 30, any},
                                    {Omission::installed, 15, any},
                                    {Omission::second_objective, 100, any},
                                    {Omission::tolerance, 10, any}};
  std::vector<Case> beyond = {
      {Omission::mounts, 50, [](const Check& c) { return c.unmet.empty() && c.too_close.empty(); }},
      {Omission::conflicts, 15, [](const Check& c) { return c.unmet.empty() && c.crowded.empty(); }},
      {Omission::failure, 50, [](const Check& c) { return c.too_close.empty() && c.crowded.empty(); }}};
  for (std::vector<Case>* cases : {&of_the_paper, &beyond}) {
    test::RandomTables tables(1, cases == &beyond ? test::beyond_the_paper : test::RandomTableLimits{});
    for (int k = 0; k < 500; ++k) {
      const SignalTable table = tables.next();
      const PlacementProblem problem = tables.next_problem();
      const BruteForce brute(table, problem);
      const double best = brute.best(problem);
      for (Case& one : *cases) {
        const BruteForce wrong(table, problem, one.omission);
        const double other = wrong.best(problem);
        const bool differs =
            wrong.feasible != brute.feasible || (brute.feasible && std::abs(best - other) > 2e-6 * best);
        if (!differs) continue;
        ++one.noticed;
        const bool is_weighted = problem.combination == Combination::weighted;
        if (cases == &of_the_paper) continue;
        const Check check =
            check_selection(table, problem, is_weighted ? wrong.of_best_sum : wrong.at_fewest);
        EXPECT_TRUE(!check.met() && one.is_reason(check)) << static_cast<int>(one.omission);
      }
    }
    for (const Case& one : *cases) EXPECT_GT(one.noticed, one.least) << static_cast<int>(one.omission);
  }
}

class PlacementBruteForce : public testing::TestWithParam<milp::Backend> {
 protected:
  static PlaceOptions options() {
    return {.backend = std::string(GetParam().name), .step_limit = test::ample_steps};
  }
};
using PlacementBruteForceSlow = PlacementBruteForce;

INSTANTIATE_TEST_SUITE_P(Every, PlacementBruteForce, test::every_backend, test::backend_name);
INSTANTIATE_TEST_SUITE_P(Every, PlacementBruteForceSlow, test::every_backend, test::backend_name);

TEST_P(PlacementBruteForce, EqualsEnumerationForEveryModelAndObjective) {
  compare_random(1, 1200, {}, options());
}

TEST_P(PlacementBruteForce, EqualsEnumerationWithSharedMountingPoints) {
  EXPECT_GT(compare_random(3, 1200, {.mounts = true}, options()).by_exclusion, 30);
}

TEST_P(PlacementBruteForce, EqualsEnumerationWhereAUnitMayFailAndPairsAreForbidden) {
  EXPECT_GT(compare_random(5, 1200, test::beyond_the_paper, options()).by_exclusion, 30);
}

TEST_P(PlacementBruteForceSlow, EqualsEnumerationWithMoreLabelsAndUnits) {
  compare_random(14, 4000, {.labels = 30, .transceivers = 12}, options());
}

}  // namespace
}  // namespace shelfbeam
