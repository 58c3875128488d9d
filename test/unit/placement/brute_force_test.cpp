#include "unit/placement/brute_force.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/random_table.hpp"

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

/// The labels that no selection meets, each with the most it could get; sums of 14 doubles in another order
/// differ by less than 1e-14. There are none where candidates exclude one another, and those
/// that are within 1e-12 of the rule's edge need not be named then.
void expect_unreachable(const SignalTable& table, const Question& question, const Placement& answer) {
  const std::vector<double> most = BruteForce::most(table, question);
  std::vector<std::uint32_t> expected, named;
  for (std::uint32_t i = 0; i < table.rows(); ++i) {
    const double slack = table.mounts.empty() && !question.redundant ? 0 : 1e-12 * most[i];
    if (!is_met(most[i] + slack, requirement_of(table.labels[i], question.model))) expected.push_back(i);
  }
  for (const Unreachable& label : answer.unreachable) {
    named.push_back(label.label);
    EXPECT_NEAR(label.most, most[label.label], 1e-14 * most[label.label]);
  }
  EXPECT_EQ(named, expected);
}

/// Compares one answer with enumeration.
void compare(const SignalTable& table, const Question& question, const Placement& answer,
             const BruteForce& brute) {
  if (!brute.feasible) {
    EXPECT_EQ(answer.status, Status::infeasible);
    EXPECT_TRUE(answer.selected.empty());
    EXPECT_TRUE(std::isinf(answer.count_lower_bound) && std::isinf(answer.lower_bound));
    expect_unreachable(table, question, answer);
    return;
  }
  EXPECT_TRUE(answer.unreachable.empty());
  const bool empty_handed = answer.status == Status::stopped && std::isinf(answer.objective_value);
  EXPECT_TRUE(empty_handed || check_selection(table, question, answer.selected).met());
  for (std::uint32_t j = 0; j < table.columns(); ++j)
    EXPECT_TRUE(empty_handed || !table.transceivers[j].installed ||
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
  int last_label = 0, installed = 0, second_objective = 0, tolerance = 0, mounts = 0, apart = 0, failure = 0;

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
    if (differs(Omission::mounts)) {
      ++mounts;
      const Check check = check_of(table, question, Omission::mounts);
      EXPECT_TRUE(check.unmet.empty() && check.too_close.empty() && !check.crowded.empty());
    }
    if (differs(Omission::apart)) {
      ++apart;
      const Check check = check_of(table, question, Omission::apart);
      EXPECT_TRUE(check.unmet.empty() && !check.too_close.empty() && check.crowded.empty());
    }
    if (differs(Omission::failure)) {
      ++failure;
      const Check check = check_of(table, question, Omission::failure);
      EXPECT_TRUE(!check.unmet.empty() && check.too_close.empty() && check.crowded.empty());
    }
  }

  // What is better because something was left out must be rejected for just that.
  static Check check_of(const SignalTable& table, const Question& question, Omission omission) {
    const BruteForce wrong(table, question, omission);
    const std::uint32_t set =
        question.combination == Combination::weighted ? wrong.set_of_best_sum : wrong.set_at_fewest;
    std::vector<std::uint32_t> selected;
    for (std::uint32_t j = 0; j < table.columns(); ++j)
      if ((set >> j & 1U) != 0) selected.push_back(j);
    Check check = check_selection(table, question, selected);
    EXPECT_FALSE(check.met());
    return check;
  }
};

/// How often answers were of a kind.
struct Kinds {
  int infeasible = 0;
  int by_exclusion = 0;  ///< infeasible although every label alone could be met
  int stopped = 0;
};

Kinds run(std::string_view backend, std::uint64_t seed, int cases, test::RandomTableLimits limits = {},
          Controls* controls = nullptr) {
  test::RandomTables tables(seed, limits);
  Kinds kinds;
  for (int k = 0; k < cases && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = tables.next();
    const Question question = tables.next_question();
    const BruteForce brute(table, question);
    const Placement answer = place(table, question, {.backend = std::string(backend)}, {.threads = 1});
    compare(table, question, answer, brute);
    kinds.infeasible += !brute.feasible;
    kinds.by_exclusion += !brute.feasible && answer.unreachable.empty();
    kinds.stopped += answer.status == Status::stopped;
    if (controls != nullptr && k % 4 == 0) controls->look(table, question, brute);
  }
  EXPECT_GT(kinds.infeasible, cases / 20);
  EXPECT_LT(kinds.infeasible, cases * 2 / 3);
  // A quarter of the tables are made to mislead solvers. One that notices may give up on a case now and then
  // (`place` then asks the next); it must never claim a wrong optimum.
  EXPECT_LE(kinds.stopped, cases / 1000);
  return kinds;
}

class PlacementBruteForce : public testing::TestWithParam<milp::Backend> {};
class PlacementBruteForceSlow : public testing::TestWithParam<milp::Backend> {};

std::string name(const testing::TestParamInfo<milp::Backend>& info) {
  return std::string(info.param.name);
}
constexpr test::RandomTableLimits beyond_the_paper{
    .labels = 5, .transceivers = 12, .mounts = true, .apart = true, .redundant = true};
const auto every_backend = testing::ValuesIn(milp::backends().begin(), milp::backends().end());
INSTANTIATE_TEST_SUITE_P(Every, PlacementBruteForce, every_backend, name);
INSTANTIATE_TEST_SUITE_P(Every, PlacementBruteForceSlow, every_backend, name);

TEST_P(PlacementBruteForce, EqualsEnumerationForEveryModelAndObjective) {
  Controls controls;
  run(GetParam().name, 1, 2000, {}, &controls);
  // 500 cases looked at: leaving anything out must show in a good part of them.
  EXPECT_GT(controls.last_label, 50);
  EXPECT_GT(controls.installed, 25);
  EXPECT_GT(controls.second_objective, 100);
  EXPECT_GT(controls.tolerance, 10);
}

TEST_P(PlacementBruteForce, EqualsEnumerationWithSharedMountingPoints) {
  Controls controls;
  const Kinds kinds = run(GetParam().name, 3, 2000, {.mounts = true}, &controls);
  EXPECT_GT(kinds.by_exclusion, 50);
  EXPECT_GT(controls.mounts, 50);
}

TEST_P(PlacementBruteForce, EqualsEnumerationWhereAUnitMayFailAndPairsAreForbidden) {
  Controls controls;
  const Kinds kinds = run(GetParam().name, 5, 2000, beyond_the_paper, &controls);
  EXPECT_GT(kinds.by_exclusion, 50);
  EXPECT_GT(controls.apart, 25);
  EXPECT_GT(controls.failure, 50);
}

TEST_P(PlacementBruteForceSlow, EqualsEnumerationOnManyMoreWhereAUnitMayFailAndPairsAreForbidden) {
  EXPECT_GT(run(GetParam().name, 6, 30000, beyond_the_paper).by_exclusion, 500);
}

TEST_P(PlacementBruteForceSlow, EqualsEnumerationOnManyMoreWithSharedMountingPoints) {
  EXPECT_GT(run(GetParam().name, 4, 30000, {.mounts = true}).by_exclusion, 500);
}

TEST_P(PlacementBruteForceSlow, EqualsEnumerationOnManyMore) {
  run(GetParam().name, 2, 30000);
}

}  // namespace
}  // namespace shelfbeam
