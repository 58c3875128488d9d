#include "shelfbeam/placement/scenarios/scenario_cuts.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/windows/window_mips.hpp"

#include "unit/placement/scenarios/random_scenarios.hpp"

namespace shelfbeam {
namespace {

using test::RandomScenarios;
using test::Rule;

double left_side(const SignalTable& table, std::size_t row, std::uint32_t set) {
  double sum = 0;
  for (const SignalEntry& entry : table.row(row))
    if ((set >> entry.transceiver & 1U) != 0) sum += entry.signal;
  return sum;
}

// Every selection of at most K units that keeps to the allowance must satisfy every cut for K units; some
// larger ones must not, or the limit would not matter.
TEST(ScenarioCuts, OfLinearProgramsHoldForEverySmallSelection) {
  RandomScenarios random(3);
  const PlacementProblem problem;
  std::size_t added = 0, cut_off = 0, larger_cut_off = 0;
  for (int k = 0; k < 60; ++k) {
    SCOPED_TRACE(k);
    const ScenarioTable scenarios = random.next(false);
    const MissAllowance allowance = random.allowance(k % 3 == 0 ? Rule::total : Rule::label);
    const std::size_t max_units = 2 + static_cast<std::size_t>(k % 3);
    ScenarioCuts cuts(scenarios, problem, allowance);
    std::vector<double> x(8);
    for (double& value : x) value = 0.4 * random.uniform();
    const std::size_t before = cuts.size();
    added += cuts.add_violated(x, max_units, detail::for_seconds(60), {});
    for (std::uint32_t set = 0; set < 256; ++set) {
      const bool keeps = test::value_of_set(scenarios, problem, allowance, set).has_value();
      const bool is_small = static_cast<std::size_t>(std::popcount(set)) <= max_units;
      for (std::size_t row = 0; row < cuts.size(); ++row) {
        const bool holds = left_side(cuts.table(), row, set) >= 1;
        const bool must_hold = keeps && (is_small || row < before);
        EXPECT_TRUE(holds || !must_hold) << set << " " << row;
        cut_off += !keeps && !holds ? 1 : 0;
        larger_cut_off += keeps && !is_small && !holds ? 1 : 0;
      }
    }
  }
  EXPECT_GT(added, 60U);
  EXPECT_GT(cut_off, 0U);
  EXPECT_GT(larger_cut_off, 0U);
}

// Windows exceed K only if no selection of at most K units keeps to the allowance.
TEST(ScenarioCuts, WindowsExceedOnlyImpossibleCounts) {
  RandomScenarios random(5);
  const PlacementProblem problem;
  const std::vector<double> cost(8, 1);
  int exceeded = 0;
  for (int k = 0; k < 60; ++k) {
    SCOPED_TRACE(k);
    const ScenarioTable scenarios = random.next(k % 2 == 1);
    const MissAllowance allowance = random.allowance(Rule::label);
    const std::size_t max_units = 1 + static_cast<std::size_t>(k % 3);
    ScenarioCuts cuts(scenarios, problem, allowance);
    cuts.add_violated(std::vector<double>(8, 0.1), max_units, detail::for_seconds(60), {});
    const double goal = static_cast<double>(max_units) + 1e-3;
    const double bound = detail::window_mip_bound(
        {cuts.table(), problem}, cost, {.goal = goal, .effort = detail::for_seconds(60), .windows = 2},
        milp::backends().front(), {});
    const double best = test::best_by_enumeration(scenarios, problem, allowance);
    EXPECT_TRUE(bound < goal || best > static_cast<double>(max_units));
    exceeded += bound >= goal ? 1 : 0;
  }
  EXPECT_GE(exceeded, 10);
}

TEST(ScenarioCuts, OfLinearProgramsAreViolatedByThem) {
  RandomScenarios random(4);
  const ScenarioTable scenarios = random.next(false);
  const PlacementProblem problem;
  const MissAllowance allowance{.of_label = std::vector<std::uint32_t>(5, 1)};
  ScenarioCuts cuts(scenarios, problem, allowance);
  const std::size_t before = cuts.size();
  const std::vector<double> x(8, 0.1);
  ASSERT_GT(cuts.add_violated(x, 3, detail::for_seconds(60), {}), 0U);
  for (std::size_t row = before; row < cuts.size(); ++row) {
    double sum = 0;
    for (const SignalEntry& entry : cuts.table().row(row)) sum += entry.signal * x[entry.transceiver];
    EXPECT_LT(sum, 1);
  }
}

}  // namespace
}  // namespace shelfbeam
