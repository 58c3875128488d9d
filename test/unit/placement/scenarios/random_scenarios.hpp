#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "shelfbeam/placement/scenarios/scenario_table.hpp"

namespace shelfbeam::test {

enum class Rule { label, shop, total };

// Few labels, candidates and scenarios, so that all selections can be listed.
struct RandomScenarios {
  explicit RandomScenarios(unsigned seed) : random(seed) {}

  double uniform() { return std::uniform_real_distribution()(random); }

  ScenarioTable next(bool with_rules, double strength = 1) {
    ScenarioTable scenarios;
    scenarios.count = 8;
    for (int i = 0; i < 5; ++i)
      scenarios.table.labels.push_back({.id = std::to_string(i), .requirement = 1, .single_requirement = 1});
    for (int j = 0; j < 8; ++j)
      scenarios.table.transceivers.push_back(
          {.id = "T" + std::to_string(j), .cost = 1 + std::floor(3 * uniform()), .installed = false});
    scenarios.table.row_begin.assign(6, 0);
    if (with_rules) {
      scenarios.table.mounts = {{0, 1, 2}};
      scenarios.table.conflicts = {{3, 5}};
      scenarios.table.transceivers[6].installed = uniform() < 0.5;
    }
    const double density = 0.4 + 0.4 * uniform();
    scenarios.signal.resize(std::size_t{5} * 8 * 8);
    for (std::size_t i = 0; i < 5; ++i) {
      std::vector<double> usual(8);
      for (double& signal : usual) signal = uniform() < density ? 1.3 * strength * uniform() : 0;
      for (std::size_t s = 0; s < 8; ++s)
        for (std::size_t j = 0; j < 8; ++j)
          scenarios.signal[(j * 5 + i) * 8 + s] =
              static_cast<float>(usual[j] * (uniform() < 0.15 ? 0.2 : 0.7 + 0.6 * uniform()));
    }
    return scenarios;
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

inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// The value of a set of candidates, bit j for candidate j, that keeps to the rules. Written from the
/// definition, without code of the library.
inline std::optional<double> value_of_set(const ScenarioTable& scenarios, const PlacementProblem& problem,
                                          const MissAllowance& allowance, std::uint32_t set) {
  const auto has = [&](std::uint32_t j) { return (set >> j & 1U) != 0; };
  double value = 0;
  for (std::uint32_t j = 0; j < 8; ++j) {
    if (scenarios.table.transceivers[j].installed && !has(j)) return {};
    if (!has(j)) continue;
    if (problem.combination != Combination::spend)
      value += 1;
    else if (!scenarios.table.transceivers[j].installed)
      value += scenarios.table.transceivers[j].cost;
  }
  for (const auto& mount : scenarios.table.mounts)
    if (std::count_if(mount.begin(), mount.end(), has) > 1) return {};
  for (const auto& [a, b] : scenarios.table.conflicts)
    if (has(a) && has(b)) return {};
  std::uint32_t total = 0;
  std::vector<bool> any(8, false);
  for (std::size_t i = 0; i < 5; ++i) {
    std::uint32_t misses = 0;
    for (std::size_t s = 0; s < 8; ++s) {
      double sum = 0, first = 0, second = 0;  // the two largest signals
      for (std::uint32_t j = 0; j < 8; ++j) {
        if (!has(j)) continue;
        const auto signal = static_cast<double>(scenarios.signal[(std::size_t{j} * 5 + i) * 8 + s]);
        sum += signal;
        second = std::max(second, std::min(first, signal));
        first = std::max(first, signal);
      }
      if (problem.model == CommunicationModel::non_cooperative)
        sum = problem.redundant ? second : first;
      else if (problem.redundant)
        sum -= first;
      misses += sum < 1 ? 1 : 0;
      if (sum < 1) any[s] = true;
    }
    if (!allowance.of_label.empty() && misses > allowance.of_label[i]) return {};
    total += misses;
  }
  if (allowance.total && total > *allowance.total) return {};
  if (allowance.of_shop && std::count(any.begin(), any.end(), true) > *allowance.of_shop) return {};
  return value;
}

/// The smallest value; infinite if no set keeps to the rules.
inline double best_by_enumeration(const ScenarioTable& scenarios, const PlacementProblem& problem,
                                  const MissAllowance& allowance) {
  double best = infinite;
  for (std::uint32_t set = 0; set < 256; ++set)
    best = std::min(best, value_of_set(scenarios, problem, allowance, set).value_or(infinite));
  return best;
}

}  // namespace shelfbeam::test
