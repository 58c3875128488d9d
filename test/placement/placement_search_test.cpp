#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <tuple>

#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/checker.hpp"
#include "shelfbeam/placement/placement.hpp"

#include "brute_force.hpp"
#include "formula_instances.hpp"
#include "random_table.hpp"

namespace shelfbeam {
namespace {

using test::BruteForce;
using Answer = BruteForce::Answer;
constexpr auto coop = CommunicationModel::cooperative;
constexpr auto alone = CommunicationModel::non_cooperative;

double value_of(const Answer& answer, const Question& question) {
  if (question.combination == Combination::weighted) return answer.price + answer.second_objective;
  return question.objective == Objective::count ? static_cast<double>(answer.columns.size())
                                                : answer.second_objective;
}

// Of the best answers that with the largest smallest margin, then the fewest units, then the first by column.
std::vector<std::uint32_t> by_tie_rule(std::vector<Answer> best) {
  return std::min_element(best.begin(), best.end(),
                          [](const Answer& a, const Answer& b) {
                            return std::tuple(-a.margin, a.columns.size(), a.columns) <
                                   std::tuple(-b.margin, b.columns.size(), b.columns);
                          })
      ->columns;
}

struct Tally {
  int optimal = 0, settled = 0, more_than_one = 0, infeasible = 0, stopped = 0;
  int by[5] = {};
};

void compare(const SignalTable& table, const Question& question, const Placement& answer, Tally& tally) {
  std::vector<Answer> best = BruteForce::answers(table, question);
  if (best.empty()) {
    EXPECT_EQ(answer.status, Status::infeasible);
    ++tally.infeasible;
    return;
  }
  EXPECT_TRUE(answer.has_selection());
  EXPECT_TRUE(check_selection(table, question, answer.selected).met());
  EXPECT_TRUE(std::any_of(best.begin(), best.end(),
                          [&](const Answer& one) { return one.columns == answer.selected; }));
  std::size_t fewest = table.columns();
  for (const Answer& one : best) fewest = std::min(fewest, one.columns.size());
  EXPECT_LE(answer.count_lower_bound, static_cast<double>(fewest));
  if (question.combination == Combination::lexicographic)
    std::erase_if(best, [&](const Answer& one) { return one.columns.size() > fewest; });
  double least = std::numeric_limits<double>::infinity();
  for (const Answer& one : best) least = std::min(least, value_of(one, question));
  EXPECT_LE(answer.lower_bound, least * (1 + 2e-6));
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
  if (question.combination == Combination::lexicographic) {
    EXPECT_EQ(answer.count(), fewest);
  }
  if (!answer.ties_settled) return;
  ++tally.settled;
  // Values are the same up to 1e-9 of them; the tables of near-ties have some that are about that far off.
  std::erase_if(best, [&](const Answer& one) { return value_of(one, question) > least * (1 + 2e-9); });
  if (std::any_of(best.begin(), best.end(),
                  [&](const Answer& one) { return value_of(one, question) > least * (1 + 1e-11); }))
    return;
  tally.more_than_one += best.size() > 1;
  EXPECT_EQ(answer.selected, by_tie_rule(best));
}

Tally run(std::uint64_t seed, int cases, const test::RandomTableLimits& limits) {
  test::RandomTables random(seed, limits);
  Tally tally;
  for (int k = 0; k < cases && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = random.next();
    const Question question = random.next_question();
    const auto begin = std::chrono::steady_clock::now();
    const Placement answer = place(table, question, {}, {.threads = 1});
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(4));
    compare(table, question, answer, tally);
    if (k % 8 == 0 && answer.ties_settled) {
      EXPECT_EQ(place(table, question, {}, {.threads = 4}).selected, answer.selected);
    }
  }
  return tally;
}

void expect_kinds(const Tally& tally, int cases) {
  EXPECT_GT(tally.infeasible, cases / 20);
  EXPECT_EQ(tally.stopped, 0);
  EXPECT_GT(tally.settled, tally.optimal * 9 / 10);
  EXPECT_GT(tally.more_than_one, cases / 50);
  EXPECT_GT(tally.by[static_cast<int>(BoundProof::log)], cases / 20);
  EXPECT_LT(tally.by[static_cast<int>(BoundProof::search)], cases / 20);
}

constexpr test::RandomTableLimits beyond_the_paper{
    .labels = 6, .transceivers = 12, .mounts = true, .apart = true, .redundant = true};

TEST(PlacementSearch, EqualsEnumeration) {
  expect_kinds(run(11, 1500, {.transceivers = 11}), 1500);
}

TEST(PlacementSearch, EqualsEnumerationWhereCandidatesExcludeOneAnotherAndUnitsMayFail) {
  expect_kinds(run(12, 1500, beyond_the_paper), 1500);
}

TEST(PlacementSearchSlow, EqualsEnumerationOnManyMore) {
  expect_kinds(run(13, 15000, {.transceivers = 13}), 15000);
  expect_kinds(run(14, 15000, {.labels = 30, .transceivers = 12}), 15000);
  expect_kinds(run(15, 15000, beyond_the_paper), 15000);
}

// Costs that differ by more digits than a number has: what the search cannot tell, it does not claim.
TEST(PlacementSearch, IsNotMisledByOnePrice) {
  test::RandomTables random(16, {.transceivers = 9});
  Tally tally;
  for (int k = 0; k < 300 && !HasFailure(); ++k) {
    SignalTable table = random.next();
    for (auto& unit : table.transceivers)
      if (random.chance(0.2)) unit.cost = std::pow(10.0, random.whole(5, 18));
    Question question = random.next_question();
    question.combination = Combination::weighted;
    SCOPED_TRACE(testing::Message() << "case " << k);
    compare(table, question, place(table, question, {.time_limit_s = 0.2}, {.threads = 1}), tally);
  }
  EXPECT_GT(tally.optimal, 100);
}

TEST(PlacementSearch, StopsWithValidBoundsAtAnyTime) {
  test::RandomTables random(17, {.transceivers = 12, .mounts = true});
  Tally tally;
  CancelToken token;
  token.request();
  for (int k = 0; k < 300 && !HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = random.next();
    const Question question = random.next_question();
    for (const double limit : {0.0, 1e-6, 1e-4, 1e300}) {
      const Placement answer =
          limit > 1 ? place(table, question, {.time_limit_s = limit}, {.threads = 1, .cancel = &token})
                    : place(table, question, {.time_limit_s = limit}, {.threads = 1});
      if (answer.status == Status::stopped && !answer.has_selection()) continue;
      compare(table, question, answer, tally);
    }
  }
  EXPECT_GT(tally.stopped, 100);
}

struct Known {
  SignalTable table;
  std::size_t optimum;
  double seconds;
};

TEST(PlacementSearchSlow, ProvesSteinerSystems) {
  const Known known[] = {
      {test::affine_lines(2), 5, 5}, {test::bose_triples(2), 9, 5}, {test::affine_lines(3), 18, 60}};
  for (const Known& one : known) {
    SCOPED_TRACE(one.table.rows());
    const Placement found = place(one.table, {alone}, {.time_limit_s = one.seconds});
    EXPECT_EQ(found.status, Status::optimal);
    EXPECT_EQ(found.count(), one.optimum);
    RecordProperty("seconds", std::to_string(found.seconds));
  }
}

// The best known, 25, is found; a proof takes longer than five minutes.
TEST(PlacementSearchSlow, FindsTheBestKnownOfColourings) {
  const SignalTable table = test::colourings(10, 4);
  const Placement found = place(table, {alone}, {.time_limit_s = 20});
  EXPECT_TRUE(check_selection(table, {alone}, found.selected).met());
  EXPECT_EQ(found.count(), 25U);
  EXPECT_LE(found.count_lower_bound, 25);
  EXPECT_LT(found.seconds, 40);
}

TEST(PlacementSearchSlow, ComesNearTheBestKnownOfALargeSteinerSystem) {
  const SignalTable table = test::affine_lines(4);
  const Placement found = place(table, {alone}, {.time_limit_s = 20});
  EXPECT_TRUE(check_selection(table, {alone}, found.selected).met());
  EXPECT_LE(found.count(), 62U);
  EXPECT_GE(found.count_lower_bound, 27);
  EXPECT_LE(found.count_lower_bound, 61);
  EXPECT_LT(found.seconds, 30);
}

}  // namespace
}  // namespace shelfbeam
