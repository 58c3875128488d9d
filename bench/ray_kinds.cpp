#include "ray_kinds.hpp"

#include <algorithm>

namespace shelfbeam::bench {

RayKinds ray_kinds(const World& world, const Selection& selection) {
  const auto rays_with = [&](const ReuseEffort& effort) {
    const ReuseEstimator reuse(world, 1, effort);
    BatchValues values;
    for (const std::size_t item : selection.items) {
      values.clear();
      reuse.sample(item, 0, nullptr, values);
    }
    return static_cast<double>(values.rays);
  };
  ReuseEffort effort;
  const double first_hits = static_cast<double>(effort.points) * static_cast<double>(selection.labels.size());
  const double gather_rays = effort.gather_rays;
  const double all = rays_with(effort);
  effort.stake = 1e12;
  const double without_shadow = rays_with(effort);
  effort.group = 1;
  const double unshared = rays_with(effort);  // later vertices
  effort.gather_rays = effort.later_gather_rays = 0;
  const double without_gathering = rays_with(effort);
  effort.points = 0;
  const double lookups = rays_with(effort);

  RayKinds kinds;
  kinds.shadow = all - without_shadow;
  kinds.visibility = without_shadow - unshared + std::max(0.0, without_gathering - lookups - first_hits);
  kinds.single = all - kinds.shadow - kinds.visibility;
  kinds.shadow_packet = kinds.shadow * gather_rays / (unshared - without_gathering);
  return kinds;
}

}  // namespace shelfbeam::bench
