#pragma once

#include <functional>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// An independent part: no label and no mounting point extends over two parts.
struct CoverPart {
  std::vector<LabelId> labels;    ///< ascending
  std::vector<ColumnId> columns;  ///< ascending
};

/// The remainder of a non-cooperative problem. If a feasible selection exists, one of minimum cost consists
/// of `forced` and, for every part, a selection of minimum cost among its columns that reaches its labels,
/// has at most one unit per mounting point, and respects the constraints of pinned columns, forced ones
/// included.
struct Reduction {
  bool infeasible = false;       ///< some label has no open column
  std::vector<ColumnId> forced;  ///< installed and forced columns, ascending
  std::vector<CoverPart> parts;  ///< in the order of their first label, parts without labels last
};

/// Reduces the cover sum_j l_ij T_j >= 1 until nothing changes (docs/methods/placement.md, "Reductions"):
/// - forced column: the only open column of a label is forced; its labels are dropped, the other options of
///   its mounting point closed;
/// - dominated row: a label is dropped if its open columns include those of another label; the first of
///   equal rows stays;
/// - dominated column: a column is closed if an open column reaches all of its labels, costs no more, and has
///   a mounting point of its own or shares that of the column. A column that reaches no remaining label is
///   closed.
///
/// `cost` must not be negative. `pinned` (empty: none; otherwise one per column) marks columns with
/// constraints unknown here: they are neither closed nor used to close others, are forced only if a label
/// requires them, and the remaining ones form one part. For an objective at the minimum count, where every
/// unit counts 1, `cost` is that objective: a column is then exchanged for another at no greater value.
/// Columns of `omitted` are closed from the beginning: the result concerns selections without them.
///
/// If `stop` returns true, the reduction ends early and is still valid. It is not valid if labels must be
/// reached twice.
Reduction reduce_cover(const Instance& instance, std::span<const double> cost,
                       const std::vector<bool>& pinned = {}, const std::function<bool()>& stop = {},
                       std::span<const ColumnId> omitted = {});

/// Per column: in conflict with a forced one. Such columns may be left in the parts.
std::vector<bool> blocked_columns(const Instance& instance, const Reduction& reduction);

}  // namespace shelfbeam::detail
