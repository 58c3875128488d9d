#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/coverage/coverage_curve.hpp"
#include "shelfbeam/placement/coverage/fewest_units.hpp"
#include "shelfbeam/placement/coverage/max_coverage.hpp"
#include "shelfbeam/placement/scenarios/place_over_scenarios.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"
#include "unit/placement/scenarios/random_scenarios.hpp"

namespace shelfbeam {
namespace {

using test::BruteForce;
using test::Omission;

/// An answer to a question that minimises something; a maximum counts with the opposite sign.
struct Claim {
  double value = test::infinite;  ///< of the selection; test::infinite without one
  double bound = -test::infinite;
  bool is_final = false;  ///< optimal, or infeasible if the value is test::infinite
};

/// Solvers prove optima within a relative gap of 1e-6.
bool is_wrong(const Claim& claim, double best) {
  const double rounding = std::isfinite(best) ? 2e-6 * std::abs(best) : 0;
  return claim.value < best - rounding || claim.bound > best + rounding ||
         (claim.is_final && claim.value > best + rounding);
}

struct Score {
  int asked = 0, wrong = 0, infeasible = 0, open = 0;

  void add(const Claim& claim, double best) {
    ++asked;
    wrong += is_wrong(claim, best) ? 1 : 0;
    infeasible += std::isinf(best) ? 1 : 0;
    open += claim.is_final ? 0 : 1;
  }
};

constexpr test::RandomTableLimits limits{
    .labels = 8, .transceivers = 10, .mounts = true, .conflicts = true, .redundant = true, .weights = true};

/// Random questions of one goal, compared with enumerations that omit a rule.
class Questions {
 public:
  Questions(std::uint64_t seed, Omission omission)
      : tables_(seed, limits), states_(static_cast<unsigned>(seed)), omission_(omission) {}

  Score whole(int cases) {
    return ask(cases, [this](const SignalTable& table, PlacementProblem problem, Score& tally) {
      if (tables_.chance(0.3))
        problem = {.model = problem.model, .combination = Combination::spend, .redundant = problem.redundant};
      const Placement answer = place(table, problem, options_, {.threads = 1});
      tally.add({answer.has_selection() ? answer.objective_value : test::infinite, answer.lower_bound,
                 answer.status == Status::optimal || answer.status == Status::infeasible},
                least(table, problem));
    });
  }

  Score at_most(int cases) {
    return ask(cases, [this](const SignalTable& table, const PlacementProblem& problem, Score& tally) {
      const auto units = static_cast<std::size_t>(tables_.whole(0, static_cast<int>(table.columns())));
      const auto best = BruteForce::weights(table, problem, omission_)[units];
      const auto all_best = BruteForce::weights(table, problem)[units];
      if (!all_best) return;  // more units are installed
      const MaxCoverage answer = maximise_coverage(table, problem, units, options_, {.threads = 1});
      const double reached = answer.weight ? answer.weight->reached : static_cast<double>(answer.reached);
      const double bound =
          answer.weight ? answer.weight->upper_bound : static_cast<double>(answer.upper_bound);
      tally.add({-reached, -bound, answer.status == Status::optimal}, best ? -best->reached : test::infinite);
    });
  }

  Score reach(int cases) {
    return ask(cases, [this](const SignalTable& table, const PlacementProblem& problem, Score& tally) {
      const double share = tables_.chance(0.1) ? 1 : tables_.real(0.05, 1);
      const auto best = BruteForce::weights(table, problem, omission_);
      double total = 0;
      for (const auto& label : table.labels) total += label.weight;
      std::size_t fewest = 0;
      while (fewest < best.size() && (!best[fewest] || best[fewest]->reached < share * total * (1 - 1e-9)))
        ++fewest;
      const FewestUnits answer = fewest_units(table, problem, share, options_, {.threads = 1});
      const bool is_infeasible = answer.status == Status::infeasible;
      tally.add({answer.has_selection ? static_cast<double>(answer.selected.size()) : test::infinite,
                 is_infeasible ? test::infinite : static_cast<double>(answer.count_lower_bound),
                 is_infeasible || answer.status == Status::optimal},
                fewest == best.size() ? test::infinite : static_cast<double>(fewest));
    });
  }

