#pragma once

#include <cstddef>

#include "shelfbeam/math/cpu_vectors.hpp"

namespace shelfbeam::detail {

/// Kernels sum rows in this many parallel lanes, so that results do not depend on the processor's vectors.
inline constexpr std::size_t width = 16;

/// The sum of `width` lanes in a fixed order. With few rows, summing the lanes one by one would dominate the
/// time.
SHELFBEAM_INLINE inline float sum_of(const float* lanes) {
  float part[4];
  for (std::size_t k = 0; k < 4; ++k) part[k] = (lanes[k] + lanes[k + 4]) + (lanes[k + 8] + lanes[k + 12]);
  return (part[0] + part[1]) + (part[2] + part[3]);
}

/// The sum of term(i) over the rows, with `width` consecutive rows in parallel lanes.
template <class Term>
SHELFBEAM_INLINE inline float sum_over(std::size_t rows, const Term& term) {
  alignas(64) float total[width] = {};
  for (std::size_t i = 0; i < rows; i += width) {
    SHELFBEAM_VECTORIZE
    for (std::size_t k = 0; k < width; ++k) total[k] += term(i + k);
  }
  return sum_of(total);
}

}  // namespace shelfbeam::detail
