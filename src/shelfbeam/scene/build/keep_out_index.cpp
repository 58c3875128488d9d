#include "shelfbeam/scene/build/keep_out_index.hpp"

#include <algorithm>
#include <utility>

namespace shelfbeam {

namespace {

constexpr std::size_t leaf_size = 4;

bool is_in(const KeepOut& area, const Vec3& p) {
  constexpr double slack = 1e-9;
  return p.x >= area.min[0] - slack && p.x <= area.max[0] + slack && p.y >= area.min[1] - slack &&
         p.y <= area.max[1] + slack;
}

}  // namespace

KeepOutIndex::KeepOutIndex(std::vector<KeepOut> areas) : areas_(std::move(areas)) {
  if (!areas_.empty()) add(0, areas_.size());
}

// Halves the areas along the axis in which their middles differ most.
void KeepOutIndex::add(std::size_t first, std::size_t last) {
  const std::size_t own = nodes_.size();
  KeepOut bounds = areas_[first];
  const auto middle = [](const KeepOut& area, std::size_t axis) { return area.min[axis] + area.max[axis]; };
  KeepOut middles{{middle(bounds, 0), middle(bounds, 1)}, {middle(bounds, 0), middle(bounds, 1)}};
  for (std::size_t k = first; k < last; ++k)
    for (const std::size_t axis : {0U, 1U}) {
      bounds.min[axis] = std::min(bounds.min[axis], areas_[k].min[axis]);
      bounds.max[axis] = std::max(bounds.max[axis], areas_[k].max[axis]);
      middles.min[axis] = std::min(middles.min[axis], middle(areas_[k], axis));
      middles.max[axis] = std::max(middles.max[axis], middle(areas_[k], axis));
    }
  nodes_.push_back({bounds, first, last, 0});
  if (last - first <= leaf_size) return;
  const std::size_t axis = middles.max[0] - middles.min[0] >= middles.max[1] - middles.min[1] ? 0 : 1;
  const std::size_t half = first + (last - first) / 2;
  const auto at = [&](std::size_t k) { return areas_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(first), at(half), at(last),
                   [&](const KeepOut& a, const KeepOut& b) { return middle(a, axis) < middle(b, axis); });
  add(first, half);
  nodes_[own].right = nodes_.size();
  add(half, last);
}

bool KeepOutIndex::contains(const Vec3& p) const {
  std::vector<std::size_t> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const std::size_t own = open.back();
    const Node& node = nodes_[own];
    open.pop_back();
    if (!is_in(node.bounds, p)) continue;
    if (node.right != 0) {
      open.insert(open.end(), {node.right, own + 1});
      continue;
    }
    for (std::size_t k = node.first; k < node.last; ++k)
      if (is_in(areas_[k], p)) return true;
  }
  return false;
}

}  // namespace shelfbeam
