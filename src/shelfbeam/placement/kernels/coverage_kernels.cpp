#include "shelfbeam/placement/kernels/coverage_kernels.hpp"

#include "shelfbeam/math/cpu_vectors.hpp"
#include "shelfbeam/placement/kernels/lanes.hpp"

namespace shelfbeam::detail {

namespace {

SHELFBEAM_INLINE inline float share_of(float signal, float shift, float scale) {
  const float above = signal > shift ? signal - shift : 0.0F;
  const float share = above * scale;
  return share < 1.0F ? share : 1.0F;
}

}  // namespace

SHELFBEAM_FOR_EACH_CPU
float CoverageKernels::reached(const float* column, const float* lack, const float* weight,
                               std::size_t rows) {
  return sum_over(rows, [=](std::size_t i) { return column[i] >= lack[i] ? weight[i] : 0.0F; });
}

SHELFBEAM_FOR_EACH_CPU
float CoverageKernels::value(const float* column, const Shares& shares, const float* weight) {
  const Shares s = shares;
  return sum_over(s.rows,
                  [=](std::size_t i) { return weight[i] * share_of(column[i], s.shift[i], s.scale[i]); });
}

SHELFBEAM_FOR_EACH_CPU
void CoverageKernels::add(const float* column, const Shares& shares, float* sum) {
  const Shares s = shares;
  SHELFBEAM_VECTORIZE
  for (std::size_t i = 0; i < s.rows; ++i) sum[i] += share_of(column[i], s.shift[i], s.scale[i]);
}

SHELFBEAM_FOR_EACH_CPU
void CoverageKernels::sums(const float* signal, const float* chosen, std::size_t entries, const Lifted& rows,
                           float* sum) {
  const Lifted lifted = rows;
  alignas(64) float total[lifted_rows][width] = {};
  for (std::size_t j = 0; j < entries; j += width)
    for (std::size_t d = 0; d < lifted_rows; ++d) {
      SHELFBEAM_VECTORIZE
      for (std::size_t k = 0; k < width; ++k)
        total[d][k] += chosen[j + k] * share_of(signal[j + k], lifted.shift[d], lifted.scale[d]);
    }
  for (std::size_t d = 0; d < lifted_rows; ++d) sum[d] = sum_of(total[d]);
}

SHELFBEAM_FOR_EACH_CPU
void CoverageKernels::lift(const float* signal, std::size_t entries, const Lifted& rows, std::size_t row,
                           float* value) {
  const float shift = rows.shift[row], scale = rows.scale[row];
  SHELFBEAM_VECTORIZE
  for (std::size_t j = 0; j < entries; ++j) value[j] = share_of(signal[j], shift, scale);
}

}  // namespace shelfbeam::detail
