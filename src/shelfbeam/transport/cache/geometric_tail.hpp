#pragma once

#include <algorithm>
#include <array>

namespace shelfbeam::detail {

/// All further rounds of a Jacobi iteration as a geometric series: the factor by which the last increment is
/// added once more, from the sums of light after the last three rounds.
[[nodiscard]] inline float geometric_tail(const std::array<double, 3>& totals) {
  constexpr double max_ratio = 0.995;
  const double before = totals[1] - totals[0], last = totals[2] - totals[1];
  const double ratio = before > 0 ? std::clamp(last / before, 0.0, max_ratio) : 0;
  return static_cast<float>(ratio / (1 - ratio));
}

}  // namespace shelfbeam::detail
