#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

#include "shelfbeam/base/control.hpp"

namespace shelfbeam::detail {

/// How long a search may go on. What it finds can be found again where the steps end it, not the time.
struct Effort {
  std::uint64_t steps = std::numeric_limits<std::uint64_t>::max();  ///< moves of a walk, nodes of a tree
  std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();

  double seconds_left() const {
    return std::chrono::duration<double>(until - std::chrono::steady_clock::now()).count();
  }
  /// The time ends it, or somebody does.
  bool is_over(const RunControl& control) const {
    return control.cancelled() || std::chrono::steady_clock::now() >= until;
  }
};

/// Of one local search, side by side: so many seeds it takes.
inline constexpr std::uint32_t walks_at_once = 2;

}  // namespace shelfbeam::detail
