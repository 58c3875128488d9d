#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"

namespace shelfbeam::detail {

inline constexpr std::uint64_t any_steps = std::numeric_limits<std::uint64_t>::max();

/// Limits of a search. Results are reproducible if the steps end it, not the time.
struct Effort {
  /// In the unit of the method: moves of a walk, nodes of a tree, units of greedy.
  std::uint64_t steps = any_steps;
  std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();

  double seconds_left() const {
    return std::chrono::duration<double>(until - std::chrono::steady_clock::now()).count();
  }
  /// The time is up or the run is cancelled.
  bool is_over(const RunControl& control) const {
    return control.cancelled() || std::chrono::steady_clock::now() >= until;
  }
};

/// A time limit that begins now.
inline Effort for_seconds(double seconds) {
  return {any_steps, Deadline(seconds).end()};
}

/// The steps as the node limit of a solver; none for any_steps.
inline std::optional<std::uint64_t> node_limit(const Effort& effort) {
  return effort.steps == any_steps ? std::nullopt : std::optional(effort.steps);
}

}  // namespace shelfbeam::detail
