#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/kernels/search_matrix.hpp"

namespace shelfbeam::detail {

/// For a column, those that give labels the most similar signals: the least sum over a sample of rows of
/// |a_ij - a_il|, signals clipped at 1. In a shop that is who hangs nearby; it needs no positions. Found when
/// first asked for.
class SimilarColumns {
 public:
  SimilarColumns(const SearchMatrix& all, std::span<const std::uint32_t> candidates);

  /// Up to 60 candidates other than `column`, the most similar first.
  std::span<const std::uint32_t> to(std::uint32_t column);

 private:
  std::vector<std::uint32_t> candidates_;
  std::size_t sampled_ = 0;  ///< rows, padded as in a SearchMatrix
  std::vector<float> sample_;
  std::vector<std::vector<std::uint32_t>> similar_;
};

}  // namespace shelfbeam::detail
