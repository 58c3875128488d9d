#include "shelfbeam/placement/kernels/search_kernels.hpp"

#include "shelfbeam/math/cpu_vectors.hpp"
#include "shelfbeam/placement/kernels/lanes.hpp"

namespace shelfbeam::detail {

namespace {

SHELFBEAM_INLINE inline float smaller(float a, float b) {
  return a < b ? a : b;
}
SHELFBEAM_INLINE inline float larger(float a, float b) {
  return a > b ? a : b;
}

SHELFBEAM_INLINE inline float sum_after(const SearchKernels::Held& held, const float* out, const float* in,
                                        std::size_t i) {
  return held.sum[i] - out[i] + in[i];
}
SHELFBEAM_INLINE inline float sum_after_failure(const SearchKernels::Held& held, const float* out,
                                                const float* in, std::size_t i) {
  const float rest = out[i] >= held.best[i] ? held.second[i] : held.best[i];
  return sum_after(held, out, in, i) - larger(rest, in[i]);
}

template <bool sums>
SHELFBEAM_INLINE inline float given(float signal, float target) {
  if constexpr (sums)
    return signal;
  else
    return signal >= target ? 1.0F : 0.0F;
}

template <bool sums>
SHELFBEAM_INLINE inline float gain_of(const float* column, float scale, const SearchKernels::Rows& rows,
                                      float* supporters) {
  alignas(64) float total[width] = {};
  for (std::size_t i = 0; i < rows.count; i += width) {
    SHELFBEAM_VECTORIZE
    for (std::size_t k = 0; k < width; ++k) {
      const float a = given<sums>(column[i + k], rows.target);
      const float counted = sums ? larger(0.0F, a - rows.shift[i + k]) : a;
      total[k] += rows.weight[i + k] * smaller(counted, rows.lacking[i + k]);
      supporters[i + k] += a >= scale * rows.share[i + k] ? 1.0F : 0.0F;
    }
  }
  return sum_of(total);
}

template <bool sums>
SHELFBEAM_INLINE inline bool suffices_for(const float* column, const float* lacking, float target,
                                          std::size_t rows) {
  for (std::size_t i = 0; i < rows; i += width) {
    alignas(64) float missing[width];
    SHELFBEAM_VECTORIZE
    for (std::size_t k = 0; k < width; ++k)
      missing[k] = given<sums>(column[i + k], target) < lacking[i + k] ? 1.0F : 0.0F;
    if (sum_of(missing) > 0) return false;
  }
  return true;
}

template <bool sums>
SHELFBEAM_INLINE inline void add_load(const float* column, const SearchKernels::Rows& rows, float* load) {
  SHELFBEAM_VECTORIZE
  for (std::size_t i = 0; i < rows.count; ++i) {
    const float lack = rows.lacking[i], a = given<sums>(column[i], rows.target);
    const float counted = sums ? larger(0.0F, a - rows.shift[i]) : a;
    load[i] += lack > 0 ? smaller(counted, lack) / lack : 0.0F;
  }
}

}  // namespace

SHELFBEAM_FOR_EACH_CPU
void SearchKernels::receive(Receiving rule, const float* column, std::size_t rows, float* value,
                            float* best) {
  switch (rule) {
    case Receiving::sum:
      SHELFBEAM_VECTORIZE
      for (std::size_t i = 0; i < rows; ++i) value[i] += column[i];
      break;
    case Receiving::best:
      SHELFBEAM_VECTORIZE
      for (std::size_t i = 0; i < rows; ++i) value[i] = larger(value[i], column[i]);
      break;
    case Receiving::sum_without_best:
      SHELFBEAM_VECTORIZE
      for (std::size_t i = 0; i < rows; ++i) {
        value[i] += smaller(best[i], column[i]);
        best[i] = larger(best[i], column[i]);
      }
      break;
    case Receiving::second_best:
      SHELFBEAM_VECTORIZE
      for (std::size_t i = 0; i < rows; ++i) {
        value[i] = larger(value[i], smaller(best[i], column[i]));
        best[i] = larger(best[i], column[i]);
      }
      break;
  }
}

SHELFBEAM_FOR_EACH_CPU
bool SearchKernels::lack(Receiving rule, const float* value, const float* best, float target,
                         std::size_t rows, float* lacking) {
  alignas(64) float total[width] = {};
  for (std::size_t i = 0; i < rows; i += width) {
    if (is_sum(rule)) {
      SHELFBEAM_VECTORIZE
      for (std::size_t k = 0; k < width; ++k)
        lacking[i + k] = value[i + k] >= target ? 0.0F : target - value[i + k];
    } else if (rule == Receiving::best) {
      SHELFBEAM_VECTORIZE
      for (std::size_t k = 0; k < width; ++k) lacking[i + k] = value[i + k] >= target ? 0.0F : 1.0F;
    } else {
      SHELFBEAM_VECTORIZE
      for (std::size_t k = 0; k < width; ++k)
        lacking[i + k] = (value[i + k] >= target ? 0.0F : 1.0F) + (best[i + k] >= target ? 0.0F : 1.0F);
    }
    SHELFBEAM_VECTORIZE
    for (std::size_t k = 0; k < width; ++k) total[k] += lacking[i + k];
  }
  return sum_of(total) > 0;
}

SHELFBEAM_FOR_EACH_CPU
float SearchKernels::gain(Receiving rule, const float* column, float scale, const Rows& rows,
                          float* supporters) {
  const Rows r = rows;
  return is_sum(rule) ? gain_of<true>(column, scale, r, supporters)
                      : gain_of<false>(column, scale, r, supporters);
}

SHELFBEAM_FOR_EACH_CPU
float SearchKernels::need(const float* lacking, const float* weight, std::size_t rows) {
  return sum_over(rows, [=](std::size_t i) { return weight[i] * lacking[i]; });
}

SHELFBEAM_FOR_EACH_CPU
bool SearchKernels::suffices(Receiving rule, const float* column, const float* lacking, float target,
                             std::size_t rows) {
  return is_sum(rule) ? suffices_for<true>(column, lacking, target, rows)
                      : suffices_for<false>(column, lacking, target, rows);
}

SHELFBEAM_FOR_EACH_CPU
float SearchKernels::worth(const float* column, const float* weight, const float* held, float demand,
                           std::size_t rows) {
  return sum_over(
      rows, [=](std::size_t i) { return weight[i] * smaller(column[i], larger(0.0F, demand - held[i])); });
}

SHELFBEAM_FOR_EACH_CPU
float SearchKernels::loss(const float* column, const float* weight, const float* held, float demand,
                          std::size_t rows) {
  return sum_over(rows, [=](std::size_t i) {
    return weight[i] * larger(0.0F, column[i] - larger(0.0F, held[i] - demand));
  });
}

SHELFBEAM_FOR_EACH_CPU
float SearchKernels::lack_after(const Held& all, const float* out, const float* in, float demand,
                                std::size_t rows) {
  const Held held = all;
  if (held.best == nullptr)
    return sum_over(rows, [=](std::size_t i) { return larger(0.0F, demand - sum_after(held, out, in, i)); });
  return sum_over(rows,
                  [=](std::size_t i) { return larger(0.0F, demand - sum_after_failure(held, out, in, i)); });
}

SHELFBEAM_FOR_EACH_CPU
float SearchKernels::missed_after(const Held& all, const float* out, const float* in, float demand,
                                  const float* weight, std::size_t rows) {
  const Held held = all;
  if (held.best == nullptr)
    return sum_over(rows,
                    [=](std::size_t i) { return sum_after(held, out, in, i) < demand ? weight[i] : 0.0F; });
  return sum_over(
      rows, [=](std::size_t i) { return sum_after_failure(held, out, in, i) < demand ? weight[i] : 0.0F; });
}

SHELFBEAM_FOR_EACH_CPU
void SearchKernels::exchange(const float* out, const float* in, std::size_t rows, float* held) {
  SHELFBEAM_VECTORIZE
  for (std::size_t i = 0; i < rows; ++i) held[i] += in[i] - out[i];
}

SHELFBEAM_FOR_EACH_CPU
float SearchKernels::distance(const float* a, const float* b, std::size_t rows) {
  return sum_over(rows, [=](std::size_t i) { return larger(a[i], b[i]) - smaller(a[i], b[i]); });
}

SHELFBEAM_FOR_EACH_CPU
void SearchKernels::load(Receiving rule, const float* column, const Rows& rows, float* load) {
  const Rows r = rows;
  if (is_sum(rule))
    add_load<true>(column, r, load);
  else
    add_load<false>(column, r, load);
}

}  // namespace shelfbeam::detail
