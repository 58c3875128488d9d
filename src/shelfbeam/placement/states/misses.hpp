#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace shelfbeam {

/// The misses of a selection in some states of a shop.
struct StateMisses {
  std::vector<std::uint32_t> of_label;  ///< states in which each label is missed
  std::uint32_t of_shop = 0;            ///< states in which any label is missed

  std::uint64_t total() const;
  bool operator==(const StateMisses&) const = default;
};

/// Counts misses, one at a time.
class MissCounter {
 public:
  MissCounter(std::size_t labels, std::size_t states) : has_miss_(states, false) {
    misses_.of_label.assign(labels, 0);
  }
  void add(std::size_t label, std::size_t state) {
    ++misses_.of_label[label];
    if (!has_miss_[state]) ++misses_.of_shop;
    has_miss_[state] = true;
  }
  const StateMisses& misses() const { return misses_; }

 private:
  StateMisses misses_;
  std::vector<bool> has_miss_;  ///< per state
};

/// The allowed misses. A part without a value limits nothing.
struct MissAllowance {
  std::vector<std::uint32_t> of_label = {};   ///< per label; empty: no limit
  std::optional<std::uint32_t> of_shop = {};  ///< states in which any label is missed
  std::optional<std::uint64_t> total = {};    ///< missed labels, summed over the states

  /// The number of misses of a label beyond which no rule can hold.
  std::uint64_t limit(std::size_t label) const;
  /// Misses beyond the allowed ones.
  std::uint64_t excess(const StateMisses& misses) const;
};

/// The largest number of misses in `states` that an availability keeps to: the whole part of
/// (1 - availability) states.
std::uint32_t allowed_misses(double availability, std::size_t states);

/// The same widened: something that holds with at least this probability in each of independent states fails
/// in more of them with a probability of at most `level`.
std::uint32_t widened_misses(double availability, std::size_t states, double level);

/// The largest number of misses in `states` that proves an availability: with a smaller one, so few misses
/// have a probability of at most `level`. nullopt if no number proves it.
std::optional<std::uint32_t> proving_misses(double availability, std::size_t states, double level);

}  // namespace shelfbeam
