#include "bare_rays.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"

#include "support.hpp"

namespace shelfbeam::bench {

namespace {

constexpr std::size_t ray_count = 20000;
constexpr std::size_t packet_count = 1000;

}  // namespace

BareRays::BareRays(const World& world) : world_(world) {
  const auto n = static_cast<std::uint32_t>(world.emitters.size());
  for (std::uint32_t walk = 0; rays_.size() < ray_count; ++walk) {
    // 7919 is prime, so that the labels come from the whole store.
    SurfacePoint from = world.receivers.point(walk * 7919ULL % world.receivers.size(), 0.5, 0.5);
    for (std::uint32_t vertex = 0; vertex < 3; ++vertex) {  // about the mean length of a walk at albedo 0.7
      const auto u = philox({vertex, walk, 0, 0}, 1);
      const Vec3 local = sample_cosine_hemisphere(to_uniform(u[1]), to_uniform(u[2]));
      const Vec3 direction = Frame::about(from.normal).to_world(local);
      const Vec3 target = world.emitters.point(to_index(u[0], n), 0.5, 0.5).position;
      rays_.push_back({from, direction, target});
      const auto hit = world.rays.intersect(from, direction);
      if (!hit) break;
      from = hit->point;
      if (dot(from.normal, direction) > 0) from.normal = -from.normal;
    }
  }
}

BareRays::BareRays(const World& world, std::size_t shadow_rays, std::span<const LabelCluster> clusters)
    : BareRays(world) {
  // Packets of shadow rays to the units that contribute most.
  for (const Ray& ray : rays_) {
    if (shadow_packets_.size() == packet_count) break;
    std::vector<std::pair<double, Vec3>> units;
    for (std::size_t j = 0; j < world.emitters.size(); ++j) {
      const LightPoint light = world.emitters.point(j, 0.5, 0.5);
      const Vec3 way = light.position - ray.from.position;
      const double squared = length_squared(way), facing = dot(way, ray.from.normal);
      if (!(facing > 0)) continue;
      const double intensity = world.emitters.intensity(j, light, way / -std::sqrt(squared));
      if (intensity > 0)
        units.emplace_back(intensity * facing / (squared * std::sqrt(squared)), light.position);
    }
    const std::size_t count = std::min(shadow_rays, units.size());
    if (count == 0) continue;
    std::partial_sort(units.begin(), units.begin() + static_cast<std::ptrdiff_t>(count), units.end(),
                      [](const auto& a, const auto& b) { return a.first > b.first; });
    Packet packet{ray.from, {}};
    for (std::size_t k = 0; k < count; ++k) packet.targets.push_back(units[k].second);
    shadow_packets_.push_back(std::move(packet));
  }
  // Packets from a point that a label sees to the other labels of its cluster.
  for (std::uint32_t k = 0; k < packet_count && !clusters.empty(); ++k) {
    const auto& cluster = clusters[k % clusters.size()];
    const auto u = philox({k, 0, 0, 0}, 2);
    const std::uint32_t own = cluster[to_index(u[0], static_cast<std::uint32_t>(cluster.size()))];
    const SurfacePoint at = world.receivers.point(own, 0.5, 0.5);
    const Vec3 direction =
        world.receivers.frame(own).to_world(sample_cosine_hemisphere(to_uniform(u[1]), to_uniform(u[2])));
    const auto hit = world.rays.intersect(at, direction);
    if (!hit) continue;
    Packet packet{hit->point, {}};
    if (dot(packet.from.normal, direction) > 0) packet.from.normal = -packet.from.normal;
    for (const std::uint32_t i : cluster) {
      const SurfacePoint other = world.receivers.point(i, 0.5, 0.5);
      const Vec3 way = packet.from.position - other.position;
      if (i != own && dot(way, other.normal) > 0 && dot(way, packet.from.normal) < 0)
        packet.targets.push_back(other.position);
    }
    if (!packet.targets.empty()) visibility_packets_.push_back(std::move(packet));
  }
}

void BareRays::measure() {
  walks.seconds += cpu_seconds([&] {
    for (const Ray& ray : rays_) {
      hits += world_.rays.intersect(ray.from, ray.direction) ? 1 : 0;
      hits += world_.rays.transmittance(ray.from, ray.target).share > 0 ? 1 : 0;
    }
  });
  walks.rays += 2 * static_cast<double>(rays_.size());
  if (shadow_packets_.empty()) return;

  single.seconds += cpu_seconds([&] {
    for (const Ray& ray : rays_) sink_ += world_.rays.intersect(ray.from, ray.direction) ? 1 : 0;
  });
  single.rays += static_cast<double>(rays_.size());
  std::vector<float> result;
  const auto trace = [&](const std::vector<Packet>& packets, Rate& rate, const auto& query) {
    rate.seconds += cpu_seconds([&] {
      for (const Packet& packet : packets) {
        result.resize(packet.targets.size());
        query(packet);
        sink_ += static_cast<double>(result.front());
      }
    });
    for (const Packet& packet : packets) rate.rays += static_cast<double>(packet.targets.size());
  };
  trace(shadow_packets_, shadow,
        [&](const Packet& packet) { world_.rays.shares(packet.from, packet.targets, result); });
  std::vector<Transmittance> transmittances;
  trace(visibility_packets_, visibility, [&](const Packet& packet) {
    transmittances.resize(packet.targets.size());
    world_.rays.transmittances(packet.from, packet.targets, transmittances);
    result.front() = static_cast<float>(transmittances.front().share);
  });
}

}  // namespace shelfbeam::bench
