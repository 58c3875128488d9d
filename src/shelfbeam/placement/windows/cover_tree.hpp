#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"

namespace shelfbeam::detail {

/// A cover of few columns: every row requires one of its columns.
struct SmallCover {
  std::vector<std::vector<std::uint32_t>> rows;  ///< the columns of every row, ascending
  std::vector<double> cost;                      ///< of every column, not negative
};

struct CoverTreeLimits {
  Effort effort = {};  ///< its steps: nodes
  RunControl control = {};

  bool is_over() const { return effort.is_over(control); }
};

struct FoundCovers {
  double bound = 0;  ///< cheapest_cover alone, as `selected`; no cover costs less than this and `known`;
                     ///< lowered by more than rounding errors
  std::optional<std::vector<std::uint32_t>> selected;  ///< a cover that costs less than `known`
  std::vector<bool>
      contains;  ///< columns_of_covers alone; per column: some cover that costs at most `known` may have it
  bool complete = true;  ///< no limit came first: `selected` is the cheapest, or `contains` is exact
  std::uint64_t nodes = 0;
};

/// The cheapest cover that costs less than `known`, a finite number; exactly and depth first. A node has
/// chosen columns, open rows and multipliers y >= 0 of the open rows, so that every column that may still be
/// chosen has a slack
///
///   s_j = c_j - (sum of y_i over the open rows of j) >= 0.
///
/// No cover below the node costs less than lb = (cost of the chosen columns) + (sum of y_i over open rows),
/// and none with column j less than lb + s_j. Dual ascent raises y_i by the smallest slack of row i's
/// columns, row by row. Columns with lb + s_j of `known` or more are forbidden. The node branches on the open
/// row with the fewest columns left; a column already tried is forbidden in later branches.
///
/// If columns overlap much, as discs do, every choice pays twice for the rows that it shares with others, and
/// the tree is a hundred times faster than branch and bound by linear programs.
///
/// `y` are the root's first multipliers, best those of the LP; any are valid.
FoundCovers cheapest_cover(const SmallCover& cover, std::span<const double> y, double known,
                           const CoverTreeLimits& limits);

/// The columns of all covers that cost at most `known`, by the same tree; all columns if a limit came first.
/// Subtrees that have only columns that have been found already are omitted.
FoundCovers columns_of_covers(const SmallCover& cover, std::span<const double> y, double known,
                              const CoverTreeLimits& limits);

}  // namespace shelfbeam::detail
