#include "shelfbeam/transport/bright_spots.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/sobol.hpp"
#include "shelfbeam/transport/random_stream.hpp"

namespace shelfbeam {

namespace {

// W/m^2 for each W/sr of the unit's peak: what it gives at 2 m.
constexpr float cap_by_peak = 0.25F;
constexpr std::uint32_t pilot_rays = 128;
constexpr double least_chance = 0.02;

// Where light that leaves a unit arrives in a straight line.
struct Arrival {
  SurfacePoint point;  // its normal on the side of the unit
  Vec3 outside, incoming;
  MaterialId material;
  double flux, excess;  // of the unit, and the share of the irradiance here that lies above the cap
};

std::optional<Arrival> shine(const World& world, const UnitGroups& units, std::uint32_t j, float cap,
                             double u1, double u2, RandomStream& random, std::uint64_t& rays) {
  const double u3 = random.unit(), u4 = random.unit();
  const auto emitted = world.emitters.emit(j, {u1, u2, u3, u4});
  if (!emitted) return std::nullopt;
  SurfacePoint from{emitted->from.position, emitted->from.normal};
  double flux = emitted->flux;
  for (;;) {
    const auto hit = world.rays.intersect(from, emitted->direction);
    ++rays;
    if (!hit) return std::nullopt;
    const Material& material = world.material(*hit);
    if (const auto* pane = std::get_if<ThinDielectric>(&material)) {
      flux *= pane_transmittance(*pane, dot(hit->point.normal, emitted->direction));
      from = hit->point;
      if (!(flux > 0)) return std::nullopt;
      continue;
    }
    if (has_only_specular(material)) return std::nullopt;
    Arrival arrival{hit->point, hit->point.normal, -emitted->direction, hit->material, flux, 0};
    if (dot(arrival.point.normal, emitted->direction) > 0) arrival.point.normal = -arrival.point.normal;
    const std::uint32_t place = units.place(j);
    LaneValues e;
    units.irradiance(place / lanes, LanePoint(arrival.point), e);
    const float own = e[place % lanes];
    if (!(own > cap)) return std::nullopt;
    arrival.excess = 1 - static_cast<double>(cap / own);
    return arrival;
  }
}

}  // namespace

BrightSpots::BrightSpots(const World& world, UnitGroups& units, std::uint64_t seed)
    : world_(world), units_(units) {
  for (std::uint32_t j = 0; j < world.scene.transceivers.size(); ++j) {
    const float cap = cap_by_peak * units.peak(units.place(j) / lanes);
    const std::uint64_t key = mix_key(seed, hash64(world.scene.transceivers[j].id));
    const ScrambledSobol square(key);
    double flux = 0;
    std::uint64_t rays = 0;
    for (std::uint32_t r = 0; r < pilot_rays; ++r) {
      const auto [u1, u2] = square.point(r);
      RandomStream random(key, r, 0, 0);
      if (const auto arrival = shine(world, units, j, cap, u1, u2, random, rays))
        flux += arrival->flux * arrival->excess / pilot_rays;
    }
    if (flux == 0) continue;
    spots_.push_back({j, flux});
    units.set_cap(j, cap);
  }
}

void BrightSpots::add(std::span<const std::uint32_t> labels, std::span<const SurfacePoint> at,
                      double relevant, std::uint32_t rays_per_unit, std::uint64_t key, std::uint32_t batch,
                      std::span<LaneRow> rows, std::uint64_t& rays) const {
  if (spots_.empty()) return;
  Vec3 centre;
  for (const SurfacePoint& point : at) centre = centre + point.position / static_cast<double>(at.size());
  double radius = 0;
  for (const SurfacePoint& point : at) radius = std::max(radius, length(point.position - centre));

  std::vector<std::uint32_t> sharers;
  std::vector<double> values;
  std::vector<Vec3> targets;
  std::vector<float> seen;
  for (const Spot& spot : spots_) {
    RandomStream random(mix_key(key, spot.unit), batch, 0, 0x5B07);
    const double away =
        std::max(1.0, length(world_.scene.transceivers[spot.unit].position - centre) - radius);
    const double chance = std::clamp(spot.flux / (pi * away * away) / relevant, least_chance, 1.0);
    if (random.unit() >= chance) continue;
    const std::uint32_t place = units_.place(spot.unit);
    const float cap = units_.cap(place / lanes, place % lanes);
    const ScrambledSobol square(mix_key(mix_key(key, spot.unit), batch));
    for (std::uint32_t r = 0; r < rays_per_unit; ++r) {
      const auto [u1, u2] = square.point(r);
      const auto arrival = shine(world_, units_, spot.unit, cap, u1, u2, random, rays);
      if (!arrival) continue;
      const Material& material = world_.scene.materials[arrival->material.value].material;
      const Frame frame = Frame::of_surface(arrival->outside);
      const Vec3 incoming = frame.to_local(arrival->incoming);
      sharers.clear();
      targets.clear();
      values.clear();
      for (std::uint32_t c = 0; c < labels.size(); ++c) {
        const Vec3 way = at[c].position - arrival->point.position;
        const double squared = length_squared(way);
        if (!(squared > 0)) continue;
        const Vec3 direction = way / std::sqrt(squared);
        const double cosine = dot(direction, arrival->point.normal);
        if (cosine <= 0) continue;  // from behind labels take all of it themselves
        const double response = world_.receivers.response(labels[c], -direction);
        if (!(response > 0)) continue;
        const double scattered = eval(material, frame.to_local(direction), incoming);
        if (!(scattered > 0)) continue;
        sharers.push_back(c);
        targets.push_back(at[c].position);
        values.push_back(arrival->flux * arrival->excess / (rays_per_unit * chance) * scattered * response *
                         cosine / squared);
      }
      seen.resize(targets.size());
      world_.rays.in_sight(arrival->point, targets, seen);
      rays += targets.size();
      for (std::size_t t = 0; t < sharers.size(); ++t)
        if (seen[t] > 0) rows[sharers[t]].add(place, values[t]);
    }
  }
}

}  // namespace shelfbeam
