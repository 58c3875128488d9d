#include "shelfbeam/placement/states/place_over_states.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

enum class Rule { label, shop, total };

// Few labels, candidates and states, so that all selections can be listed.
struct RandomStates {
  explicit RandomStates(unsigned seed) : random(seed) {}

  double uniform() { return std::uniform_real_distribution()(random); }

  StateTable next(bool with_rules, double strength = 1) {
    StateTable states;
    states.states = 8;
    for (int i = 0; i < 5; ++i)
      states.table.labels.push_back({.id = std::to_string(i), .requirement = 1, .single_requirement = 1});
    for (int j = 0; j < 8; ++j)
      states.table.transceivers.push_back(
          {.id = "T" + std::to_string(j), .cost = 1 + std::floor(3 * uniform()), .installed = false});
    states.table.row_begin.assign(6, 0);
    if (with_rules) {
      states.table.mounts = {{0, 1, 2}};
      states.table.conflicts = {{3, 5}};
      states.table.transceivers[6].installed = uniform() < 0.5;
    }
    const double density = 0.4 + 0.4 * uniform();
    states.signal.resize(5 * 8 * 8);
    for (std::size_t i = 0; i < 5; ++i) {
      std::vector<double> usual(8);
      for (double& signal : usual) signal = uniform() < density ? 1.3 * strength * uniform() : 0;
      for (std::size_t s = 0; s < 8; ++s)
        for (std::size_t j = 0; j < 8; ++j)
          states.signal[(j * 5 + i) * 8 + s] =
              static_cast<float>(usual[j] * (uniform() < 0.15 ? 0.2 : 0.7 + 0.6 * uniform()));
    }
    return states;
  }

  MissAllowance allowance(Rule rule) {
    const auto some = [&] { return static_cast<std::uint32_t>(4 * uniform()); };
    if (rule == Rule::shop) return {.of_shop = some()};
    if (rule == Rule::total) return {.total = some()};
    MissAllowance allowance{.of_label = std::vector<std::uint32_t>(5)};
    for (std::uint32_t& misses : allowance.of_label) misses = some();
    return allowance;
  }

  std::mt19937 random;
};

// Written from the definition, without code of the library.
double best_by_enumeration(const StateTable& states, const PlacementProblem& problem,
                           const MissAllowance& allowance) {
  double best = infinite;
  for (std::uint32_t set = 0; set < 256; ++set) {
    const auto has = [&](std::uint32_t j) { return (set >> j & 1U) != 0; };
    bool is_allowed = true;
    double value = 0;
    for (std::uint32_t j = 0; j < 8; ++j) {
      if (states.table.transceivers[j].installed && !has(j)) is_allowed = false;
      if (!has(j)) continue;
      if (problem.combination != Combination::spend)
        value += 1;
      else if (!states.table.transceivers[j].installed)
        value += states.table.transceivers[j].cost;
    }
    for (const auto& mount : states.table.mounts)
      is_allowed &= std::count_if(mount.begin(), mount.end(), has) <= 1;
    for (const auto& [a, b] : states.table.conflicts) is_allowed &= !(has(a) && has(b));
    if (!is_allowed) continue;
    std::uint32_t total = 0;
    std::vector<bool> any(8, false);
    for (std::size_t i = 0; i < 5 && is_allowed; ++i) {
      std::uint32_t misses = 0;
      for (std::size_t s = 0; s < 8; ++s) {
        std::vector<double> got;
        for (std::uint32_t j = 0; j < 8; ++j)
          if (has(j)) got.push_back(static_cast<double>(states.signal[(j * 5 + i) * 8 + s]));
        std::sort(got.rbegin(), got.rend());
        if (problem.redundant && !got.empty()) got.erase(got.begin());
        double sum = 0;
        for (const double signal : got) sum += signal;
        if (problem.model == CommunicationModel::non_cooperative) sum = got.empty() ? 0 : got.front();
        misses += sum < 1 ? 1 : 0;
        if (sum < 1) any[s] = true;
      }
      if (!allowance.of_label.empty()) is_allowed = misses <= allowance.of_label[i];
      total += misses;
    }
    if (allowance.total) is_allowed &= total <= *allowance.total;
    if (allowance.of_shop) is_allowed &= std::count(any.begin(), any.end(), true) <= *allowance.of_shop;
    if (is_allowed) best = std::min(best, value);
  }
  return best;
}

struct Case {
  PlacementProblem problem;
  Rule rule = Rule::label;
};

