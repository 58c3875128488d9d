#include "shelfbeam/placement/tree/proof.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include <gtest/gtest.h>

#include "shelfbeam/placement/tree/tree_search.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/formula_instances.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam::detail {
namespace {

using test::BruteForce;
using test::covering;

Proof prove(const SignalTable& table, const PlacementProblem& problem, std::size_t units,
            std::int64_t cost = std::numeric_limits<std::int64_t>::max()) {
  const Instance instance(table, problem);
  const SearchMatrix all(instance);
  TreeGoal goal;
  goal.max_units = units;
  goal.max_cost = cost;
  return TreeSearch(instance, all).run(goal, {.wants_proof = true}, {.threads = 2}).proof;
}

bool holds(const SignalTable& table, const PlacementProblem& problem, const Proof& proof) {
  return judge_proof({table, problem}, proof) == ProofVerdict::holds;
}

// The optimum of A9 is 5; the log that excludes 4 has branches, filters and sums.
struct NineLines {
  SignalTable table = test::affine_lines(2);
  Proof proof = prove(table, covering, 4);
};

TEST(Proof, OfASmallSteinerSystemHolds) {
  const NineLines a9;
  ASSERT_TRUE(a9.proof.is_complete);
  EXPECT_TRUE(holds(a9.table, covering, a9.proof));
  EXPECT_FALSE(prove(a9.table, covering, 5).is_complete);
  EXPECT_GT(std::count(a9.proof.steps.begin(), a9.proof.steps.end(), Proof::branch), 0);
}

TEST(Proof, ThatWasTamperedWithIsRefused) {
  const NineLines a9;
  const auto refused = [&](auto change) {
    Proof proof = a9.proof;
    change(proof);
    return !holds(a9.table, covering, proof);
  };
  EXPECT_TRUE(refused([](Proof& p) { p.is_complete = false; }));
  EXPECT_TRUE(refused([](Proof& p) { p.max_units = 5; }));
  EXPECT_TRUE(refused([](Proof& p) { p.steps.pop_back(); }));
  EXPECT_TRUE(refused([](Proof& p) { p.steps.push_back(Proof::single_fails); }));
  EXPECT_TRUE(refused([](Proof& p) { p.steps.clear(); }));
  EXPECT_TRUE(refused([](Proof& p) { p.steps = {Proof::open}; }));
  EXPECT_TRUE(refused([](Proof& p) { p.steps = {Proof::cost_fails}; }));
  EXPECT_TRUE(refused([](Proof& p) { p.steps = {Proof::row_fails, 0}; }));
  EXPECT_TRUE(refused([](Proof& p) { p.steps = {Proof::row_fails, 1000}; }));
  EXPECT_TRUE(refused([](Proof& p) { p.steps = {Proof::branch, 1000, 0, 0}; }));
  EXPECT_TRUE(refused([](Proof& p) { p.steps = {Proof::branch, 0, 0, 0}; })) << "children are omitted";
  EXPECT_TRUE(refused([](Proof& p) { p.steps = {Proof::single_fails}; })) << "more than one unit is left";
  EXPECT_TRUE(refused([](Proof& p) { p.rows.assign(1, 1000); }));
  EXPECT_TRUE(refused([](Proof& p) { p.weights.clear(); }));
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  for (const float weight : {-1.0F, nan, infinite})
    EXPECT_TRUE(refused([&](Proof& p) {
      for (auto& walk : p.weights)
        for (auto& weights : walk) std::fill(weights.begin(), weights.end(), weight);
    })) << weight;
}

// Without one child of the last branch and its steps, the proof is incomplete.
TEST(Proof, WithoutAChildIsRefused) {
  const SignalTable table =
      test::cover_table({{0, 1}, {2, 3}, {0, 2}, {1, 3}, {0, 3}, {1, 2}}, 4);  // needs 3
  Proof proof;
  proof.is_complete = true;
  proof.max_units = 2;
  proof.max_cost = std::numeric_limits<std::int64_t>::max();
  proof.rows = {0, 1, 2, 3, 4, 5};
  proof.steps = {Proof::branch, 0, 0, 2, 0, Proof::single_fails, 1, Proof::single_fails};
  EXPECT_TRUE(holds(table, covering, proof));
  for (const std::uint32_t omitted : {0U, 1U}) {
    proof.steps = {Proof::branch, 0, 0, 1, 1 - omitted, Proof::single_fails};
    EXPECT_FALSE(holds(table, covering, proof));
  }
  proof.steps = {Proof::branch, 0, 0, 2, 0, Proof::single_fails, 7, Proof::single_fails};
  EXPECT_FALSE(holds(table, covering, proof)) << "there is no column 7";
  proof.steps = {Proof::branch, 0, 0, 2, 0, Proof::row_fails, 0, 1, Proof::single_fails};
  EXPECT_FALSE(holds(table, covering, proof)) << "label 0 is met by unit 0";
}

// A single unit of cost 8 suffices. With a price so high that its gain is lost in rounding, it must not
// appear useless.
TEST(Proof, WithABadDualIsRefused) {
  SignalTable table = test::make_table({{1, 0.25}}, 2);
  table.transceivers[0].cost = 8;
  const PlacementProblem problem{CommunicationModel::cooperative, Objective::count, Combination::weighted};
  const Instance instance(table, problem);
  Proof proof;
  proof.is_complete = true;
  proof.max_units = 1;
  proof.max_cost = instance.cost[0];
  proof.rows = {0};
  proof.weights = {{{1.0F}}};
  for (const float price :
       {0.0F, -1.0F, 1e-18F, 1.0F, 1e20F, std::numeric_limits<float>::quiet_NaN(),
        std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
    const auto bits = std::bit_cast<std::uint32_t>(price);
    proof.steps = {Proof::sum_fails, 0, bits};
    EXPECT_FALSE(holds(table, problem, proof)) << price;
    proof.steps = {Proof::filter, 0, bits, Proof::single_fails};
    EXPECT_FALSE(holds(table, problem, proof)) << price;
  }
  proof.max_cost -= 1;
  proof.steps = {Proof::single_fails};
  EXPECT_TRUE(holds(table, problem, proof));
}

// If no column remains to choose, the chosen ones may suffice.
TEST(Proof, ThatNoFurtherUnitHelpsAllowsTheChosenOnes) {
  SignalTable table = test::make_table({{1, 0}}, 2);
  table.transceivers[0].installed = true;
  table.mounts = {{0, 1}};
  Proof proof;
  proof.is_complete = true;
  proof.max_units = 2;
  proof.max_cost = std::numeric_limits<std::int64_t>::max();
  proof.rows = {0};
  proof.steps = {Proof::single_fails};
  EXPECT_FALSE(holds(table, covering, proof));
  table.entries[0].signal = 0.5;
  EXPECT_TRUE(holds(table, covering, proof));
}

void mutate(test::RandomTables& random, Proof& proof) {
  auto& steps = proof.steps;
  const auto place = [&](std::size_t size) {
    return static_cast<std::size_t>(random.whole(0, static_cast<int>(size) - 1));
  };
  const auto word = [&]() -> std::uint32_t {
    if (random.chance(0.6)) return static_cast<std::uint32_t>(random.whole(0, 12));
    if (random.chance(0.5) && !steps.empty()) return steps[place(steps.size())];
    return static_cast<std::uint32_t>(
        random.whole(std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
  };
  switch (random.whole(0, 7)) {
    case 0:
      if (!steps.empty()) steps[place(steps.size())] = word();
      break;
    case 1:
      steps.insert(steps.begin() + random.whole(0, static_cast<int>(steps.size())), word());
      break;
    case 2:
      if (!steps.empty()) steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(place(steps.size())));
      break;
    case 3:
      if (!steps.empty()) steps.resize(place(steps.size()));
      break;
    case 4:
      if (steps.size() > 1) {
        const std::size_t from = place(steps.size()), to = place(steps.size());
        std::rotate(steps.begin() + static_cast<std::ptrdiff_t>(std::min(from, to)),
                    steps.begin() + static_cast<std::ptrdiff_t>((from + to + 1) / 2),
                    steps.begin() + static_cast<std::ptrdiff_t>(std::max(from, to) + 1));
      }
      break;
    case 5:
      for (auto& walk : proof.weights)
        for (auto& weights : walk)
          if (!weights.empty() && random.chance(0.3))
            weights[place(weights.size())] = std::bit_cast<float>(word() * 0x01000193U);
      break;
    case 6:
      if (!proof.rows.empty()) proof.rows[place(proof.rows.size())] = word();
      break;
    default:
      if (random.chance(0.5) && proof.max_cost < std::numeric_limits<std::int64_t>::max() - 3)
        proof.max_cost += random.whole(-3, 3);
      else
        proof.max_units += static_cast<std::size_t>(random.whole(-1, 1));
  }
}

// Whether enumeration contains a selection that a proof excludes.
bool is_false(const Instance& instance, const std::vector<BruteForce::Answer>& answers, const Proof& proof) {
  return std::any_of(answers.begin(), answers.end(), [&](const auto& answer) {
    return answer.columns.size() <= proof.max_units && instance.cost_of(answer.columns) <= proof.max_cost;
  });
}

struct Fuzzed {
  int proofs = 0, accepted = 0, refused = 0, of_falsehoods = 0;
};

// Valid proofs with stronger claims and random changes: no false claim is ever proven.
Fuzzed fuzz(std::uint64_t seed, int cases, const test::RandomTableLimits& limits) {
  test::RandomTables random(seed, limits);
  Fuzzed fuzzed;
  for (int k = 0; k < cases && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = random.next();
    const PlacementProblem problem = random.next_problem();
    const Instance instance(table, problem);
    const auto answers = BruteForce::answers(table, problem);
    std::size_t fewest = table.columns() + 1;
    std::int64_t cheapest = std::numeric_limits<std::int64_t>::max();
    for (const auto& answer : answers) {
      fewest = std::min(fewest, answer.columns.size());
      cheapest = std::min(cheapest, instance.cost_of(answer.columns));
    }
    const bool by_cost = !answers.empty() && cheapest > 0 && random.chance(0.5);
    if (fewest == 0) continue;
    const Proof proof =
        by_cost ? prove(table, problem, table.columns(), cheapest - 1) : prove(table, problem, fewest - 1);
    EXPECT_TRUE(proof.is_complete);
    EXPECT_TRUE(holds(table, problem, proof));
    ++fuzzed.proofs;
    Proof raised = proof;
    if (by_cost)
      raised.max_cost = cheapest;
    else
      raised.max_units = fewest;
    EXPECT_TRUE(answers.empty() || !holds(table, problem, raised));
    for (int m = 0; m < 12; ++m) {
      Proof changed = random.chance(0.5) ? proof : raised;
      for (int times = random.whole(1, 3); times > 0; --times) mutate(random, changed);
      const bool accepted = holds(table, problem, changed);
      const bool falsehood = is_false(instance, answers, changed);
      EXPECT_FALSE(accepted && falsehood);
      (accepted ? fuzzed.accepted : fuzzed.refused) += 1;
      fuzzed.of_falsehoods += falsehood;
    }
  }
  return fuzzed;
}

TEST(Proof, NoMutationProvesAFalseClaim) {
  const Fuzzed plain = fuzz(1, 1500, {.transceivers = 9});
  const Fuzzed more =
      fuzz(2, 1500, {.labels = 6, .transceivers = 9, .mounts = true, .conflicts = true, .redundant = true});
  for (const Fuzzed& fuzzed : {plain, more}) {
    EXPECT_GT(fuzzed.proofs, 1000);
    EXPECT_GT(fuzzed.accepted, 500) << "some changes do no harm";
    EXPECT_GT(fuzzed.refused, 2000);
    EXPECT_GT(fuzzed.of_falsehoods, 1000);
  }
}

}  // namespace
}  // namespace shelfbeam::detail
