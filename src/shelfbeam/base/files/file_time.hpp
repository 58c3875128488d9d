#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>

namespace shelfbeam {

/// Nanoseconds since 1970.
inline std::int64_t ns_of(const timespec& time) {
  constexpr std::int64_t ns_per_s = 1'000'000'000;
  return time.tv_sec * ns_per_s + time.tv_nsec;
}

/// Whether another change of a file would change its time of modification (`ns_of`): file systems count time
/// in steps of up to two seconds, and within one, a change keeps the time.
inline bool is_settled(std::int64_t modified_ns) {
  constexpr std::chrono::nanoseconds longest_step = std::chrono::seconds(2);
  const std::chrono::nanoseconds now = std::chrono::system_clock::now().time_since_epoch();
  return now - std::chrono::nanoseconds(modified_ns) > longest_step;
}

}  // namespace shelfbeam
