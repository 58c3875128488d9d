#pragma once

#include <chrono>
#include <cstdint>

namespace shelfbeam::detail {

/// How long a search over selections goes on. Limited by moves it is reproducible, but where `until` comes
/// first.
struct SearchEffort {
  std::uint64_t moves = 20000;  ///< of each walk
  std::uint32_t walks = 2;      ///< with random numbers of their own, on all threads
  std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();
  std::uint32_t seed = 1;  ///< of the first walk, the next ones have those that follow
};

}  // namespace shelfbeam::detail
