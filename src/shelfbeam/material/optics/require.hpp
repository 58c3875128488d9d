#pragma once

#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

namespace shelfbeam::detail {

/// Throws std::invalid_argument unless low <= value <= high: "ior is 0.9, must be from 1 to 4".
inline void require_range(std::string_view what, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw std::invalid_argument(fmt::format("{} is {}, must be from {} to {}", what, value, low, high));
}

inline constexpr double largest_ior = 4;  ///< germanium; a misplaced decimal point is larger

}  // namespace shelfbeam::detail
