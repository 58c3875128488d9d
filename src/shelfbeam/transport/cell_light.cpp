#include "shelfbeam/transport/detail/cell_light.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/math/sobol.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/specular_chain.hpp"

namespace shelfbeam::detail {

namespace {

constexpr std::uint32_t gather_rays = 64;

// Irradiance by the unit's true profile where the guide only has a mean.
float true_irradiance(const World& world, std::uint32_t j, const SurfacePoint& at) {
  const LightPoint light = world.emitters.point(j, 0.5, 0.5);
  const Vec3 way = light.position - at.position;
  const double squared = length_squared(way), distance = std::sqrt(squared);
  return static_cast<float>(world.emitters.intensity(j, light, way / -distance) *
                            std::max(0.0, dot(at.normal, way)) / (squared * distance));
}

// Of one lane, over the places asked.
struct Asked {
  float open = 0, arrived = 0;
  std::uint8_t places = 0;
  bool seen = false, hidden = false;
};

}  // namespace

CellLight straight_light(const World& world, const UnitGroups& units, const SurfaceCells& cells,
                         std::size_t cell, float least, std::uint64_t& rays) {
  std::vector<Asked> asked(units.size() * lanes);
  std::vector<std::size_t> which;
  std::vector<float> open, shares;
  std::vector<Vec3> targets;
  const auto places = cells.places(cell);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const LanePoint point(places[k]);
    which.clear();
    open.clear();
    targets.clear();
    for (std::size_t g = 0; g < units.size(); ++g) {
      if (units.bound(g, point) < least) continue;
      LaneValues e;
      units.irradiance(g, point, e);
      for (std::size_t lane = 0; lane < units.count(g); ++lane) {
        const Asked& so_far = asked[g * lanes + lane];
        if (e[lane] < 0.1F * least || (k >= 2 && !(so_far.seen && so_far.hidden))) continue;
        which.push_back(g * lanes + lane);
        open.push_back(e[lane]);
        targets.push_back(world.scene.transceivers[units.column(g, lane)].position);
      }
    }
    shares.resize(targets.size());
    world.rays.shares(places[k], targets, shares);
    rays += targets.size();
    for (std::size_t t = 0; t < targets.size(); ++t) {
      Asked& lane = asked[which[t]];
      ++lane.places;
      lane.open += open[t];
      (shares[t] > 0 ? lane.seen : lane.hidden) = true;
      if (shares[t] == 0) continue;
      const std::size_t g = which[t] / lanes;
      const float value =
          units.is_loose(g) ? true_irradiance(world, units.column(g, which[t] % lanes), places[k]) : open[t];
      lane.arrived += value * shares[t];
    }
  }
  CellLight light;
  for (std::size_t g = 0; g < units.size(); ++g) {
    const auto* const group = asked.data() + g * lanes;
    if (std::all_of(group, group + lanes, [](const Asked& lane) { return lane.arrived == 0; })) continue;
    light.groups.push_back(static_cast<std::uint16_t>(g));
    for (std::size_t k = 0; k < lanes; ++k) {
      light.share.push_back(group[k].open > 0 ? group[k].arrived / group[k].open : 0);
      light.mean.push_back(group[k].places > 0 ? group[k].arrived / static_cast<float>(group[k].places) : 0);
    }
  }
  return light;
}

std::vector<CellLink> gather_links(const World& world, const SurfaceCells& cells, std::size_t cell,
                                   const std::vector<float>& factors, std::uint64_t seed,
                                   std::uint64_t& rays) {
  const auto places = cells.places(cell);
  const std::uint64_t stream = mix_key(seed, cells.key(cell));
  const ScrambledSobol square(stream);
  std::vector<CellLink> links;
  for (std::uint32_t r = 0; r < gather_rays; ++r) {
    const SurfacePoint& at = places[r % places.size()];
    const auto [u1, u2] = square.point(r);
    RandomStream random(stream, r, 1, 0xCAC4E);
    const auto end =
        follow_chain(world, at, Frame::about(at.normal).to_world(sample_cosine_hemisphere(u1, u2)), false,
                     random, rays, [](std::size_t, double) {});
    if (!end) continue;
    const std::uint32_t there = cells.find(end->point);
    if (there == SurfaceCells::nowhere) continue;
    links.push_back({there, static_cast<float>(end->throughput * pi) * factors[end->material.value] /
                                static_cast<float>(gather_rays)});
  }
  std::stable_sort(links.begin(), links.end(),
                   [](const CellLink& a, const CellLink& b) { return a.cell < b.cell; });
  std::size_t kept = 0;
  for (const CellLink& link : links) {
    if (kept > 0 && links[kept - 1].cell == link.cell)
      links[kept - 1].weight += link.weight;
    else
      links[kept++] = link;
  }
  links.resize(kept);
  links.shrink_to_fit();
  return links;
}

}  // namespace shelfbeam::detail
