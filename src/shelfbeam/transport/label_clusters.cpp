#include "shelfbeam/transport/label_clusters.hpp"

#include <algorithm>
#include <numeric>

namespace shelfbeam {

namespace {

// What a label looks upon lies before it: its point for all comparisons stands this far out, in metres.
constexpr double step_out = 0.8;

using Iterator = std::vector<std::uint32_t>::iterator;

void split(const std::vector<Vec3>& eyes, Iterator first, Iterator last, std::size_t most,
           std::vector<LabelCluster>& leaves) {
  const auto count = static_cast<std::size_t>(last - first);
  if (count == 0) return;
  if (count <= most) {
    leaves.emplace_back(first, last);
    return;
  }
  int widest = 0;
  double width = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(
        first, last, [&](std::uint32_t a, std::uint32_t b) { return eyes[a][axis] < eyes[b][axis]; });
    if (eyes[*high][axis] - eyes[*low][axis] > width) {
      width = eyes[*high][axis] - eyes[*low][axis];
      widest = axis;
    }
  }
  std::stable_sort(first, last,
                   [&](std::uint32_t a, std::uint32_t b) { return eyes[a][widest] < eyes[b][widest]; });
  // Into equal parts of as few clusters as it takes.
  const std::size_t parts = (count + most - 1) / most;
  const auto middle = first + static_cast<std::ptrdiff_t>(count * (parts / 2) / parts);
  split(eyes, first, middle, most, leaves);
  split(eyes, middle, last, most, leaves);
}

}  // namespace

std::vector<LabelCluster> cluster_labels(const World& world, std::size_t most) {
  const std::size_t m = world.receivers.size();
  std::vector<Vec3> eyes(m);
  for (std::size_t i = 0; i < m; ++i) {
    const SurfacePoint at = world.receivers.point(i, 0.5, 0.5);
    // No farther than half way to what stands opposite.
    const auto hit = world.rays.intersect(at, at.normal);
    const double room = hit ? hit->distance(at.position, at.normal) : 2 * step_out;
    eyes[i] = at.position + at.normal * std::min(step_out, room / 2);
  }
  std::vector<std::uint32_t> all(m);
  std::iota(all.begin(), all.end(), 0U);
  std::vector<LabelCluster> leaves;
  split(eyes, all.begin(), all.end(), most, leaves);

  std::vector<LabelCluster> clusters;
  std::vector<Vec3> targets;
  std::vector<float> seen;
  for (LabelCluster& leaf : leaves) {
    while (!leaf.empty()) {
      // In open air no side of a point matters.
      const SurfacePoint eye{eyes[leaf.front()], world.receivers.frame(leaf.front()).z};
      targets.clear();
      for (const std::uint32_t i : leaf) targets.push_back(eyes[i]);
      seen.assign(leaf.size(), 0);
      world.rays.in_sight(eye, targets, seen);
      seen[0] = 1;
      LabelCluster together, apart;
      for (std::size_t k = 0; k < leaf.size(); ++k) (seen[k] > 0 ? together : apart).push_back(leaf[k]);
      std::sort(together.begin(), together.end());
      clusters.push_back(std::move(together));
      leaf = std::move(apart);
    }
  }
  return clusters;
}

}  // namespace shelfbeam
