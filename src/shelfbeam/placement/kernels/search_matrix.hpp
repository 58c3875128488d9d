#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shelfbeam/placement/kernels/search_kernels.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// M_ij / (gamma_i tau_i) in single precision, by column, for some rows of a table. Decisions based on it
/// require a margin of `search_tolerance` or a check with the table. Only l_ij is exact (non-cooperative):
/// entries are at least 1 if and only if the link reaches the label.
class SearchMatrix {
 public:
  static constexpr std::size_t block = 16;  ///< row counts are padded with zeros to a multiple

  SearchMatrix(const Instance& instance, std::vector<LabelId> rows);
  /// All rows of the table.
  explicit SearchMatrix(const Instance& instance);

  std::size_t rows() const { return rows_.size(); }
  std::size_t padded_rows() const { return padded_; }
  std::size_t columns() const { return columns_; }
  LabelId row(std::size_t i) const { return rows_[i]; }  ///< of the table
  const float* column(std::size_t j) const { return values_.data() + j * padded_; }

 private:
  std::vector<LabelId> rows_;
  std::size_t padded_ = 0, columns_ = 0;
  std::vector<float> values_;
};

/// Relative tolerance for single precision in sums over a selection.
inline constexpr double search_tolerance = 2e-5;

Receiving receiving(const PlacementProblem& problem);

/// The minimum margin of a selection, in double precision and by the rule of received_signal.
struct Margin {
  double smallest = 0;  ///< min_i S_i / (gamma_i tau_i); infinite without labels
  LabelId label;        ///< label with that margin, among the missed labels if there are any
  bool is_met = true;   ///< every label is reached
};

/// `all` contains all rows of the table. `received` is a buffer.
Margin margin_of(const Instance& instance, const SearchMatrix& all, std::span<const ColumnId> selected,
                 std::vector<float>& received);

}  // namespace shelfbeam::detail
