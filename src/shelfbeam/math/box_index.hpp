#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// An axis-aligned box.
struct Bounds {
  Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void include(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void include(const Bounds& other) {
    include(other.low);
    include(other.high);
  }
  /// The box with every side moved outwards.
  Bounds wider_by(double margin) const {
    const Vec3 step{margin, margin, margin};
    return {low - step, high + step};
  }
  /// Distance to a point, squared; 0 inside.
  double distance_squared(const Vec3& p) const {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double away = std::max({low[axis] - p[axis], 0.0, p[axis] - high[axis]});
      sum += away * away;
    }
    return sum;
  }
  bool meets(const Bounds& other) const {
    for (int axis = 0; axis < 3; ++axis)
      if (low[axis] > other.high[axis] || high[axis] < other.low[axis]) return false;
    return true;
  }
};

/// Finds the boxes of a set that meet a given box: a binary tree over the boxes, split at the median.
class BoxIndex {
 public:
  explicit BoxIndex(std::vector<Bounds> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.reserve(2 * boxes_.size() / leaf_size + 1);
    if (!boxes_.empty()) build(0, boxes_.size());
  }

  /// Over the boxes of items.
  template <class Items, class BoxOf>
  static BoxIndex over(const Items& items, const BoxOf& box_of) {
    std::vector<Bounds> boxes;
    boxes.reserve(items.size());
    for (const auto& item : items) boxes.push_back(box_of(item));
    return BoxIndex(std::move(boxes));
  }

  /// Calls `use(index)` for the boxes that meet `query`, until it returns true. Returns whether it did.
  template <class Use>
  bool any(const Bounds& query, const Use& use) const {
    return !nodes_.empty() && any(0, 0, boxes_.size(), query, use);
  }

 private:
  static constexpr std::size_t leaf_size = 4;

  struct Node {
    Bounds box;
    std::uint32_t right = 0;  // the left child follows its parent
  };

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t index = nodes_.size();
    Bounds box;
    for (std::size_t k = begin; k < end; ++k) box.include(boxes_[order_[k]]);
    nodes_.push_back({box, 0});
    if (end - begin <= leaf_size) return index;
    const Vec3 size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto place = [](std::size_t k) { return static_cast<std::ptrdiff_t>(k); };
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + place(begin), order_.begin() + place(middle),
                     order_.begin() + place(end), [&](std::uint32_t a, std::uint32_t b) {
                       const double left = boxes_[a].low[axis] + boxes_[a].high[axis];
                       const double right = boxes_[b].low[axis] + boxes_[b].high[axis];
                       return left < right || (left == right && a < b);
                     });
    build(begin, middle);
    nodes_[index].right = static_cast<std::uint32_t>(build(middle, end));
    return index;
  }

  template <class Use>
  bool any(std::size_t node, std::size_t begin, std::size_t end, const Bounds& query, const Use& use) const {
    if (!nodes_[node].box.meets(query)) return false;
    if (end - begin <= leaf_size) {
      for (std::size_t k = begin; k < end; ++k)
        if (boxes_[order_[k]].meets(query) && use(order_[k])) return true;
      return false;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    return any(node + 1, begin, middle, query, use) || any(nodes_[node].right, middle, end, query, use);
  }

  std::vector<Bounds> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace shelfbeam