class PlaceOverStates : public testing::TestWithParam<Case> {};

TEST_P(PlaceOverStates, EqualsEnumeration) {
  const auto& [problem, rule] = GetParam();
  RandomStates random(1);
  int proven = 0, found = 0, differs = 0;
  constexpr int cases = 80;
  const bool is_hard = problem.redundant || problem.model == CommunicationModel::non_cooperative;
  const double strength = is_hard ? 2.5 : 1;
  for (int k = 0; k < cases; ++k) {
    SCOPED_TRACE(k);
    const StateTable states = random.next(k % 2 == 1, strength);
    const MissAllowance allowance = random.allowance(rule);
    const StatePlacement placement = place_over_states(states, problem, allowance, {});
    const double best = best_by_enumeration(states, problem, allowance);
    EXPECT_LE(placement.lower_bound, best);
    if (placement.has_selection()) {
      EXPECT_GE(placement.value, best);
      EXPECT_EQ(misses_of(states, problem, placement.selected), placement.misses);
      EXPECT_EQ(allowance.excess(placement.misses), 0U);
    }
    found += best < infinite ? 1 : 0;
    proven += best < infinite && placement.is_proven() ? 1 : 0;
    EXPECT_TRUE(problem.redundant || placement.value == best) << placement.value << " " << best;
    const MissAllowance none{.of_label = std::vector<std::uint32_t>(5, 0)};
    differs += best_by_enumeration(states, problem, none) != best ? 1 : 0;
  }
  EXPECT_GT(found, cases / 8);
  EXPECT_GT(proven, problem.redundant ? found / 2 : found - 1);
  EXPECT_GT(differs, cases / 10) << "the allowances matter";
}

INSTANTIATE_TEST_SUITE_P(
    Every, PlaceOverStates,
    testing::Values(Case{}, Case{{.model = CommunicationModel::non_cooperative}},
                    Case{{.combination = Combination::spend}}, Case{{.redundant = true}},
                    Case{{.model = CommunicationModel::non_cooperative, .redundant = true}},
                    Case{{}, Rule::shop}, Case{{.model = CommunicationModel::non_cooperative}, Rule::shop},
                    Case{{}, Rule::total}, Case{{.combination = Combination::spend}, Rule::total}),
    [](const auto& test) {
      const PlacementProblem& problem = test.param.problem;
      const Rule rule = test.param.rule;
      return std::string(problem.model == CommunicationModel::cooperative ? "Cooperative" : "Alone") +
             (problem.combination == Combination::spend ? "ByPrice" : "") +
             (problem.redundant ? "WithFailure" : "") +
             (rule == Rule::shop    ? "OfShop"
              : rule == Rule::total ? "InTotal"
                                    : "");
    });

TEST(StateMisses, AllowancesAreBinomial) {
  EXPECT_EQ(allowed_misses(0.95, 100), 5U);
  EXPECT_EQ(allowed_misses(0.95, 50), 2U);
  EXPECT_EQ(allowed_misses(0.9, 30), 3U);
  EXPECT_EQ(allowed_misses(1, 100), 0U);
  // P(N > 1) of two trials with probability 1/2 is 1/4, P(N > 0) is 3/4.
  EXPECT_EQ(widened_misses(0.5, 2, 0.25), 1U);
  EXPECT_EQ(widened_misses(0.5, 2, 0.2), 2U);
  EXPECT_EQ(widened_misses(0.5, 2, 0.75), 0U);
  EXPECT_GT(widened_misses(0.95, 100, 1e-4), allowed_misses(0.95, 100));
  // Without a miss in 59 states, an availability below 95 % has a probability below 0.95^59 = 4.8 %.
  EXPECT_EQ(proving_misses(0.95, 58, 0.05), std::nullopt);
  EXPECT_EQ(proving_misses(0.95, 59, 0.05), 0U);
}

TEST(PlaceOverStatesRules, NamesLabelsOutOfReach) {
  RandomStates random(2);
  StateTable states = random.next(false);
  for (std::ptrdiff_t j = 0; j < 8; ++j) std::fill_n(states.signal.begin() + (j * 5 + 2) * 8, 8, 0.0F);
  const MissAllowance allowance{.of_label = std::vector<std::uint32_t>(5, 3)};
  const StatePlacement placement = place_over_states(states, {}, allowance, {});
  EXPECT_EQ(placement.unreachable, std::vector<std::uint32_t>{2});
  EXPECT_FALSE(placement.has_selection());
}

}  // namespace
}  // namespace shelfbeam