  Score curve(int cases) {
    return ask(cases, [this](const SignalTable& table, PlacementProblem problem, Score& tally) {
      problem = {.model = problem.model, .redundant = problem.redundant};
      const Placement placement = place(table, problem, options_, {.threads = 1});
      if (!placement.has_selection()) return;
      const auto best = BruteForce::weights(table, problem, omission_);
      for (const CurvePoint& point :
           coverage_curve(table, problem, placement.selected, {.threads = 1}).points) {
        const WeightRange range = point.weight.value_or(
            WeightRange{static_cast<double>(point.at_least), static_cast<double>(point.at_most)});
        const auto& truth = best[std::min(point.units, table.columns())];
        tally.add({-range.at_least, -range.at_most, range.at_least == range.at_most},
                  truth ? -truth->reached : test::infinite);
      }
    });
  }

  Score over_states(int cases) {
    Score tally;
    for (int k = 0; k < cases; ++k) {
      PlacementProblem problem{.model = tables_.chance(0.5) ? test::coop : test::alone,
                               .redundant = tables_.chance(0.2)};
      if (tables_.chance(0.3)) problem.combination = Combination::spend;
      const ScenarioTable states = states_.next(tables_.chance(0.5), problem.redundant ? 2.5 : 1.5);
      const MissAllowance allowance = states_.allowance(static_cast<test::Rule>(tables_.whole(0, 2)));
      PlacementProblem asked = problem;
      if (omission_ == Omission::failure) asked.redundant = false;
      const ScenarioPlacement answer =
          place_over_scenarios(states, problem, allowance, {.time_limit_s = 1}, {.threads = 1});
      tally.add(
          {answer.has_selection() ? answer.value : test::infinite, answer.lower_bound, answer.is_proven()},
          test::best_by_enumeration(states, asked, allowance));
    }
    return tally;
  }

 private:
  template <class Ask>
  Score ask(int cases, const Ask& ask) {
    Score tally;
    while (tally.asked < cases) {
      const SignalTable table = tables_.next();
      const PlacementProblem problem = tables_.next_problem();
      ask(table, problem, tally);
    }
    return tally;
  }

  // The installed units cost nothing new.
  double least(const SignalTable& table, const PlacementProblem& problem) const {
    if (problem.combination != Combination::spend) {
      const BruteForce brute(table, problem, omission_);
      return brute.feasible ? brute.best(problem) : test::infinite;
    }
    double least = test::infinite;
    for (const auto& answer : BruteForce::answers(table, problem, omission_)) {
      double spend = 0;
      for (const std::uint32_t j : answer.columns)
        if (!table.transceivers[j].installed) spend += table.transceivers[j].cost;
      least = std::min(least, spend);
    }
    return least;
  }

  test::RandomTables tables_;
  test::RandomScenarios states_;
  Omission omission_;
  PlaceOptions options_{.step_limit = 1 << 20};
};

struct Goal {
  const char* name;
  Score (Questions::*ask)(int);
  int cases;
};

class RandomQuestionsSlow : public testing::TestWithParam<Goal> {};

TEST_P(RandomQuestionsSlow, EqualBruteForce) {
  const Goal& goal = GetParam();
  const Score tally = (Questions(2026, Omission::nothing).*goal.ask)(goal.cases);
  RecordProperty("asked", tally.asked);
  RecordProperty("open", tally.open);
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_GE(tally.asked, goal.cases);
  EXPECT_LT(tally.infeasible, tally.asked * 4 / 5);
  EXPECT_LT(tally.open, tally.asked / 4);
  EXPECT_GT((Questions(2026, Omission::failure).*goal.ask)(goal.cases / 20).wrong, 0)
      << "a comparison must be able to fail";
}

// 20,000 questions.
INSTANTIATE_TEST_SUITE_P(Every, RandomQuestionsSlow,
                         testing::Values(Goal{"Place", &Questions::whole, 7600},
                                         Goal{"AtMost", &Questions::at_most, 4000},
                                         Goal{"Reach", &Questions::reach, 4000},
                                         Goal{"Curve", &Questions::curve, 4000},
                                         Goal{"OverStates", &Questions::over_states, 400}),
                         [](const auto& goal) { return std::string(goal.param.name); });

}  // namespace
}  // namespace shelfbeam
