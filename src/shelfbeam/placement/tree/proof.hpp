#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/verdict.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// The log of a tree search that found nothing: a proof that no feasible selection has at most `max_units`
/// units and a cost of at most `max_cost` (a multiple of Instance::cost_unit).
///
/// A node has a set of chosen columns (at the root the installed units) and a set A of allowed columns; b is
/// the number of columns that may still be added, C their maximum cost. Label i lacks r_i, and one more
/// column j contributes at most g_ij (docs/methods/placement.md, "Tree search"). `steps` contains the nodes
/// in depth-first order, each as a tag with arguments:
struct Proof {
  enum Tag : std::uint32_t {
    open,  ///< not examined, proves nothing
    /// Argument: row. The row is violated and b = 0.
    row_fails,
    /// Arguments: weights, price. Surrogate bound: with s_i = `shift` r_i / b for sum rules (otherwise 0) and
    /// d_i = r_i - b s_i,
    ///
    ///   sum_i w_i d_i > p C + sum of the b largest positive v_j - p c_j in A,
    ///   v_j = sum_i w_i min(d_i, max(0, g_ij - s_i)).
    ///
    /// Valid because b columns that together supply r_i supply at least d_i beyond s_i each.
    sum_fails,
    /// Arguments: weights, price. Columns that the same inequality rules out leave A; the node continues.
    filter,
    /// b = 1, and neither the chosen columns alone nor with any one allowed column reach every label.
    single_fails,
    /// The chosen columns cost more than `max_cost`.
    cost_fails,
    /// Arguments: row, by_cost, count, then `count` columns, each followed by its child; each column is
    /// forbidden in later children. Pigeonhole: a selection that satisfies the row has a column with g_ij >=
    /// r_i / b and, with costs, a column with g_ij >= r_i c_j / C. All allowed columns of this kind are
    /// listed.
    branch
  };

  /// Part of each column's even share r_i / b that is not counted (sum rules), so that columns that
  /// contribute more stand out. This tightens the bound.
  static constexpr double shift = 0.3;

  std::size_t max_units = 0;
  std::int64_t max_cost = 0;
  bool is_complete = false;
  std::vector<LabelId> rows;  ///< of the table; weights refer to these rows
  /// Indexed by the upper and lower half of the weights' number.
  std::vector<std::vector<std::vector<float>>> weights;
  std::vector<std::uint32_t> steps;  ///< prices as the bits of a float
};

/// Verifies a proof in double precision from the table and the problem of `instance` alone, using nothing of
/// the search but the proof. Only the time of `effort` counts.
ProofVerdict judge_proof(const Instance& instance, const Proof& proof, const Effort& effort = {},
                         const RunControl& control = {});

}  // namespace shelfbeam::detail
