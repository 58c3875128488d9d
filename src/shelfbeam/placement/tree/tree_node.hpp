#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shelfbeam/placement/kernels/search_kernels.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"

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

}  // namespace shelfbeam::detail
