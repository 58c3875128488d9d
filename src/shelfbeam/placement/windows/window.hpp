#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/windows/cover_matrix.hpp"

namespace shelfbeam::detail {

/// Rows of a cover, the columns that meet them, and the part of each column's cost that is allotted to them.
struct Window {
  std::vector<std::uint32_t> rows, columns;  ///< ascending
  std::vector<double> weight;                ///< of every column, not negative
  std::vector<std::uint32_t> selected;       ///< ascending; reaches all rows; empty before the first search
  double value = 0;                          ///< no selection that reaches all rows has a smaller weight
  bool complete = false;                     ///< `selected` has this weight
  std::uint64_t nodes = 0;                   ///< of the last search
};

Window make_window(const CoverMatrix& cover, std::vector<std::uint32_t> rows);
/// With the weights of both.
Window merged(const CoverMatrix& cover, const Window& a, const Window& b);

/// Finds `selected` and `value`. Rows may have no column only if the problem is infeasible.
void search_window(const CoverMatrix& cover, Window& window, std::uint64_t max_nodes,
                   const milp::Backend& backend, const std::function<bool()>& stop);

/// The window's columns that no selection of weight up to value + `allowance` contains.
std::vector<std::uint32_t> useless_columns(const CoverMatrix& cover, const Window& window, double allowance,
                                           std::uint64_t max_nodes, const milp::Backend& backend,
                                           const std::function<bool()>& stop);

/// Omits columns.
void remove_columns(CoverMatrix& cover, const std::vector<bool>& is_removed);
void remove_columns(Window& window, const std::vector<bool>& is_removed);

}  // namespace shelfbeam::detail
