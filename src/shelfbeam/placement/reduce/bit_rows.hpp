#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace shelfbeam::detail {

/// Sets over 0 ... columns - 1, a bit each: rows of a 0/1 matrix.
class BitRows {
 public:
  BitRows(std::size_t rows, std::size_t columns) : words_((columns + 63) / 64), bits_(rows * words_, 0) {}

  void add(std::size_t row, std::size_t column) {
    bits_[row * words_ + column / 64] |= std::uint64_t{1} << column % 64;
  }

  std::span<const std::uint64_t> row(std::size_t row) const {
    return std::span(bits_).subspan(row * words_, words_);
  }

  bool is_subset(std::size_t part, std::size_t whole) const {
    const std::uint64_t* p = bits_.data() + part * words_;
    const std::uint64_t* w = bits_.data() + whole * words_;
    for (std::size_t k = 0; k < words_; ++k)
      if ((p[k] & ~w[k]) != 0) return false;
    return true;
  }

  /// Calls visit(column) for the columns of a row, ascending.
  template <class Visit>
  void for_each(std::size_t row, Visit visit) const {
    for (std::size_t k = 0; k < words_; ++k)
      for (std::uint64_t rest = bits_[row * words_ + k]; rest != 0; rest &= rest - 1)
        visit(static_cast<std::uint32_t>(64 * k + static_cast<std::size_t>(std::countr_zero(rest))));
  }

 private:
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

}  // namespace shelfbeam::detail
