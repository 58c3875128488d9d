#pragma once

#include <cstddef>

namespace shelfbeam::detail {

/// The inner loops of the enumeration of max coverage, compiled for several processor types. Row counts are
/// multiples of SearchMatrix::block.
struct CoverageKernels {
  /// The weight of the labels that lack no more than the column gives: sum_i weight_i [a_i >= lack_i].
  static float reached(const float* column, const float* lack, const float* weight, std::size_t rows);

  /// The share b_i of a label's lack that a signal a_i counts for: min(1, max(0, a_i - shift_i) scale_i).
  struct Shares {
    const float* shift;
    const float* scale;
    std::size_t rows;
  };
  /// sum_i weight_i b_i.
  static float value(const float* column, const Shares& shares, const float* weight);
  /// sum_i += b_i.
  static void add(const float* column, const Shares& shares, float* sum);
};

}  // namespace shelfbeam::detail
