#include "shelfbeam/transport/world/label_clusters.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

namespace shelfbeam {

namespace {

// Labels are compared by their eyes: the points this far in front of them, in metres.
constexpr double step_out = 0.8;
// Neighbours that are tested for visibility, as a multiple of the cluster size.
constexpr std::size_t candidates = 4;

// Distance to the opposite surface, ignoring panes.
double opposite_distance(const World& world, const SurfacePoint& at) {
  SurfacePoint from = at;
  for (;;) {
    const auto hit = world.rays.intersect(from, at.normal);
    if (!hit) return std::numeric_limits<double>::infinity();
    if (!is_pane(world.material(*hit))) return hit->distance(at.position, at.normal);
    from = hit->point;
  }
}

}  // namespace

std::vector<LabelCluster> cluster_labels(const World& world, std::span<const LabelId> labels,
                                         std::size_t most) {
  const std::size_t m = world.receivers.size();
  std::vector<Vec3> eyes(m);
  for (const LabelId i : labels) {
    const SurfacePoint at = world.receivers.point(i, 0.5, 0.5);
    // At most half way to the opposite surface.
    eyes[i] = at.position + at.normal * std::min(step_out, opposite_distance(world, at) / 2);
  }

  // From one end of the store to the other, the first remaining label forms a cluster with the nearest labels
  // that it sees, from eye to eye.
  std::vector<LabelId> left(labels.begin(), labels.end());
  std::stable_sort(left.begin(), left.end(),
                   [&](LabelId a, LabelId b) { return eyes[a].x + eyes[a].y < eyes[b].x + eyes[b].y; });
  std::vector<LabelCluster> clusters;
  std::vector<std::pair<double, LabelId>> near;
  std::vector<RayEnd> targets;
  std::vector<float> seen;
  std::vector<bool> is_taken(m);
  while (!left.empty()) {
    const LabelId first = left.front();
    near.clear();
    for (const LabelId i : left)
      if (i != first) near.emplace_back(length_squared(eyes[i] - eyes[first]), i);
    const std::size_t asked = std::min(near.size(), candidates * most);
    std::nth_element(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(asked), near.end());
    near.resize(asked);
    std::sort(near.begin(), near.end());
    targets.clear();
    for (const auto& [distance, i] : near) targets.push_back(eyes[i]);
    seen.assign(asked, 0);
    // The eye is in open air, where the sign of the normal has no effect.
    world.rays.shares({eyes[first], world.receivers.frame(first).z}, targets, seen);
    LabelCluster cluster{first};
    for (std::size_t k = 0; k < asked && cluster.size() < most; ++k)
      if (seen[k] > 0) cluster.push_back(near[k].second);
    for (const LabelId i : cluster) is_taken[i] = true;
    left.erase(std::remove_if(left.begin(), left.end(), [&](LabelId i) { return is_taken[i]; }), left.end());
    std::sort(cluster.begin(), cluster.end());
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

}  // namespace shelfbeam
