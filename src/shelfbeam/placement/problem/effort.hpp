#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

#include "shelfbeam/base/control.hpp"

namespace shelfbeam::detail {

inline constexpr std::uint64_t any_steps = std::numeric_limits<std::uint64_t>::max();

/// Limits of a search. Results are reproducible if the steps end it, not the time.
struct Effort {
  std::uint64_t steps = any_steps;  ///< moves of a walk, nodes of a tree, units of greedy
  std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();

  double seconds_left() const {
    return std::chrono::duration<double>(until - std::chrono::steady_clock::now()).count();
  }
  /// The time is up or the run is cancelled.
  bool is_over(const RunControl& control) const {
    return control.cancelled() || std::chrono::steady_clock::now() >= until;
  }
};

/// The steps as a limit of nodes of a solver.
inline std::optional<std::uint64_t> node_limit(const Effort& effort) {
  return effort.steps == any_steps ? std::nullopt : std::optional(effort.steps);
}

}  // namespace shelfbeam::detail
