#include "shelfbeam/transport/cache/spot_light.hpp"

#include <algorithm>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/world/next_event.hpp"

namespace shelfbeam {

double SpotLight::intensity(const Scene& scene, const Vec3& direction) const {
  const double cosine = dot(direction, point.normal);
  if (cosine <= 0) return 0;
  return power * cosine * eval(scene.materials[material.value].material, frame.to_local(direction), incoming);
}

namespace {

// The irradiance of points by the light of a unit above its cap from surfaces in view.
double gathered_excess(const World& world, const UnitGroups& units, const std::vector<SurfaceGuide>& guides,
                       std::span<const SurfacePoint> points, std::uint32_t lane_index, std::uint64_t stream) {
  constexpr std::uint32_t count = 128;
  const std::size_t g = lane_index / lanes, lane = lane_index % lanes;
  const Vec3& unit = world.scene.transceivers[units.column(g, lane)].position;
  const ScrambledSobol square(stream);
  double sum = 0;
  for (std::uint32_t r = 0; r < count; ++r) {
    const SurfacePoint& at = points[r % points.size()];
    const auto [u1, u2] = square.point(r);
    const Vec3 direction = Frame::about(at.normal).to_world(sample_cosine_hemisphere(u1, u2));
    const auto hit = world.rays.intersect(at, direction);
    if (!hit) continue;
    SurfacePoint there = hit->point;
    if (dot(there.normal, direction) > 0) there.normal = -there.normal;
    LaneValues e;
    units.irradiance(g, LanePoint(there), e);
    const float excess = e[lane] - units.cap(g, lane);
    if (!(excess > 0)) continue;
    sum += static_cast<double>(excess * guides[hit->material.value].flat()) *
           world.rays.transmittance(there, unit).share;
  }
  return pi * sum / count;
}

}  // namespace

std::vector<SpotIrradiance> light_from_spots(const World& world, const UnitGroups& units,
                                             const std::vector<SurfaceGuide>& guides,
                                             std::span<const SurfacePoint> points,
                                             std::span<const SpotLight> spots, float threshold,
                                             std::uint64_t stream) {
  constexpr double closest = 0.05, near = 0.5, largest = 1;  // m, the last of cells and spots
  std::vector<SpotIrradiance> light;
  for (std::size_t first = 0, last = 0; first < spots.size(); first = last) {
    const std::uint32_t lane_index = spots[first].lane_index;
    while (last < spots.size() && spots[last].lane_index == lane_index) ++last;
    const Vec3& unit =
        world.scene.transceivers[units.column(lane_index / lanes, lane_index % lanes)].position;
    const double away = length(points[0].position - unit);
    double power = 0;
    for (const SpotLight& spot : spots.subspan(first, last - first)) power += spot.power * (1 - spot.capped);
    const double nearest = std::max(near, away - largest);
    if (power < static_cast<double>(threshold) * pi * nearest * nearest) continue;
    double irradiance = 0;
    if (away < near) {
      irradiance = gathered_excess(world, units, guides, points, lane_index, mix_key(stream, lane_index));
    } else {
      for (const SpotLight& spot : spots.subspan(first, last - first))
        for (const SurfacePoint& point : points) {
          const auto seen = sight(point.position, spot.point);
          if (!seen) continue;
          const double cosine = dot(seen->direction, point.normal);
          if (!(cosine > 0)) continue;
          const double part = spot.intensity(world.scene, -seen->direction) * (1 - spot.capped) * cosine /
                              std::max(closest * closest, seen->distance_squared);
          if (part * static_cast<double>(last - first) < static_cast<double>(threshold)) continue;
          irradiance +=
              part * world.rays.transmittance(point, spot.point).share / static_cast<double>(points.size());
        }
    }
    if (irradiance > 0) light.push_back({lane_index, static_cast<float>(irradiance)});
  }
  return light;
}

}  // namespace shelfbeam
