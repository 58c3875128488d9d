#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// Labels and columns that have nothing to do with those of another part.
struct CoverPart {
  std::vector<std::uint32_t> labels;   ///< ascending
  std::vector<std::uint32_t> columns;  ///< ascending
};

/// What is left of a non-cooperative question. Where some selection meets every label, one of least cost
/// consists of `forced` and, for every part, a selection of least cost among its columns that reaches its
/// labels, keeps at most one unit a mounting point and heeds what pinned columns ask for, forced ones
/// among them.
struct Reduction {
  bool infeasible = false;            ///< a label is out of reach of all that may be chosen
  std::vector<std::uint32_t> forced;  ///< installed and forced columns, ascending
  std::vector<CoverPart> parts;       ///< in the order of their first label, without labels last
};

/// Reduces sum_j l_ij T_j >= 1, until nothing changes any more:
/// - a label with one column: that is forced, its labels are met, the other options of its point are out;
/// - a label reached by all columns of another label is met with it, so it is dropped; of equal ones the
///   first stays;
/// - a column is dropped where another one reaches all of its labels, costs no more, and may stand in for it:
///   has a point of its own or is an option of the same point. So is one that reaches no label any more.
///
/// `cost` must not be negative. `pinned` (empty: none; otherwise one a column) are columns with constraints
/// that this does not know: none of them is dropped or takes the place of another, they are forced only where
/// a label needs them, and all that are left are in one part. For an objective at the fewest units (every
/// unit counts 1) `cost` is that objective: a column is then exchanged for another one at no greater value.
///
/// Where `stop` says so it ends with what it has, which is as valid and only less reduced. Not valid where
/// labels must be reached twice.
Reduction reduce_cover(const SignalTable& table, const Question& question, std::span<const double> cost,
                       const std::vector<bool>& pinned = {}, const std::function<bool()>& stop = {});

}  // namespace shelfbeam::detail
