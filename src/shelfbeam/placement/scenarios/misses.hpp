#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace shelfbeam {

/// The misses of a selection in some scenarios.
struct ScenarioMisses {
  std::vector<std::uint32_t> of_label;  ///< scenarios in which each label is missed
  std::uint32_t of_shop = 0;            ///< scenarios in which any label is missed

  std::uint64_t total() const;
  bool operator==(const ScenarioMisses&) const = default;
};

/// Counts misses, one at a time.
class MissCounter {
 public:
  MissCounter(std::size_t labels, std::size_t scenarios)
      : misses_{.of_label = std::vector<std::uint32_t>(labels)}, has_miss_(scenarios, false) {}
  void add(std::size_t label, std::size_t scenario) {
    ++misses_.of_label[label];
    if (!has_miss_[scenario]) ++misses_.of_shop;
    has_miss_[scenario] = true;
  }
  const ScenarioMisses& misses() const { return misses_; }

 private:
  ScenarioMisses misses_;
  std::vector<bool> has_miss_;  ///< per scenario
};

/// The risk measures of a goal and their limits, over equally likely scenarios: individual chance constraints
/// (a limit per label), a joint chance constraint (of the shop), and the expected number of missed labels
/// (the total). A part without a value limits nothing.
struct MissAllowance {
  std::vector<std::uint32_t> of_label = {};   ///< per label; empty: no limit
  std::optional<std::uint32_t> of_shop = {};  ///< scenarios in which any label is missed
  std::optional<std::uint64_t> total = {};    ///< missed labels, summed over the scenarios

  /// The number of misses of a label beyond which no rule can hold.
  std::uint64_t limit(std::size_t label) const;
  /// Misses beyond the allowed ones.
  std::uint64_t excess(const ScenarioMisses& misses) const;
};

/// The largest number of misses in `scenarios` that an availability keeps to: the whole part of
/// (1 - availability) scenarios.
std::uint32_t allowed_misses(double availability, std::size_t scenarios);

/// The same widened: something that holds with at least this probability in each of independent scenarios
/// fails in more of them with a probability of at most `level`.
std::uint32_t widened_misses(double availability, std::size_t scenarios, double level);

/// The largest number of misses in `scenarios` that proves an availability: with a smaller one, so few misses
/// have a probability of at most `level`. nullopt if no number proves it.
std::optional<std::uint32_t> proving_misses(double availability, std::size_t scenarios, double level);

}  // namespace shelfbeam
