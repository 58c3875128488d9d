#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/placement/tree/row_weights.hpp"
#include "shelfbeam/placement/tree/tree_run.hpp"

namespace shelfbeam::detail {

/// The submatrix for the nodes below a node: rows with a lack and allowed columns.
struct TreeWindow {
  std::vector<std::uint32_t> rows;  ///< of the search's matrix
  std::vector<std::uint32_t> slot;  ///< by column: its index in `values`
  std::size_t padded = 0;
  std::vector<float> values;

  TreeWindow() = default;
  explicit TreeWindow(const SearchMatrix& whole);

  const float* column(std::uint32_t j) const { return values.data() + slot[j] * padded; }
};

/// A node of the tree: the signals of the chosen columns in the rows of its window, and the allowed columns.
/// Symbols as in docs/methods/placement.md.
struct TreeNode {
  static constexpr std::uint32_t unlogged = ~std::uint32_t{0};

  std::shared_ptr<const TreeWindow> window;
  std::shared_ptr<const TreeWindow> below;  ///< of its children
  std::vector<std::uint32_t> kept;          ///< rows of `window` in `below`; unused if both are the same
  std::vector<float> value, best;           ///< by row: received signal and its largest part
  std::vector<float> lacking;               ///< r_i
  std::vector<float> weight;                ///< w_i
  std::vector<float> shift, counted;        ///< s_i, d_i
  std::vector<float> share;                 ///< r_i / b or r_i / C, the pigeonhole share
  std::vector<float> supporters;            ///< number of allowed columns with that share
  std::vector<ColumnId> allowed;            ///< A, ascending
  std::vector<float> gain;                  ///< v_j, one for each allowed column
  std::vector<ColumnId> order;              ///< branching columns, one per child
  std::uint32_t weights_id = unlogged;      ///< number of `weight` in the proof
  bool by_cost = false;                     ///< shares refer to the cost left, C, instead of the count b

  /// Sets the window; nothing is received yet, and the padding lacks nothing.
  void look_through(std::shared_ptr<const TreeWindow> through);
  /// Sets the window of the children, a smaller one if it saves much: rows that are met stay met, and
  /// forbidden columns stay forbidden. (If the target rises, the check on all rows finds rows no longer met.)
  void narrow();
  /// Becomes the child of `parent` that chooses `column`; `excluded` are the columns in conflict with it.
  void take(const TreeNode& parent, ColumnId column, Receiving rule, std::span<const ColumnId> excluded);
  void forbid(ColumnId column);
};

/// The surrogate bound that closes nodes (docs/methods/placement.md, "Tree search"). A node may add at most b
/// columns of A at a total cost of at most C. Row i lacks r_i, and one more column j contributes at most
/// g_ij. Let
///
///   s_i = 0.3 r_i / b for sum rules, else 0             part of every signal that is not counted
///   d_i = r_i - b s_i                                   lack beyond these parts
///   W   = sum_i w_i d_i                                 for any weights w_i >= 0
///   v_j = sum_i w_i min(d_i, max(0, g_ij - s_i))
///   B_k = p C + sum of the k largest positive v_j - p c_j in A, for any price p >= 0 of a cost c_j
///
/// Columns U of A that complete the node to a feasible selection supply at least d_i beyond s_i each in every
/// row. With |U| <= b and cost(U) <= C,
///
///   W <= sum_{j in U} v_j <= p C + sum_{j in U} (v_j - p c_j) <= B_b.
///
/// If W > B_b, no such U exists. The columns of U other than j contribute at most B_(b-1), so j in U requires
/// W <= v_j - p c_j + B_(b-1); columns that violate it are filtered.
struct Surrogate {
  double need = 0;         ///< W
  double largest = 0;      ///< B_b
  double without_one = 0;  ///< B_(b-1)
  float price = 0;         ///< p, the tried price with the smallest B_b

  static constexpr double safe = 1e-4;  ///< relative tolerance for single-precision sums of gains

  /// W > B_b: no columns complete the node.
  bool closes_node() const { return largest < need * (1 - safe); }
  /// W > v_j - p c_j + B_(b-1): no completion of the node contains j.
  bool rules_out(double gain, double cost) const {
    return gain - static_cast<double>(price) * cost < need * (1 - safe) - without_one;
  }
};

/// Computes and tests the surrogate bound for the nodes of one walk.
class SurrogateTest {
 public:
  explicit SurrogateTest(TreeRun& run) : run_(run) {}

  /// Computes s_i, d_i, v_j and the supporters of every row for `units` further units; `spent` is the cost of
  /// the chosen columns.
  void score(TreeNode& node, std::size_t units, std::int64_t spent);
  /// The bound of a scored node.
  Surrogate of(const TreeNode& node, std::size_t units, std::int64_t spent);
  /// Forbids the columns that the bound rules out; returns their number.
  std::size_t filter(TreeNode& node, const Surrogate& surrogate) const;
  /// One step of RowWeights, towards a larger W / B_b.
  void sharpen(TreeNode& node, std::size_t units);

 private:
  SearchKernels::Rows rows_of(const TreeNode& node) const;
  std::pair<double, double> largest_sums(const TreeNode& node, std::size_t units, double price);

  TreeRun& run_;
  std::vector<double> top_;
  RowWeights weights_;
};

}  // namespace shelfbeam::detail
