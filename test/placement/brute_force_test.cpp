#include "brute_force.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/checker.hpp"
#include "shelfbeam/placement/placement.hpp"

#include "random_table.hpp"

namespace shelfbeam {
namespace {

using test::BruteForce;
using test::Omission;

double best_value(const BruteForce& brute, const Question& question) {
  if (question.combination == Combination::weighted) return brute.best_sum;
  return question.objective == Objective::count ? static_cast<double>(brute.fewest) : brute.best_at_fewest;
}

// Solvers prove optima within a relative gap of 1e-6; sums of up to 140 doubles add less than 1e-13.
bool same(double a, double b) {
  return std::abs(a - b) <= 2e-6 * std::max(std::abs(a), std::abs(b));
}

/// Compares one answer with enumeration.
void compare(const SignalTable& table, const Question& question, const Placement& answer,
             const BruteForce& brute) {
  if (!brute.feasible) {
    EXPECT_EQ(answer.status, Status::infeasible);
    EXPECT_FALSE(answer.unreachable.empty());
    EXPECT_TRUE(answer.selected.empty());
    return;
  }
  EXPECT_TRUE(answer.unreachable.empty());
  EXPECT_TRUE(check_selection(table, question, answer.selected).met());
  for (std::uint32_t j = 0; j < table.columns(); ++j)
    EXPECT_TRUE(!table.transceivers[j].installed ||
                std::binary_search(answer.selected.begin(), answer.selected.end(), j));
  const double expected = best_value(brute, question);
  if (answer.status == Status::stopped) {
    EXPECT_LE(answer.lower_bound, expected * (1 + 2e-6));
    EXPECT_LE(answer.count_lower_bound, static_cast<double>(brute.fewest));
    return;
  }
  EXPECT_EQ(answer.status, Status::optimal);
  EXPECT_TRUE(same(answer.objective_value, expected)) << answer.objective_value << " instead of " << expected;
  EXPECT_TRUE(same(answer.lower_bound, expected)) << answer.lower_bound << " instead of " << expected;
  EXPECT_LE(answer.count_lower_bound, static_cast<double>(brute.fewest));
  if (question.combination == Combination::lexicographic) {
    EXPECT_EQ(answer.count(), brute.fewest);
    EXPECT_EQ(answer.count_lower_bound, static_cast<double>(brute.fewest));
  }
}

/// How often enumeration with one thing left out gives another answer: the comparison must be able to fail.
struct Controls {
  int last_label = 0, installed = 0, second_objective = 0, tolerance = 0;

  void look(const SignalTable& table, const Question& question, const BruteForce& brute) {
    const auto differs = [&](Omission omission) {
      const BruteForce wrong(table, question, omission);
      return wrong.feasible != brute.feasible ||
             (brute.feasible && !same(best_value(wrong, question), best_value(brute, question)));
    };
    last_label += differs(Omission::last_label);
    installed += differs(Omission::installed);
    second_objective += differs(Omission::second_objective);
    tolerance += differs(Omission::tolerance);
  }
};

void run(std::string_view backend, std::uint64_t seed, int cases, Controls* controls = nullptr) {
  test::RandomTables tables(seed);
  int infeasible = 0;
  int stopped = 0;
  for (int k = 0; k < cases && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = tables.next();
    const Question question = tables.next_question();
    const BruteForce brute(table, question);
    compare(table, question, place(table, question, {.backend = std::string(backend)}, {.threads = 1}),
            brute);
    infeasible += !brute.feasible;
    if (controls != nullptr && k % 4 == 0) controls->look(table, question, brute);
  }
  EXPECT_GT(infeasible, cases / 20);
  EXPECT_LT(infeasible, cases / 2);
  // A quarter of the tables are made to mislead solvers. One that notices may give up on a case now and then
  // (`place` then asks the next); it must never claim a wrong optimum.
  EXPECT_LE(stopped, cases / 1000);
}

class PlacementBruteForce : public testing::TestWithParam<milp::Backend> {};
class PlacementBruteForceSlow : public testing::TestWithParam<milp::Backend> {};

std::string name(const testing::TestParamInfo<milp::Backend>& info) {
  return std::string(info.param.name);
}
const auto every_backend = testing::ValuesIn(milp::backends().begin(), milp::backends().end());
INSTANTIATE_TEST_SUITE_P(Every, PlacementBruteForce, every_backend, name);
INSTANTIATE_TEST_SUITE_P(Every, PlacementBruteForceSlow, every_backend, name);

TEST_P(PlacementBruteForce, EqualsEnumerationForEveryModelAndObjective) {
  Controls controls;
  run(GetParam().name, 1, 2000, &controls);
  // 500 cases looked at: leaving anything out must show in a good part of them.
  EXPECT_GT(controls.last_label, 50);
  EXPECT_GT(controls.installed, 25);
  EXPECT_GT(controls.second_objective, 100);
  EXPECT_GT(controls.tolerance, 10);
}

TEST_P(PlacementBruteForceSlow, EqualsEnumerationOnManyMore) {
  run(GetParam().name, 2, 30000);
}

}  // namespace
}  // namespace shelfbeam
