#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/placement/kernels/growing_columns.hpp"
#include "shelfbeam/placement/kernels/search_kernels.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"

namespace shelfbeam::detail {

/// The rows of a SearchMatrix that a search works on, stored by column. Entries are clipped at 1 (sums), or 1
/// if the link reaches the label and 0 otherwise. A few rows of a table usually determine the result.
class ActiveRows {
 public:
  ActiveRows(const SearchMatrix& all, Receiving rule);

  std::size_t rows() const { return rows_.size(); }
  std::size_t padded() const { return values_.padded(); }  ///< GrowingColumns
  LabelId row(std::size_t r) const { return rows_[r]; }    ///< of the table
  const float* column(std::size_t j) const { return values_.column(j); }

  float used_of(LabelId row, ColumnId column) const;

  /// A search starts with this many rows.
  static constexpr std::size_t at_first = 256;
  /// Adds the `count` rows that receive the smallest signals from a selection.
  void add_hardest(std::span<const ColumnId> selected, std::size_t count);
  /// For a selection that meets all active rows but misses labels: adds up to 32 rows with the largest lack
  /// by `received` (the signal of every row of `all`), or else `label`, which is missed in double precision.
  /// Returns false if that row is active already, so only single precision accepts it.
  bool add_missed(std::span<const float> received, LabelId label);
  /// Adds all rows. Precondition: none is active.
  void add_all();
  /// Lowers the entries of a row that single precision wrongly accepts.
  void tighten(LabelId label);

 private:
  /// Adds the rows that are not active yet.
  void take(std::span<const LabelId> rows);
  void take_weakest(std::vector<std::pair<float, LabelId>>& by_received, std::size_t count);

  const SearchMatrix& all_;
  Receiving rule_;
  std::vector<LabelId> rows_;
  std::vector<bool> is_known_;
  GrowingColumns values_;
};

}  // namespace shelfbeam::detail
