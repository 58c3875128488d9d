#include "shelfbeam/transport/reuse/bright_spots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

namespace {

constexpr std::uint32_t side = 16;  // strata of a unit's rays, in each of two dimensions
// The share of a unit's rays that is spread over all strata, whether or not the first look found light there.
constexpr double everywhere = 0.1;
constexpr double min_chance = 0.02;
// A spot is steep where the cap is less than `steep` times the irradiance, for this share of the unit's rays.
constexpr double steep_share = 0.02, steep = 1.0 / 16;

// The distance that defines each unit's cap, by the number of units around it (SpotRule).
std::vector<double> cap_distances(const std::vector<Transceiver>& units, const SpotRule& rule) {
  constexpr double around = 5, few = 16;
  std::vector<double> distances(units.size());
  parallel_for_ranges(units.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) {
      const auto near = std::count_if(units.begin(), units.end(), [&](const Transceiver& unit) {
        return length_squared(unit.position - units[j].position) <= around * around;
      });
      distances[j] =
          std::max(rule.min_cap_distance,
                   rule.max_cap_distance * std::sqrt(std::min(1.0, few / static_cast<double>(near))));
    }
  });
  return distances;
}

// Samples a ray from a unit to the first surface in a straight line; no value if the irradiance there is
// within the cap. SpotLight::power is the power of the ray.
std::optional<SpotLight> light_of_ray(const World& world, const UnitGroups& units, std::uint32_t j, double u1,
                                      double u2, RandomStream& random, std::uint64_t& rays) {
  const double u3 = random.uniform(), u4 = random.uniform();
  const auto emitted = world.emitters.emit(j, {u1, u2, u3, u4});
  if (!emitted) return std::nullopt;
  SurfacePoint from{emitted->from.position, emitted->from.normal};
  double flux = emitted->flux;
  for (;;) {
    const auto hit = world.rays.intersect(from, emitted->direction);
    ++rays;
    if (!hit) return std::nullopt;
    const Material& material = world.material(*hit);
    if (is_pane(material)) {
      flux *= pane_transmittance(material, dot(hit->point.normal, emitted->direction));
      from = hit->point;
      if (!(flux > 0)) return std::nullopt;
      continue;
    }
    if (has_only_specular(material)) return std::nullopt;
    SpotLight light;
    light.lane_index = units.lane_index(j);
    light.point = hit->point;
    light.frame = Frame::of_surface(hit->point.normal);
    light.incoming = light.frame.to_local(-emitted->direction);
    light.material = hit->material;
    if (dot(light.point.normal, emitted->direction) > 0) light.point.normal = -light.point.normal;
    const std::size_t g = light.lane_index / lanes, lane = light.lane_index % lanes;
    LaneValues e;
    units.irradiance(g, LanePoint(light.point), e);
    if (!(e[lane] > units.cap(g, lane))) return std::nullopt;
    light.power = flux;
    light.capped = static_cast<double>(units.cap(g, lane) / e[lane]);
    return light;
  }
}

std::size_t stratum(std::size_t x, std::size_t y) {
  return x * side + y;
}

// Cumulative probabilities of the strata, from the flux found in them and in their neighbours.
std::vector<double> running_chances(const std::vector<double>& flux) {
  std::vector<double> chances(flux.size());
  double total = 0;
  for (std::size_t x = 0; x < side; ++x)
    for (std::size_t y = 0; y < side; ++y) {
      double near = 0;
      for (std::size_t nx = x == 0 ? 0 : x - 1; nx <= std::min<std::size_t>(x + 1, side - 1); ++nx)
        for (std::size_t ny = y == 0 ? 0 : y - 1; ny <= std::min<std::size_t>(y + 1, side - 1); ++ny)
          near = std::max(near, flux[stratum(nx, ny)]);
      chances[stratum(x, y)] = flux[stratum(x, y)] + 0.5 * near;
      total += chances[stratum(x, y)];
    }
  double sum = 0;
  for (double& chance : chances) {
    sum += (1 - everywhere) * chance / total + everywhere / (side * side);
    chance = sum;
  }
  return chances;
}

}  // namespace

BrightSpots::BrightSpots(const World& world, UnitGroups& units, std::uint64_t seed, const SpotRule& rule)
    : world_(world), units_(units), rule_(rule) {
  const std::vector<double> distances = cap_distances(world.scene.transceivers, rule);
  std::vector<double> found(std::size_t{side} * side);
  for (std::uint32_t j = 0; j < world.scene.transceivers.size(); ++j) {
    const std::uint64_t key = mix_key(seed, hash64(world.scene.transceivers[j].id));
    const ScrambledSobol square(key);
    units.set_cap(j,
                  units.peak(units.lane_index(j) / lanes) / static_cast<float>(distances[j] * distances[j]));
    double flux = 0, steep_rays = 0;
    std::uint64_t rays = 0;
    std::fill(found.begin(), found.end(), 0.0);
    for (std::uint32_t r = 0; r < side * side; ++r) {
      const auto [u1, u2] = square.point(r);
      RandomStream random(key, r, 0, 0);
      const auto light = light_of_ray(world, units, j, u1, u2, random, rays);
      if (!light) continue;
      const double part = light->power * (1 - light->capped) / (side * side);
      found[stratum(static_cast<std::size_t>(u1 * side), static_cast<std::size_t>(u2 * side))] += part;
      flux += part;
      if (light->capped < steep) ++steep_rays;
    }
    const bool is_steep = steep_rays > steep_share * side * side;
    any_steep_ = any_steep_ || is_steep;
    if (flux > 0)
      spots_.push_back({j, is_steep, flux, running_chances(found)});
    else
      units.set_cap(j, std::numeric_limits<float>::max());
  }
  for (const Spot& spot : spots_)
    groups_.push_back(static_cast<std::uint16_t>(units.lane_index(spot.unit) / lanes));
  std::sort(groups_.begin(), groups_.end());
  groups_.erase(std::unique(groups_.begin(), groups_.end()), groups_.end());
}

