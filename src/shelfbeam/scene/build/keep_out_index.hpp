#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// Finds whether a point lies in a keep-out area, in logarithmic time: a tree of rectangles that bound the
/// areas below them.
class KeepOutIndex {
 public:
  explicit KeepOutIndex(std::vector<KeepOut> areas);
  /// Areas include their edges.
  bool contains(const Vec3& p) const;

 private:
  struct Node {
    KeepOut bounds;
    std::size_t first, last;  ///< areas
    std::size_t right;        ///< node; the left one follows its parent. 0: a leaf
  };
  void add(std::size_t first, std::size_t last);

  std::vector<KeepOut> areas_;
  std::vector<Node> nodes_;  ///< the root first
};

}  // namespace shelfbeam
