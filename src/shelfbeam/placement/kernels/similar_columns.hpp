#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/placement/kernels/growing_columns.hpp"
#include "shelfbeam/placement/kernels/search_kernels.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"

namespace shelfbeam::detail {

/// For a column j, the columns l with the smallest distance over a sample of rows,
///
///   D(j, l) = sum_i |a_ij - a_il|,   a_ij clipped at 1.
///
/// In a shop these are its neighbours; no positions are required. Computed on first use.
class SimilarColumns {
 public:
  SimilarColumns(const SearchMatrix& all, std::span<const ColumnId> candidates)
      : candidates_(candidates.begin(), candidates.end()), sample_(all.columns()), similar_(all.columns()) {
    constexpr std::size_t looked_at = 512;
    const std::size_t step = std::max<std::size_t>(1, all.rows() / looked_at);
    sample_.add_rows((all.rows() + step - 1) / step,
                     [&](std::size_t r, std::size_t j) { return std::min(all.column(j)[r * step], 1.0F); });
  }

  /// Up to 60 candidates other than `column`, the most similar first.
  std::span<const ColumnId> to(ColumnId column) {
    constexpr std::size_t max_count = 60;
    std::vector<ColumnId>& similar = similar_[column];
    if (!similar.empty()) return similar;
    std::vector<std::pair<float, std::uint32_t>> by_distance;
    const float* const own = sample_.column(column);
    for (const ColumnId j : candidates_) {
      if (j == column) continue;
      by_distance.emplace_back(SearchKernels::distance(own, sample_.column(j), sample_.padded()), j);
    }
    const std::size_t count = std::min(max_count, by_distance.size());
    std::partial_sort(by_distance.begin(), by_distance.begin() + static_cast<std::ptrdiff_t>(count),
                      by_distance.end());
    for (std::size_t k = 0; k < count; ++k) similar.push_back(by_distance[k].second);
    return similar;
  }

 private:
  std::vector<ColumnId> candidates_;
  GrowingColumns sample_;
  std::vector<std::vector<ColumnId>> similar_;
};

}  // namespace shelfbeam::detail
