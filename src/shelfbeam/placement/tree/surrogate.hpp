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

/// The part of a search's matrix that matters below a node: rows that lack something, columns that are
/// allowed.
struct TreeWindow {
  std::vector<std::uint32_t> rows;  ///< of the search's matrix
  std::vector<std::uint32_t> slot;  ///< by column
  std::size_t padded = 0;
  std::vector<float> values;

  TreeWindow() = default;
  explicit TreeWindow(const SearchMatrix& whole);

  const float* column(std::uint32_t j) const { return values.data() + slot[j] * padded; }
};

/// A node of the tree: what the chosen columns give to the rows of its window, and what may still be chosen.
/// Symbols are those of docs/methods/placement.md.
struct TreeNode {
  static constexpr std::uint32_t unlogged = ~std::uint32_t{0};

  std::shared_ptr<const TreeWindow> window;
  std::shared_ptr<const TreeWindow> below;  ///< of its children
  std::vector<std::uint32_t> kept;          ///< rows of `window` that `below` has; unused where both are one
  std::vector<float> value, best;           ///< by row: what it receives, and the largest signal of that
  std::vector<float> lacking;               ///< r_i
  std::vector<float> weight;                ///< w_i
  std::vector<float> shift, counted;        ///< s_i, d_i
  std::vector<float> share;                 ///< r_i / b or r_i / C: columns that give that are branched on,
  std::vector<float> supporters;            ///< and so many do
  std::vector<std::uint32_t> allowed;       ///< A, ascending
  std::vector<float> gain;                  ///< v_j, one for each allowed column
  std::vector<std::uint32_t> order;         ///< the columns of its children
  std::uint32_t weights_id = unlogged;      ///< of `weight` in the proof
  bool by_cost = false;                     ///< shares are of the cost that is left, not of the units

  /// Through this window nothing is received yet, and the padding lacks nothing.
  void look_through(std::shared_ptr<const TreeWindow> through);
  /// Gives children that have many of their own a window of what is left: whoever is met stays met, and
  /// whoever is forbidden stays so. (Where the target rises, rows that are met no more are found in the end.)
  void narrow();
  /// Becomes the child of `parent` that takes a column, which forbids those that it excludes.
  void take(const TreeNode& parent, std::uint32_t column, Receiving rule,
            std::span<const std::uint32_t> excluded);
  void forbid(std::uint32_t column);
};

/// The inequality by which nodes are closed (docs/methods/placement.md, "Tree search"). A node may add b
/// columns of A at a cost of C in all; row i lacks r_i, of which one more column j gives g_ij at most. Let
///
///   s_i = 0.3 r_i / b where signals add up, else 0      what of every signal is not counted
///   d_i = r_i - b s_i                                   what is lacking then
///   W   = sum_i w_i d_i                                 for any weights w_i >= 0
///   v_j = sum_i w_i min(d_i, max(0, g_ij - s_i))
///   B_k = p C + the sum of the k largest positive v_j - p c_j of A, for any price p >= 0 of a cost c_j
///
/// Columns U of A that complete the node to an answer give every row d_i beyond s_i each, so with |U| <= b
/// and cost(U) <= C
///
///   W <= sum_{j in U} v_j <= p C + sum_{j in U} (v_j - p c_j) <= B_b.
///
/// Where W > B_b there is no such U. And as all of U but j have B_(b-1) - p C at most, W <= v_j - p c_j +
/// B_(b-1) for every j in U: columns for which that fails are in none.
struct Surrogate {
  double need = 0;         ///< W
  double most = 0;         ///< B_b
  double without_one = 0;  ///< B_(b-1)
  float price = 0;         ///< p, of those that were tried the one of the smallest B_b

  static constexpr double safe = 1e-4;  ///< what float sums of gains may be off, with room to spare

  /// W > B_b: no columns complete the node.
  bool closes_node() const { return most < need * (1 - safe); }
  /// W > v_j - p c_j + B_(b-1): no columns that complete the node have j among them.
  bool rules_out(double gain, double cost) const {
    return gain - static_cast<double>(price) * cost < need * (1 - safe) - without_one;
  }
};

/// Sets up and tests that inequality for nodes of one walk.
class SurrogateTest {
 public:
  explicit SurrogateTest(TreeRun& run) : run_(run) {}

  /// s_i, d_i and v_j of the node for `units` further units, and how many columns give each row its share;
  /// `spent` is the cost of the chosen ones.
  void score(TreeNode& node, std::size_t units, std::int64_t spent);
  /// Of a node that has been scored.
  Surrogate of(const TreeNode& node, std::size_t units, std::int64_t spent);
  /// Forbids the columns that it rules out; returns how many.
  std::size_t filter(TreeNode& node, const Surrogate& surrogate) const;
  /// A step towards weights of a larger W / B_b.
  void sharpen(TreeNode& node, std::size_t units);

 private:
  SearchKernels::Rows rows_of(const TreeNode& node) const;
  std::pair<double, double> largest_sums(const TreeNode& node, std::size_t units, double price);

  TreeRun& run_;
  std::vector<double> top_;
  RowWeights weights_;
};

}  // namespace shelfbeam::detail
