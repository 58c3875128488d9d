#include "shelfbeam/transport/cache/cell_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/cache/coated_chain.hpp"
#include "shelfbeam/transport/cache/lane_kernels.hpp"
#include "shelfbeam/transport/cells/cell_grid.hpp"

namespace shelfbeam::detail {

namespace {

// Irradiance by the unit's exact profile, where UnitGroups has only its mean over phi.
float true_irradiance(const World& world, std::uint32_t j, const SurfacePoint& at) {
  const LightPoint light = world.emitters.point(j, 0.5, 0.5);
  const Vec3 way = light.position - at.position;
  const double squared = length_squared(way), distance = std::sqrt(squared);
  return static_cast<float>(world.emitters.intensity(j, light, way / -distance) *
                            std::max(0.0, dot(at.normal, way)) / (squared * distance));
}

// Sums of one lane over the points with shadow rays.
struct Asked {
  float open = 0, arrived = 0, capped = 0;
  std::uint8_t sample_points = 0;

  void operator+=(const Asked& other) {
    open += other.open;
    arrived += other.arrived;
    capped += other.capped;
    sample_points = static_cast<std::uint8_t>(sample_points + other.sample_points);
  }
};

}  // namespace

CellLight straight_light(const World& world, const UnitGroups& units, const SurfaceCells& cells,
                         std::size_t cell, float threshold, std::span<const float> caps) {
  const std::size_t width = units.size() * lanes;
  std::array<std::vector<Asked>, SurfaceCells::quadrants> samples;
  for (auto& of_quadrant : samples) of_quadrant.resize(width);
  std::vector<std::uint8_t> seen(width), hidden(width);
  std::vector<std::size_t> which;
  std::vector<float> open, shares;
  std::vector<RayEnd> targets;
  const auto ask = [&](std::size_t quadrant, const SurfacePoint& at, bool is_first) {
    const LanePoint point(at);
    which.clear();
    open.clear();
    targets.clear();
    for (std::size_t g = 0; g < units.size(); ++g) {
      if (units.bound(g, point) < threshold) continue;
      LaneValues e;
      units.irradiance(g, point, e);
      for (std::size_t lane = 0; lane < units.count(g); ++lane) {
        const std::size_t k = g * lanes + lane;
        if (e[lane] < 0.1F * threshold || (!is_first && seen[k] != hidden[k])) continue;
        which.push_back(k);
        open.push_back(e[lane]);
        targets.push_back(world.scene.transceivers[units.column(g, lane)].position);
      }
    }
    shares.resize(targets.size());
    world.rays.shares(at, targets, shares);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const std::size_t g = which[t] / lanes;
      (shares[t] > 0 ? seen : hidden)[which[t]] = 1;
      const float value = shares[t] == 0 || !units.is_approximate(g)
                              ? open[t]
                              : true_irradiance(world, units.column(g, which[t] % lanes), at);
      samples[quadrant][which[t]] +=
          {open[t], value * shares[t], std::min(value, caps[which[t]]) * shares[t], 1};
    }
  };
  for (std::size_t k = 0; k < SurfaceCells::max_fine_points; ++k)
    for (std::size_t q = 0; q < SurfaceCells::quadrants; ++q)
      if (const auto sample_points = cells.sample_points(cell, q); sample_points.size() > k)
        ask(q, sample_points[k], k == 0);

  CellLight light;
  for (std::size_t g = 0; g < units.size(); ++g) {
    std::array<Asked, lanes> whole{};
    float largest = 0;
    for (std::size_t k = 0; k < lanes; ++k) {
      for (const auto& of_quadrant : samples) whole[k] += of_quadrant[g * lanes + k];
      largest = std::max(largest, whole[k].arrived);
    }
    if (largest == 0) continue;
    light.groups.push_back(static_cast<std::uint16_t>(g));
    for (std::size_t k = 0; k < lanes; ++k) {
      light.mean.push_back(PackedLane::pack(
          whole[k].sample_points > 0 ? whole[k].capped / static_cast<float>(whole[k].sample_points) : 0));
      for (std::size_t q = 0; q < SurfaceCells::quadrants; ++q) {
        // The whole cell's share counts like one more point.
        const Asked& own = samples[q][g * lanes + k];
        const float one =
            whole[k].sample_points > 0 ? whole[k].open / static_cast<float>(whole[k].sample_points) : 0;
        const float share = whole[k].open > 0 ? whole[k].arrived / whole[k].open : 0;
        light.share[q].push_back(
            PackedLane::pack_share(one > 0 ? (own.arrived + one * share) / (own.open + one) : 0));
      }
    }
  }
  return light;
}

std::vector<CellLink> gather_links(const World& world, const SurfaceCells& cells,
                                   std::span<const SurfacePoint> sample_points, bool by_quadrant,
                                   const std::vector<SurfaceGuide>& guides, const RayTargets& targets,
                                   const GatherRays& of) {
  const ScrambledSobol square(of.stream);
  std::vector<CellLink> links;
  std::uint64_t rays = 0;
  const auto look = [&](const SurfacePoint& at, const Vec3& direction, RandomStream& random, double weight) {
    follow_coated_chain(world, guides, at, direction, random, rays, [&](const ChainEnd& end, double share) {
      const std::uint32_t there = cells.find_near(end.point);
      if (there == SurfaceCells::nowhere) return;
      const float link = static_cast<float>(share * weight) * guides[end.material.value].flat();
      if (!by_quadrant) {
        links.push_back({there, link});
        return;
      }
      const std::uint32_t quadrant = CellGrid::quadrant(end.point);
      if (!cells.sample_points(there, quadrant).empty()) {
        links.push_back({SurfaceCells::node(there, quadrant), link});
        return;
      }
      // Quadrants without points are as bright as the others of their cell.
      std::array<std::uint32_t, SurfaceCells::quadrants> known{};
      std::size_t count = 0;
      for (std::uint32_t q = 0; q < SurfaceCells::quadrants; ++q)
        if (!cells.sample_points(there, q).empty()) known[count++] = SurfaceCells::node(there, q);
      for (std::size_t q = 0; q < count; ++q) links.push_back({known[q], link / static_cast<float>(count)});
    });
  };
  const auto points = static_cast<std::uint32_t>(sample_points.size());
  for (std::uint32_t k = 0; k < std::min(points, of.count); ++k) {
    const SurfacePoint& at = sample_points[k];
    const std::uint32_t first = of.first + (k + points - of.first % points) % points,
                        each = of.count / points;
    const auto view = targets.seen_from(at.position, at.normal, each);
    for (std::uint32_t r = first; r < of.first + of.count; r += points) {
      const auto [u1, u2] = square.point(r);
      RandomStream random(of.stream, r, 1, 0xCAC4E);
      const Vec3 direction = Frame::about(at.normal).to_world(sample_cosine_hemisphere(u1, u2));
      const double part = view.weight(each * dot(at.normal, direction) / pi, at.position, direction);
      look(at, direction, random, pi * part / of.count);
    }
    RandomStream random(of.stream, first, 2, 0xCAC4E);
    view.each_ray(mix_key(of.stream, first), [&](std::size_t target, double u1, double u2) {
      const Vec3 direction = view.direction(target, at.position, u1, u2);
      const double cosine = dot(at.normal, direction);
      if (!(cosine > 0)) return;
      const double density = each * cosine / pi + view.density(at.position, direction);
      look(at, direction, random, cosine / (density * points));
    });
  }
  return merged(std::move(links));
}

std::vector<CellLink> merged(std::vector<CellLink> links) {
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
