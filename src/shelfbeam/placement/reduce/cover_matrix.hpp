#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/reduce/reductions.hpp"

namespace shelfbeam::detail {

/// The remainder of a cover as a 0/1 matrix; rows and columns are numbered from 0.
struct CoverMatrix {
  std::vector<std::vector<std::uint32_t>> rows;     ///< columns of every row, ascending
  std::vector<std::vector<std::uint32_t>> columns;  ///< rows of every column, ascending
  std::vector<double> cost;                         ///< of every column, not negative
  std::vector<ColumnId> column_of;                  ///< the table's column of every column

  /// All parts of the reduction together, without the columns in conflict with forced ones. Other conflicts
  /// are ignored.
  CoverMatrix(const Instance& instance, std::span<const double> cost, const Reduction& reduction);
};

}  // namespace shelfbeam::detail
