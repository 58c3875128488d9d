#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "shelfbeam/placement/kernels/search_matrix.hpp"

namespace shelfbeam::detail {

/// A matrix in single precision, stored by column, to which rows are added.
class GrowingColumns {
 public:
  explicit GrowingColumns(std::size_t columns) : columns_(columns) {}

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  /// `rows` rounded up to a multiple of SearchMatrix::block; the rows from `rows` on are zeros.
  std::size_t padded() const { return (rows_ + block - 1) / block * block; }
  const float* column(std::size_t j) const { return values_.data() + j * stride_; }
  float& at(std::size_t r, std::size_t j) { return values_[j * stride_ + r]; }

  /// Adds `count` rows with the values value(k, j), k = 0 ... count - 1.
  template <class Value>
  void add_rows(std::size_t count, const Value& value) {
    const std::size_t before = rows_;
    rows_ += count;
    if (padded() > stride_) {
      const std::size_t wider = std::max(2 * stride_, padded());
      std::vector<float> values(wider * columns_, 0.0F);
      for (std::size_t j = 0; j < columns_; ++j)
        std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(j * stride_), before,
                    values.begin() + static_cast<std::ptrdiff_t>(j * wider));
      values_ = std::move(values);
      stride_ = wider;
    }
    for (std::size_t j = 0; j < columns_; ++j)
      for (std::size_t k = 0; k < count; ++k) at(before + k, j) = value(k, j);
  }

 private:
  static constexpr std::size_t block = SearchMatrix::block;

  std::size_t columns_ = 0, rows_ = 0;
  std::size_t stride_ = 0;  ///< distance between columns, with room to grow
  std::vector<float> values_;
};

}  // namespace shelfbeam::detail
