#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "shelfbeam/placement/kernels/search_kernels.hpp"

namespace shelfbeam::detail {

/// Multiplicative steps towards row weights w with a large surrogate bound (surrogate.hpp). With B the
/// `count` columns of the largest gain v_j,
///
///   served_i = sum_{j in B} min(d_i, max(0, g_ij - s_i)) / d_i,
///   w_i <- w_i exp(0.4 (1 - served_i)),   1 - served_i clipped to [-2, 1].
///
/// A common factor then sets the largest weight of a row with a lack to 1. Rows that the best columns serve
/// badly gain weight.
class RowWeights {
 public:
  /// `column(k)` has gain[k]; weights do not fall below `min_weight`. Rows::weight is not used.
  template <class Column>
  void step(Receiving rule, const SearchKernels::Rows& rows, std::span<const float> gain, std::size_t count,
            const Column& column, float min_weight, std::span<float> weight) {
    order_.resize(gain.size());
    std::iota(order_.begin(), order_.end(), 0U);
    const auto best = order_.begin() + static_cast<std::ptrdiff_t>(std::min(count, order_.size()));
    std::partial_sort(order_.begin(), best, order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return gain[a] > gain[b] || (gain[a] == gain[b] && a < b);
    });
    load_.assign(rows.count, 0.0F);
    for (auto k = order_.begin(); k != best; ++k) SearchKernels::load(rule, column(*k), rows, load_.data());

    constexpr float rate = 0.4F;
    constexpr float max_weight = 1e20F;  // rows without a lack would grow without limit
    float largest = 0;
    for (std::size_t i = 0; i < weight.size(); ++i) {
      weight[i] *= std::exp(rate * std::clamp(1 - load_[i], -2.0F, 1.0F));
      if (rows.lacking[i] > 0) largest = std::max(largest, weight[i]);
    }
    if (largest > 0)
      for (float& w : weight) w = std::clamp(w / largest, min_weight, max_weight);
  }

 private:
  std::vector<std::uint32_t> order_;
  std::vector<float> load_;
};

}  // namespace shelfbeam::detail
