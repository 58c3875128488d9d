#include "shelfbeam/placement/scenarios/cut_proof.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "unit/placement/scenarios/random_scenarios.hpp"

namespace shelfbeam {
namespace {

using test::RandomScenarios;
using test::Rule;

constexpr std::size_t columns = 8, labels = 5;

/// A question, and cases of which its rule limits the misses.
struct CutQuestion {
  ScenarioTable scenarios;
  PlacementProblem problem;
  MissAllowance allowance;
  std::size_t allowed = 0;
  std::vector<CutProof::Case> cases;
};

CutQuestion random_question(RandomScenarios& random, int k) {
  const Rule rule = k % 3 == 0 ? Rule::label : k % 3 == 1 ? Rule::shop : Rule::total;
  CutQuestion question{random.next(false, 1.5), {}, random.allowance(rule), 0, {}};
  question.problem.redundant = k % 2 == 1;
  if (k % 5 == 0) question.problem.model = CommunicationModel::non_cooperative;
  const auto any_label = [&] { return static_cast<std::uint32_t>(labels * random.uniform()); };
  const std::uint32_t label = any_label();
  for (std::uint32_t s = 0; s < question.scenarios.count; ++s)
    for (std::uint32_t i = 0; i < labels; ++i)
      if (rule == Rule::label ? i == label : rule == Rule::shop ? i == (label + s) % labels : s < 3)
        question.cases.push_back({i, s});
  question.allowed = rule == Rule::label  ? question.allowance.limit(label)
                     : rule == Rule::shop ? *question.allowance.of_shop
                                          : static_cast<std::size_t>(*question.allowance.total);
  if (question.problem.redundant)
    for (CutProof::Case& at : question.cases)
      at.failed = static_cast<std::uint32_t>(columns * random.uniform());
  return question;
}

std::vector<double> smallest_shares(const CutQuestion& question, const CutProof& proof) {
  std::vector<double> shares(columns);
  const std::size_t kept = proof.cases.size() - question.allowed;
  for (std::uint32_t j = 0; j < columns; ++j) {
    std::vector<double> parts;
    for (const CutProof::Case& at : proof.cases) {
      const auto signal = static_cast<double>(question.scenarios.of(j, at.label)[at.scenario]);
      const bool is_sum = question.problem.model == CommunicationModel::cooperative;
      const double share = is_sum ? std::min(1.0, signal) : signal >= 1 ? 1 : 0;
      const double part = std::max(0.0, share - proof.above) / (1 - proof.above * proof.units);
      parts.push_back(at.failed == j ? 0 : std::min(1.0, part));
    }
    std::ranges::sort(parts, std::greater());
    shares[j] = std::accumulate(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(kept), 0.0) /
                static_cast<double>(kept) * (1 + 1e-8);
  }
  return shares;
}

/// Whether every selection that keeps to the allowance satisfies the cut, by enumeration.
bool holds(const CutQuestion& question, const CutProof& proof, const std::vector<double>& shares) {
  for (std::uint32_t set = 0; set < 256; ++set) {
    if (proof.above > 0 && static_cast<double>(std::popcount(set)) > proof.units) continue;
    if (!test::value_of_set(question.scenarios, question.problem, question.allowance, set)) continue;
    double sum = 0;
    for (std::uint32_t j = 0; j < columns; ++j) sum += (set >> j & 1U) != 0 ? shares[j] : 0;
    if (sum < 1 - 1e-6) return false;
  }
  return true;
}

TEST(CutProof, AcceptsTheSmallestSharesAndNoSmallerOnes) {
  RandomScenarios random(11);
  int accepted = 0, of_small_selections = 0, broken = 0, too_many_units = 0;
  for (int k = 0; k < 600; ++k) {
    SCOPED_TRACE(k);
    CutQuestion question = random_question(random, k);
    if (question.allowed >= question.cases.size()) continue;
    CutProof proof{.cases = question.cases};
    if (k % 4 < 2) std::tie(proof.above, proof.units) = std::pair(0.2 * random.uniform(), 3.0);
    const auto proved = [&](const CutProof& by, const std::vector<double>& shares) {
      return proves(by, shares, question.scenarios, question.problem, question.allowance);
    };
    const std::vector<double> shares = smallest_shares(question, proof);
    EXPECT_TRUE(proved(proof, shares));
    EXPECT_TRUE(holds(question, proof, shares));
    ++accepted;
    of_small_selections += proof.above > 0 ? 1 : 0;
    for (std::uint32_t j = 0; j < columns; ++j) {
      if (!(shares[j] > 0)) continue;
      std::vector<double> smaller = shares;
      smaller[j] *= 1 - 1e-6;
      EXPECT_FALSE(proved(proof, smaller)) << j;
      smaller[j] = 0;
      broken += holds(question, proof, smaller) ? 0 : 1;
    }
    // A case counts twice, or more units are allowed than in the shares.
    CutProof twice = proof;
    twice.cases.push_back(twice.cases.front());
    EXPECT_FALSE(proved(twice, shares));
    CutProof larger = proof;
    larger.units *= 1.5;
    if (proof.above > 0 && proof.above * larger.units < 1) {
      const bool is_proved = proved(larger, shares);
      EXPECT_TRUE(!is_proved || holds(question, larger, shares));
      too_many_units += is_proved ? 0 : 1;
    }
  }
  EXPECT_GT(accepted, 400);
  EXPECT_GT(of_small_selections, 150);
  EXPECT_GT(too_many_units, 50);
  EXPECT_GT(broken, 100);  // so the rejected cuts are not valid for another reason
}

TEST(CutProof, AcceptsCoversOnlyOfSetsThatMissTooMuch) {
  RandomScenarios random(12);
  int accepted = 0, rejected_invalid = 0;
  for (int k = 0; k < 1500; ++k) {
    SCOPED_TRACE(k);
    CutQuestion question = random_question(random, k);
    const auto inside = static_cast<std::uint32_t>(256 * random.uniform());
    std::vector<double> shares(columns);
    for (std::uint32_t j = 0; j < columns; ++j) shares[j] = (inside >> j & 1U) != 0 ? 0 : 1;
    CutProof proof{.cases = question.cases, .is_cover = true};
    const auto is_reached = [&](const CutProof::Case& at) {
      ReceivedSignal received(question.problem);
      for (std::uint32_t j = 0; j < columns; ++j)
        if (shares[j] == 0)
          received.add(static_cast<double>(question.scenarios.of(j, at.label)[at.scenario]));
      return is_met(received.value(), 1);
    };
    if (k % 3 < 2) std::erase_if(proof.cases, is_reached);
    const bool is_valid = holds(question, proof, shares);
    const bool is_proved = proves(proof, shares, question.scenarios, question.problem, question.allowance);
    EXPECT_TRUE(is_valid || !is_proved);
    accepted += is_proved ? 1 : 0;
    rejected_invalid += !is_valid && !is_proved ? 1 : 0;
  }
  EXPECT_GT(accepted, 200);
  EXPECT_GT(rejected_invalid, 100);
}

}  // namespace
}  // namespace shelfbeam
