#pragma once

#include <cstddef>

namespace shelfbeam::detail {

/// The inner loops of the bounds on max coverage, compiled for several processor types. Row counts are
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

  /// Rows d of one label, each with b_jd = min(1, max(0, a_j - shift_d) scale_d).
  static constexpr std::size_t lifted_rows = 4;
  struct Lifted {
    float shift[lifted_rows], scale[lifted_rows];
  };
  /// sum_d = sum_j b_jd T_j over `entries` signals a_j. Reads up to the next multiple of SearchMatrix::block,
  /// where T_j must be 0.
  static void sums(const float* signal, const float* chosen, std::size_t entries, const Lifted& rows,
                   float* sum);
  /// value_j = b_jd for one row.
  static void lift(const float* signal, std::size_t entries, const Lifted& rows, std::size_t row,
                   float* value);
};

}  // namespace shelfbeam::detail
