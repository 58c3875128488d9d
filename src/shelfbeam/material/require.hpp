#pragma once

#include <string_view>

namespace shelfbeam::detail {

/// Throws std::invalid_argument unless low <= value <= high: "ior is 0.9, must be from 1 to 4".
void require_range(std::string_view what, double value, double low, double high);

inline constexpr double largest_ior = 4;  ///< germanium; a misplaced decimal point is larger

}  // namespace shelfbeam::detail
