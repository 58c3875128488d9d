#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/bound/dual_bound.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// Inequalities of one table by row and by column, over the columns that a SelectionSet leaves open, which
/// are numbered from 0. Chosen columns are subtracted from the right-hand sides. For searches only: single
/// precision, no allowance for rounding.
class SparseRows {
 public:
  struct Term {
    std::uint32_t index = 0;  ///< of a row or a column
    float a = 0;
  };

  SparseRows(const Instance& instance, std::span<const double> cost, const SelectionSet& selections,
             std::span<const BoundRow> rows);

  std::size_t rows() const { return rhs_.size(); }
  std::size_t columns() const { return column_.size(); }
  std::size_t entries() const { return of_row_.size(); }
  ColumnId column(std::size_t j) const { return column_[j]; }  ///< of the table
  double cost(std::size_t j) const { return cost_[j]; }
  double rhs(std::size_t i) const { return rhs_[i]; }
  std::span<const Term> row(std::size_t i) const { return part(of_row_, row_begin_, i); }
  std::span<const Term> of_column(std::size_t j) const { return part(of_column_, column_begin_, j); }
  /// The group of the options of one mounting point; `no_group` for a column with a point of its own.
  std::uint32_t group(std::size_t j) const { return group_[j]; }
  std::size_t groups() const { return groups_; }
  static constexpr std::uint32_t no_group = ~std::uint32_t{0};
  /// Columns chosen in every selection, ascending, and their cost.
  const std::vector<ColumnId>& chosen() const { return chosen_; }
  double chosen_cost() const { return chosen_cost_; }
  /// Of the units besides the chosen ones.
  std::size_t min_count() const { return min_count_; }
  std::size_t max_count() const { return max_count_; }

 private:
  static std::span<const Term> part(const std::vector<Term>& all, const std::vector<std::size_t>& begin,
                                    std::size_t k) {
    return std::span(all).subspan(begin[k], begin[k + 1] - begin[k]);
  }

  std::vector<ColumnId> column_, chosen_;
  std::vector<std::uint32_t> group_;
  std::vector<double> cost_, rhs_;
  std::vector<std::size_t> row_begin_ = {0}, column_begin_;
  std::vector<Term> of_row_, of_column_;
  std::size_t groups_ = 0, min_count_ = 0, max_count_ = 0;
  double chosen_cost_ = 0;
};

}  // namespace shelfbeam::detail
