#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/reduce/cover_matrix.hpp"
#include "shelfbeam/placement/windows/cover_tree.hpp"

namespace shelfbeam::detail {

/// Rows of a cover, the columns that meet them, and the part of each column's cost that is allotted to them.
struct Window {
  std::vector<std::uint32_t> rows, columns;  ///< ascending
  std::vector<double> weight;                ///< of every column, not negative
  /// Ascending; reaches all rows. Empty before the first search and after the removal of one of them.
  std::vector<std::uint32_t> selected;
  double value = 0;        ///< no selection that reaches all rows has a smaller weight
  bool complete = false;   ///< `selected` has this weight
  std::uint64_t work = 0;  ///< of the last search, in nodes of trees
};

Window make_window(const CoverMatrix& cover, std::vector<std::uint32_t> rows);
/// With the weights of both.
Window merged(const CoverMatrix& cover, const Window& a, const Window& b);

/// Finds `selected` and `value`. Rows may have no column only if the problem is infeasible.
void search_window(const CoverMatrix& cover, Window& window, const CoverTreeLimits& limits,
                   const milp::Backend& backend);

/// The window's columns that no selection of weight up to value + `allowance` contains. Sets `work`.
std::vector<std::uint32_t> examine_columns(const CoverMatrix& cover, Window& window, double allowance,
                                           const CoverTreeLimits& limits, const milp::Backend& backend);

/// Omits columns.
void remove_columns(CoverMatrix& cover, const std::vector<bool>& is_removed);
void remove_columns(Window& window, const std::vector<bool>& is_removed);

}  // namespace shelfbeam::detail
