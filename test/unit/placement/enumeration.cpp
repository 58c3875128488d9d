#include "unit/placement/enumeration.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam::test {

namespace {

using Answer = BruteForce::Answer;

double value_of(const Answer& answer, const PlacementProblem& problem) {
  if (problem.combination == Combination::weighted) return answer.price + answer.second_objective;
  return problem.objective == Objective::count ? static_cast<double>(answer.columns.size())
                                               : answer.second_objective;
}

// The labels that no selection reaches, each with its maximum signal; sums of 14 doubles in another order
// differ by less than 1e-14. The list is empty if conflicts are the reason. Labels within 1e-12 of the rule's
// edge may be missing from it.
void expect_unreachable(const SignalTable& table, const PlacementProblem& problem, const Placement& answer) {
  const std::vector<double> most = BruteForce::most(table, problem);
  std::vector<LabelId> expected, named;
  for (std::uint32_t i = 0; i < table.rows(); ++i) {
    const double slack = table.mounts.empty() && !problem.redundant ? 0 : 1e-12 * most[i];
    if (!is_met(most[i] + slack, requirement_of(table.labels[i], problem.model))) expected.push_back(i);
  }
  for (const Unreachable& label : answer.unreachable) {
    named.push_back(label.label);
    EXPECT_NEAR(label.max_signal, most[label.label], 1e-14 * most[label.label]);
  }
  EXPECT_EQ(named, expected);
}

// Among optimal selections, expects the one with the largest minimum margin, then the smallest count, then
// the first by id, unless sums in another order leave this in doubt.
void expect_settled(const SignalTable& table, const PlacementProblem& problem, const Placement& answer,
                    std::vector<Answer> best, Tally& tally) {
  // Selections that cost no more than the result, up to 1e-12 of it (the optimum is proven to 1e-9); the
  // tables of near-ties contain some about that far off.
  const double value = answer.objective_value;
  std::erase_if(best, [&](const Answer& one) { return value_of(one, problem) > value * (1 + 1e-11); });
  const auto in_doubt = [&](const Answer& one) { return value_of(one, problem) > value * (1 + 1e-14); };
  if (std::any_of(best.begin(), best.end(), in_doubt)) return;
  double widest = 0;
  for (const Answer& one : best) widest = std::max(widest, one.margin);
  const auto nearly = [&](const Answer& one) {
    return one.margin < widest && one.margin > widest * (1 - 1e-12);
  };
  if (std::any_of(best.begin(), best.end(), nearly)) return;
  tally.more_than_one += best.size() > 1;
  const auto rank = [&](const Answer& one) {
    return std::tuple(-one.margin, one.columns.size(), BruteForce::ids(table, one.columns));
  };
  const auto first = std::min_element(best.begin(), best.end(),
                                      [&](const Answer& a, const Answer& b) { return rank(a) < rank(b); });
  EXPECT_EQ(answer.selected, first->columns);
}

}  // namespace

void compare(const SignalTable& table, const PlacementProblem& problem, const Placement& answer,
             Tally& tally) {
  std::vector<Answer> best = BruteForce::answers(table, problem);
  if (best.empty()) {
    EXPECT_EQ(answer.status, Status::infeasible);
    EXPECT_TRUE(answer.selected.empty());
    EXPECT_TRUE(std::isinf(answer.count_lower_bound) && std::isinf(answer.lower_bound));
    expect_unreachable(table, problem, answer);
    ++tally.infeasible;
    tally.by_exclusion += answer.unreachable.empty();
    return;
  }
  EXPECT_TRUE(answer.unreachable.empty());
  if (answer.has_selection()) {
    EXPECT_TRUE(check_selection(table, problem, answer.selected).met());
    EXPECT_TRUE(std::any_of(best.begin(), best.end(),
                            [&](const Answer& one) { return one.columns == answer.selected; }));
  }
  std::size_t fewest = table.columns();
  for (const Answer& one : best) fewest = std::min(fewest, one.columns.size());
  EXPECT_LE(answer.count_lower_bound, static_cast<double>(fewest));
  const bool is_lexicographic = problem.combination == Combination::lexicographic;
  if (is_lexicographic) std::erase_if(best, [&](const Answer& one) { return one.columns.size() > fewest; });
  double least = value_of(best.front(), problem);
  for (const Answer& one : best) least = std::min(least, value_of(one, problem));
  // Solvers prove optima within a relative gap of 1e-6; sums of up to 140 doubles add less than 1e-13.
  const double rounding = answer.bound_proof == BoundProof::solver ? 2e-6 : 2e-9;
  EXPECT_LE(answer.lower_bound, least * (1 + rounding));
  if (answer.status == Status::stopped) {
    ++tally.stopped;
    EXPECT_FALSE(answer.ties_settled);
    return;
  }
  ++tally.optimal;
  ++tally.by[static_cast<int>(answer.bound_proof)];
  EXPECT_EQ(answer.status, Status::optimal);
  EXPECT_NEAR(answer.objective_value, least, 2e-6 * least);
  EXPECT_NEAR(answer.lower_bound, least, 2e-6 * least);
  if (is_lexicographic) {
    EXPECT_EQ(answer.count(), fewest);
    EXPECT_EQ(answer.count_lower_bound, static_cast<double>(fewest));
  }
  if (!answer.ties_settled) return;
  ++tally.settled;
  expect_settled(table, problem, answer, std::move(best), tally);
}

Tally compare_random(std::uint64_t seed, int cases, const RandomTableLimits& limits,
                     const PlaceOptions& options) {
  RandomTables random(seed, limits);
  Tally tally;
  for (int k = 0; k < cases && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = random.next();
    const PlacementProblem problem = random.next_problem();
    const Placement answer = place(table, problem, options, {.threads = 1});
    compare(table, problem, answer, tally);
    if (k % 8 == 0 && answer.ties_settled) {
      EXPECT_EQ(place(table, problem, options, {.threads = 4}).selected, answer.selected);
    }
  }
  EXPECT_GT(tally.infeasible, cases / 20);
  EXPECT_LT(tally.infeasible, cases * 3 / 4);
  // A quarter of the tables are made to mislead solvers. A solver that notices may sometimes give up (`place`
  // then uses the next); it must never claim a wrong optimum.
  EXPECT_LE(tally.stopped, cases / 1000);
  EXPECT_GT(tally.settled, tally.optimal * 9 / 10);
  EXPECT_GT(tally.more_than_one, cases / 50);
  EXPECT_GT(tally.count(BoundProof::log), cases / 20);
  EXPECT_LT(tally.count(BoundProof::search), cases / 20);
  return tally;
}

}  // namespace shelfbeam::test