void BrightSpots::draw(std::span<const RayEnd> points, const Effort& effort, const Key& key,
                       std::vector<SpotLight>& lights, std::uint64_t& rays) const {
  lights.clear();
  for (const Spot& spot : spots_) {
    const Vec3& from = world_.scene.transceivers[spot.unit].position;
    double sum = 0;
    for (const RayEnd& point : points) sum += 1 / std::max(1.0, length_squared(point.position - from));
    const double much = spot.flux / pi * sum / static_cast<double>(points.size()) / effort.relevant;
    const double chance = std::clamp(much, min_chance, 1.0);
    RandomStream random(mix_key(key.stream, spot.unit), key.batch, 0, 0x5B07);
    if (random.uniform() >= chance) continue;
    const auto count =
        static_cast<std::uint32_t>(std::clamp(much * much, 1.0, static_cast<double>(effort.most)));
    shine(spot, key.stream, key.batch, count, chance, lights, rays);
  }
}

// Adds the lights of `count` rays from a unit; `chance` is the probability of this call.
void BrightSpots::shine(const Spot& spot, std::uint64_t stream, std::uint32_t batch, std::uint32_t count,
                        double chance, std::vector<SpotLight>& lights, std::uint64_t& rays) const {
  RandomStream random(mix_key(stream, spot.unit), batch, 1, 0x5B07);
  const ScrambledSobol square(mix_key(mix_key(stream, spot.unit), batch));
  for (std::uint32_t r = 0; r < count; ++r) {
    const auto [u1, u2] = square.point(r);
    const auto found = std::upper_bound(spot.chances.begin(), spot.chances.end() - 1, u1);
    const auto s = static_cast<std::uint32_t>(found - spot.chances.begin());
    const double below = s == 0 ? 0 : spot.chances[s - 1], own = spot.chances[s] - below;
    const double v1 = std::clamp((u1 - below) / own, 0.0, 1.0);
    const std::uint32_t row = s / side, column = s % side;
    auto light =
        light_of_ray(world_, units_, spot.unit, (row + v1) / side, (column + u2) / side, random, rays);
    if (!light) continue;
    light->power /= count * chance * own * side * side;
    lights.push_back(*light);
  }
}

RayTargets BrightSpots::targets() const {
  RayTargets targets(world_.scene);
  for (const Spot& spot : spots_)
    if (spot.is_steep) targets.add_unit(world_.scene.transceivers[spot.unit].position);
  return targets;
}

std::vector<SpotLight> BrightSpots::steep_lights(std::uint64_t seed) const {
  constexpr std::uint32_t count = 16;  // of a unit
  std::vector<SpotLight> lights;
  std::uint64_t rays = 0;
  for (const Spot& spot : spots_)
    if (spot.is_steep) shine(spot, seed, 0, count, 1, lights, rays);
  return lights;
}

void BrightSpots::add_near(const PathVertex& vertex, double p, double weight, RandomStream& random,
                           LaneRow& row, std::uint64_t& rays) const {
  const double rise = rule_.near_distance * rule_.near_distance * pi * p;
  if (!(rise > 1)) return;
  const LanePoint point(vertex.end.point);
  const auto farthest = static_cast<float>(std::max(rule_.min_cap_distance, rule_.max_cap_distance));
  for (const std::uint16_t g : groups_) {
    if (units_.distance(g, point) > farthest) continue;
    LaneValues e;
    units_.irradiance(g, point, e);
    for (std::size_t k = 0; k < units_.count(g); ++k) {
      if (!(e[k] > units_.cap(g, k))) continue;
      const double whole = static_cast<double>(e[k]), cap = static_cast<double>(units_.cap(g, k));
      const double share = (std::min(whole, cap * rise) - cap) / whole;
      const std::uint32_t j = units_.column(g, k);
      const double u1 = random.uniform(), u2 = random.uniform();
      const LightPoint light = world_.emitters.point(j, u1, u2);
      const DirectSignal signal = light_from(
          world_, j, light, vertex.end.point, false,
          [&](const Vec3& to_source) { return vertex.reflected(to_source).whole; },
          [&] { return world_.rays.transmittance(vertex.end.point, light.position).share; });
      rays += signal.rays;
      if (signal.straight > 0)
        row.add(static_cast<std::uint32_t>(g * lanes + k), weight * share * signal.straight);
    }
  }
}

}  // namespace shelfbeam
