#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/placement/kernels/search_kernels.hpp"
#include "shelfbeam/placement/kernels/search_problem.hpp"

namespace shelfbeam::detail {

/// The rows of a SearchMatrix that a search over selections has met with so far, column by column, each entry
/// what the row can use of the signal: at most 1 of it where signals add up, else 1 where the link reaches
/// the label and 0 elsewhere. Rows of a table are many, and few of them decide.
class ActiveRows {
 public:
  ActiveRows(const SearchMatrix& all, Receiving rule);

  std::size_t size() const { return rows_.size(); }
  /// `size` rounded up to a multiple of SearchMatrix::block; the rows beyond `size` are zeros.
  std::size_t padded() const { return (rows_.size() + block - 1) / block * block; }
  std::uint32_t row(std::size_t r) const { return rows_[r]; }  ///< of the table
  const float* column(std::size_t j) const { return values_.data() + j * stride_; }

  float used_of(std::uint32_t row, std::uint32_t column) const;

  /// Adds the `count` rows to which a selection gives least.
  void take_hardest_for(std::span<const std::uint32_t> selected, std::size_t count);
  /// After a selection that meets all active rows failed on all: adds those that lack most of `received`
  /// (what every row of `all` receives), 32 at most, or `label`, which the rule says is not met. Returns
  /// false where that is active already: only single precision takes it for met.
  bool learn(std::span<const float> received, std::uint32_t label);
  /// Counts a little less of what a label receives, after single precision took it for met.
  void ask_more_of(std::uint32_t label);

 private:
  /// Adds rows that are not known yet.
  void take(std::span<const std::uint32_t> rows);
  void take_least(std::vector<std::pair<float, std::uint32_t>>& by_received, std::size_t count);

  static constexpr std::size_t block = SearchMatrix::block;

  const SearchMatrix& all_;
  Receiving rule_;
  std::vector<std::uint32_t> rows_;
  std::vector<bool> is_known_;
  std::size_t stride_ = 0;  ///< from column to column; room to grow
  std::vector<float> values_;
};

}  // namespace shelfbeam::detail
