#include "shelfbeam/transport/operator/unit_spots.hpp"

#include <algorithm>
#include <map>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/cells/cell_grid.hpp"

namespace shelfbeam {

namespace {

using detail::CellGrid;
using detail::SurfaceCells;

constexpr std::uint32_t rays_of_unit = 256;
// Light is omitted that gives less than this share of the requirement, to a label or a surface.
constexpr double least_at_label = 1e-4, least_at_surface = 1e-3;
// A spot counts as at least this far away, m^2: it is as large as a quadrant.
constexpr double near_squared = 0.04;
// Farther away, m^2, the quadrants of a cell receive the same light.
constexpr float far_squared = 4;

// The lights of one quadrant as one light, at the place nearest to their centre.
SpotLight joined(const std::vector<SpotLight>& lights) {
  double power = 0;
  Vec3 sum;
  for (const SpotLight& light : lights) {
    power += light.power;
    sum = sum + light.point.position * light.power;
  }
  const Vec3 centre = sum / power;
  const auto away = [&](const SpotLight& light) { return length_squared(light.point.position - centre); };
  SpotLight whole = *std::min_element(lights.begin(), lights.end(),
                                      [&](const auto& a, const auto& b) { return away(a) < away(b); });
  whole.power = power;
  return whole;
}

// Beyond this distance, squared, nothing receives `least` from a light on a diffuse surface.
double range_squared(const SpotLight& light, double least) {
  return light.power / (pi * least);
}

}  // namespace

UnitSpots::UnitSpots(const World& probe, const SurfaceNodes& nodes, std::uint64_t seed) : probe_(probe) {
  UnitGroups units(probe);
  const BrightSpots spots(probe, units, seed);
  if (spots.size() == 0) return;
  cap_ = units.cap(0, 0);
  const std::vector<RayEnd> anywhere{RayEnd(probe.scene.transceivers[0].position)};
  std::vector<SpotLight> all;
  std::uint64_t rays = 0;
  constexpr double any = 1e-9;  // W/m^2; so all rays are drawn
  spots.draw(anywhere, {any, rays_of_unit}, {seed, 0}, all, rays);
  // By quadrant; a light where no walk has been remains alone.
  std::map<std::uint64_t, std::vector<SpotLight>> by_place;
  for (SpotLight& light : all) {
    light.power *= 1 - light.capped;
    const std::uint32_t cell = nodes.cells().find_near(light.point);
    const auto quadrant = CellGrid::quadrant(light.point);
    const std::uint64_t alone = nodes.size() + by_place.size();
    by_place[cell == SurfaceCells::nowhere ? alone : SurfaceCells::node(cell, quadrant)].push_back(light);
  }
  for (const auto& [place, lights] : by_place) lights_.push_back(joined(lights));
}

std::vector<float> UnitSpots::light(const SurfaceNodes& nodes, float requirement) const {
  if (lights_.empty()) return {};
  std::vector<std::vector<Lit>> parts(lights_.size());
  for_each_task(lights_.size(), [&](std::size_t l) {
    parts[l] = lit_by(lights_[l], nodes, least_at_surface * static_cast<double>(requirement));
  });
  std::vector<float> sum(nodes.size());
  for (const std::vector<Lit>& part : parts)
    for (const Lit& lit : part)
      for (std::uint32_t k = 0; k < lit.count; ++k) sum[lit.first + k] += lit.irradiance;
  return sum;
}

// The quadrants that receive `least` or more from a light, and are not hidden from it.
std::vector<UnitSpots::Lit> UnitSpots::lit_by(const SpotLight& light, const SurfaceNodes& nodes,
                                              double least) const {
  const BeamPoints& points = nodes.points();
  const auto range = static_cast<float>(range_squared(light, least));
  const LaneVector at{static_cast<float>(light.point.position.x), static_cast<float>(light.point.position.y),
                      static_cast<float>(light.point.position.z)};
  std::vector<Lit> lit;
  std::vector<RayEnd> targets;
  const auto ask = [&](std::uint32_t first, std::uint32_t count, std::uint32_t p) {
    const SurfacePoint point = points.at(p);
    const auto seen = sight(point.position, light.point);
    if (!seen) return;
    const double value = light.intensity(probe_.scene, -seen->direction) *
                         std::max(0.0, dot(point.normal, seen->direction)) /
                         std::max(near_squared, seen->distance_squared);
    if (value < least) return;
    lit.push_back({first, count, static_cast<float>(value)});
    targets.push_back(point);
  };
  for (std::uint32_t node = 0; node < nodes.size(); node += SurfaceCells::quadrants) {
    const std::uint32_t p = nodes.first_point(node);
    const LaneVector way{points.x[p] - at.x, points.y[p] - at.y, points.z[p] - at.z};
    const float squared = dot(way, way);
    if (squared > range) continue;
    if (squared > far_squared) {
      ask(node, SurfaceCells::quadrants, p);
      continue;
    }
    for (std::uint32_t q = 0; q < SurfaceCells::quadrants; ++q)
      if (nodes.has_points(node + q)) ask(node + q, 1, nodes.first_point(node + q));
  }
  std::vector<float> shares(targets.size());
  probe_.rays.shares(light.point, targets, shares);
  for (std::size_t t = 0; t < lit.size(); ++t) lit[t].irradiance *= shares[t];
  return lit;
}

void UnitSpots::add_light(const LabelHits& hits, float requirement, float* sums) const {
  const double least = least_at_label * static_cast<double>(requirement);
  std::vector<std::uint32_t> which;
  std::vector<RayEnd> targets;
  std::vector<float> values, shares;
  for (const SpotLight& light : lights_) {
    const double range = range_squared(light, least);
    if (hits.box.distance_squared(light.point.position) > range) continue;
    which.clear();
    targets.clear();
    values.clear();
    for (std::uint32_t c = 0; c < hits.labels.size(); ++c) {
      const SurfacePoint at = probe_.receivers.point(hits.labels[c], 0.5, 0.5);
      const auto seen = sight(at.position, light.point);
      if (!seen || seen->distance_squared > range) continue;
      const double response = probe_.receivers.response(hits.labels[c], seen->direction);
      if (!(response > 0)) continue;
      const double value = light.intensity(probe_.scene, -seen->direction) * response /
                           std::max(near_squared, seen->distance_squared);
      if (value < least * largest(probe_.receivers.responsivity(hits.labels[c]))) continue;
      which.push_back(c);
      targets.push_back(at);
      values.push_back(static_cast<float>(value));
    }
    shares.resize(targets.size());
    probe_.rays.shares(light.point, targets, shares);
    for (std::size_t t = 0; t < which.size(); ++t) sums[which[t]] += values[t] * shares[t];
  }
}

}  // namespace shelfbeam
