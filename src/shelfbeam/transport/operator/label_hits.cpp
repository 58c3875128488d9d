#include "shelfbeam/transport/operator/label_hits.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/cache/coated_chain.hpp"
#include "shelfbeam/transport/cells/cell_grid.hpp"
#include "shelfbeam/transport/reuse/label_sharers.hpp"
#include "shelfbeam/transport/reuse/residual.hpp"
#include "shelfbeam/transport/world/next_event.hpp"

namespace shelfbeam {

namespace {

using detail::CellGrid;
using detail::SurfaceCells;

// A point with its weights, by label.
struct SharedPoint {
  SurfacePoint point;
  std::uint16_t material;
  std::uint32_t cell, quadrant;
  std::vector<std::pair<std::uint32_t, float>> weights;
};

// Labels that also send rays to targets.
struct HitSharers : LabelSharers {
  const std::vector<RayTargets::View>& views;

  double rays(std::uint32_t c) const {
    if (views[c].is_empty()) return 1;
    const Vec3 direction = normalized(point.position - at[c].position);
    const double own = rays_each * pdf(world.receivers.responsivity(labels[c]),
                                       world.receivers.frame(labels[c]).to_local(direction));
    return own > 0 ? 1 + views[c].density(at[c].position, direction) / own : 1;
  }
};

std::array<float, 3> packed(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// The labels of a cluster by the side that they face and their place along it, so that neighbours, which see
// the same points, share groups of LabelRows.
std::vector<LabelId> side_by_side(const World& world, const std::vector<LabelId>& labels) {
  const auto order = ordered_by(labels.size(), [&](std::uint32_t c) {
    const Vec3& normal = world.receivers.frame(labels[c]).z;
    const Vec3 at = world.receivers.point(labels[c], 0.5, 0.5).position;
    const auto side = std::lround(std::atan2(normal.y, normal.x) * 4 / pi);
    return std::tuple(side, at.y * normal.x - at.x * normal.y, at.z);
  });
  std::vector<LabelId> sorted;
  sorted.reserve(order.size());
  for (const std::uint32_t c : order) sorted.push_back(labels[c]);
  return sorted;
}

// Moves the points into the hits, in order of their cells.
void store(std::vector<SharedPoint> points, LabelHits& hits) {
  std::stable_sort(points.begin(), points.end(), [](const SharedPoint& a, const SharedPoint& b) {
    return std::tie(a.cell, a.quadrant) < std::tie(b.cell, b.quadrant);
  });
  hits.points.reserve(points.size());
  std::vector<float> row(hits.labels.size()), sums(hits.labels.size());
  std::array<float, SurfaceCells::quadrants> mix{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const SharedPoint& found = points[k];
    if (k == 0 || found.cell != points[k - 1].cell)
      hits.blocks.push_back({found.cell, static_cast<std::uint32_t>(k), {}});
    hits.points.add(found.point);
    hits.material.push_back(found.material);
    for (const auto& [c, weight] : found.weights) {
      row[c] += weight;
      sums[c] += weight;
      mix[found.quadrant] += weight;
    }
    hits.weights.add(row);
    for (const auto& [c, weight] : found.weights) row[c] = 0;
    if (k + 1 < points.size() && points[k + 1].cell == found.cell) continue;
    hits.sums.add(sums);
    const float whole = mix[0] + mix[1] + mix[2] + mix[3];
    for (std::size_t q = 0; q < mix.size(); ++q)
      hits.blocks.back().mix[q] = whole > 0 ? mix[q] / whole : 0.25F;
    std::fill(sums.begin(), sums.end(), 0.0F);
    mix = {};
  }
  hits.blocks.push_back({0, static_cast<std::uint32_t>(points.size()), {}});
  hits.weights.shrink_to_fit();
  hits.sums.shrink_to_fit();
}

}  // namespace

LabelHits find_label_hits(const World& world, const SurfaceNodes& nodes,
                          const std::vector<std::uint8_t>& narrow, const std::vector<LabelId>& labels,
                          const RayTargets& targets, std::uint32_t rays_each, std::uint64_t seed,
                          const RunControl& control) {
  LabelHits hits;
  hits.labels = side_by_side(world, labels);
  const std::size_t count = hits.labels.size();
  std::vector<SurfacePoint> at;
  std::vector<RayTargets::View> views;
  for (const LabelId i : hits.labels) {
    at.push_back(world.receivers.point(i, 0.5, 0.5));
    views.push_back(targets.seen_from(at.back().position, world.receivers.frame(i).z, rays_each));
  }
  hits.enclose(world);
  std::vector<SharedPoint> points;
  std::vector<double> all(count), unknown(count), bent(count), narrow_share(count);
  Sharing sharing;
  std::uint64_t rays = 0;
  for (std::uint32_t c = 0; c < count && !control.cancelled(); ++c) {
    const std::uint32_t i = hits.labels[c];
    const std::uint64_t key = mix_key(seed, hash64(world.scene.labels[i].id));
    const Responsivity& responsivity = world.receivers.responsivity(i);
    const ScrambledSobol square(key);
    RandomStream random(key, 0, 0, 0x0BE7A);
    const double each = integral(responsivity) / rays_each;
    // `part`: the weight of the ray among all techniques that find its direction.
    const auto trace = [&](const Vec3& direction, double part) {
      bool is_first = true;
      const auto use = [&](const ChainEnd& end, double share) {
        const SurfaceGuide& guide = nodes.guides()[end.material.value];
        const bool is_end_of_ray = std::exchange(is_first, false);
        share *= part;
        if (is_end_of_ray) {
          all[c] += share;
          if (!end.is_straight || !guide.has_base()) bent[c] += share;
        }
        const std::uint32_t cell = nodes.cells().find_near(end.point);
        if (cell == SurfaceCells::nowhere) {
          if (is_end_of_ray) unknown[c] += share;
          return;
        }
        if (is_end_of_ray && narrow[cell] != 0) narrow_share[c] += share;
        const auto quadrant = CellGrid::quadrant(end.point);
        const double exit = guide.is_detailed() ? guide.exit(dot(end.point.normal, end.outgoing)) : 1;
        if (guide.has_base() && guide.base_albedo() > 0) {
          SharedPoint& found = points.emplace_back(
              SharedPoint{end.point, static_cast<std::uint16_t>(end.material.value), cell, quadrant, {}});
          const auto take = [&](std::uint32_t label, double weight) {
            if (weight > 0)
              found.weights.emplace_back(label, static_cast<float>(weight * guide.base_albedo() / pi));
          };
          if (end.is_straight)
            share_point(world, end.point,
                        HitSharers{{world, hits.labels, at, end.point, guide, rays_each}, views}, c,
                        {end.throughput * end.probability, end.probability}, sharing, rays, take);
          else
            take(c, each * share * exit);
        }
        if (!guide.has_base() || guide.has_highlight())
          hits.lobes.push_back(
              {packed(end.point.position), packed(end.point.normal), packed(end.outside),
               packed(end.outgoing), end.point.triangle, SurfaceCells::node(cell, quadrant),
               static_cast<std::uint16_t>(end.material.value), static_cast<std::uint16_t>(c),
               static_cast<float>(each * share),
               guide.has_base() ? static_cast<float>(1 - exit) : guide.flat() * static_cast<float>(pi)});
      };
      follow_coated_chain(world, nodes.guides(), at[c], direction, random, rays, use);
    };
    const Frame& frame = world.receivers.frame(i);
    for (std::uint32_t s = 0; s < rays_each; ++s) {
      const auto [u1, u2] = square.point(s);
      const auto drawn = sample(responsivity, u1, u2);
      if (!drawn) continue;
      const Vec3 direction = frame.to_world(drawn->direction);
      trace(direction,
            views[c].weight(rays_each * pdf(responsivity, drawn->direction), at[c].position, direction));
    }
    views[c].each_ray(key, [&](std::size_t target, double u1, double u2) {
      const Vec3 direction = views[c].direction(target, at[c].position, u1, u2);
      const double own = rays_each * pdf(responsivity, frame.to_local(direction));
      if (own > 0) trace(direction, own / (own + views[c].density(at[c].position, direction)));
    });
  }
  store(std::move(points), hits);
  for (std::size_t c = 0; c < count; ++c) {
    hits.unknown.push_back(all[c] > 0 ? static_cast<float>(unknown[c] / all[c]) : 0);
    hits.bent.push_back(all[c] > 0 ? static_cast<float>(bent[c] / all[c]) : 0);
    hits.narrow.push_back(all[c] > 0 ? static_cast<float>(narrow_share[c] / all[c]) : 0);
  }
  return hits;
}

std::size_t LabelHits::bytes() const {
  return points.bytes() + weights.bytes() + sums.bytes() + blocks.size() * sizeof(Block) +
         material.size() * sizeof(material[0]) + lobes.size() * sizeof(Lobe) +
         labels.size() * (sizeof(labels[0]) + 3 * sizeof(unknown[0]));
}

bool LabelHits::fit(const Scene& scene, std::size_t cells) const {
  const std::size_t count = points.size();
  const auto all = [](const auto& things, const auto& test) {
    return std::all_of(things.begin(), things.end(), test);
  };
  const auto by_point = [](const Block& a, const Block& b) { return a.first_point < b.first_point; };
  if (blocks.empty() || blocks.back().first_point != count || sums.size() + 1 != blocks.size() ||
      weights.size() != count || material.size() != count || points.y.size() != count ||
      points.z.size() != count || points.nx.size() != count || points.ny.size() != count ||
      points.nz.size() != count || points.triangles.size() != count ||
      labels.size() > LabelRows::max_labels || unknown.size() != labels.size() ||
      bent.size() != labels.size() || narrow.size() != labels.size() || !sums.fit() || !weights.fit())
    return false;
  return std::is_sorted(blocks.begin(), blocks.end(), by_point) &&
         all(std::span(blocks).first(blocks.size() - 1), [&](const Block& b) { return b.cell < cells; }) &&
         all(labels, [&](std::uint32_t i) { return i < scene.labels.size(); }) &&
         all(material, [&](std::uint16_t k) { return k < scene.materials.size(); }) &&
         all(lobes, [&](const Lobe& lobe) {
           return lobe.node < cells * SurfaceCells::quadrants && lobe.label < labels.size() &&
                  lobe.material < scene.materials.size();
         });
}

void LabelHits::enclose(const World& world) {
  for (const std::uint32_t i : labels) box.include(world.receivers.point(i, 0.5, 0.5).position);
}

}  // namespace shelfbeam
