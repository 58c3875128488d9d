#include "unit/placement/brute_force.hpp"

#include <cmath>
#include <string>

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
  };
  const auto any = [](const Check&) { return true; };
  const Case cases[] = {
      {Omission::last_label, 30, any},
      {Omission::installed, 15, any},
      {Omission::second_objective, 100, any},
      {Omission::tolerance, 10, any},
      {Omission::mounts, 50, [](const Check& c) { return c.unmet.empty() && c.too_close.empty(); }},
      {Omission::conflicts, 15, [](const Check& c) { return c.unmet.empty() && c.crowded.empty(); }},
      {Omission::failure, 50, [](const Check& c) { return c.too_close.empty() && c.crowded.empty(); }}};
  for (const Case& one : cases) {
    SCOPED_TRACE(static_cast<int>(one.omission));
    const bool is_of_the_paper = one.omission < Omission::mounts;
    test::RandomTables tables(1, is_of_the_paper ? test::RandomTableLimits{} : test::beyond_the_paper);
    int noticed = 0;
    for (int k = 0; k < 500; ++k) {
      const SignalTable table = tables.next();
      const PlacementProblem problem = tables.next_problem();
      const BruteForce brute(table, problem), wrong(table, problem, one.omission);
      const double best = brute.best(problem), other = wrong.best(problem);
      const bool differs =
          wrong.feasible != brute.feasible || (brute.feasible && std::abs(best - other) > 2e-6 * best);
      if (!differs) continue;
      ++noticed;
      const bool is_weighted = problem.combination == Combination::weighted;
      if (is_of_the_paper) continue;
      const Check check = check_selection(table, problem, is_weighted ? wrong.of_best_sum : wrong.at_fewest);
      EXPECT_TRUE(!check.met() && one.is_reason(check));
    }
    EXPECT_GT(noticed, one.least);
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
  compare_random(1, 2000, {}, options());
}

TEST_P(PlacementBruteForce, EqualsEnumerationWithSharedMountingPoints) {
  EXPECT_GT(compare_random(3, 2000, {.mounts = true}, options()).by_exclusion, 50);
}

TEST_P(PlacementBruteForce, EqualsEnumerationWhereAUnitMayFailAndPairsAreForbidden) {
  EXPECT_GT(compare_random(5, 2000, test::beyond_the_paper, options()).by_exclusion, 50);
}

TEST_P(PlacementBruteForceSlow, EqualsEnumerationWithMoreLabelsAndUnits) {
  compare_random(14, 4000, {.labels = 30, .transceivers = 12}, options());
}

}  // namespace
}  // namespace shelfbeam
