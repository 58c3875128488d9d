#pragma once

#include <algorithm>
#include <cmath>

namespace shelfbeam {

/// Max value that is better (smaller) than `known` if values are multiples of `step`, plus a margin above the
/// rounding errors of sums.
inline double next_better(double known, double step) {
  constexpr double of_sums = 1e-13, min_part = 1e-7, max_part = 0.1;
  return known - step + std::clamp(of_sums * std::abs(known), min_part * step, max_part * step);
}

}  // namespace shelfbeam
