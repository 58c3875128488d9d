// Residual's shadow rays: the direct light of units at a vertex minus its approximation by the cache.

#include <algorithm>

#include "shelfbeam/transport/reuse/residual.hpp"

namespace shelfbeam {

namespace {

struct Arrived {
  PathVertex::Parts parts;
  std::uint64_t rays;
};

// Light from a point of source j that a vertex reflects, by light_from.
template <class Share>
Arrived arrive(const World& world, std::size_t j, const LightPoint& light, const PathVertex& vertex,
               bool images, const Share& share_of) {
  PathVertex::Reflection asked, straight;
  const DirectSignal signal = light_from(
      world, j, light, vertex.end.point, images,
      [&](const Vec3& to_source) {
        asked = vertex.reflected(to_source);
        return asked.whole;
      },
      [&] {
        straight = asked;
        return share_of();
      });
  return {vertex.split(straight, signal), signal.rays};
}

}  // namespace

// Lists the groups in reach of a vertex, the groups of its cell first, with the unoccluded irradiance e_j of
// every unit and the importance s_j of a shadow ray to it. Returns the sum of the importances.
double Residual::weigh_units(const PathVertex& vertex, Scratch& scratch) const {
  const LanePoint point(vertex.end.point);
  std::vector<std::uint16_t>& list = scratch.list;
  list.assign(vertex.row.groups, vertex.row.groups + vertex.row.count);
  for (std::size_t g = 0, next = 0; g < units_.size(); ++g) {
    if (next < vertex.row.count && vertex.row.groups[next] == g)
      ++next;
    else if (units_.bound(g, point) >= reach_)
      list.push_back(static_cast<std::uint16_t>(g));
  }
  scratch.zeros.resize(units_.size() * lanes);
  scratch.irradiance.resize(units_.size() * lanes);
  scratch.importance.resize(units_.size() * lanes);
  // Above 0 where light may arrive that e_j does not include.
  const SurfaceGuide& guide = *vertex.guide;
  const float floor = guide.is_approximate() || world_.mirrors.size() > 0 || any_loose_ ? 0.002F : 0;
  const LaneScatter* const scatter = guide.is_detailed() ? &vertex.scatter : nullptr;
  const auto weigh = [&](std::size_t first, std::size_t count, const std::uint8_t* share) {
    return LaneKernels::importance(units_, list.data() + first, count, point, vertex.is_capped, share, floor,
                                   scatter, scratch.irradiance.data() + first * lanes,
                                   scratch.importance.data() + first * lanes);
  };
  const float known = weigh(0, vertex.row.count, vertex.row.share);
  const float others = weigh(vertex.row.count, list.size() - vertex.row.count, scratch.zeros.data());
  return static_cast<double>(known + others);
}

// Chooses units for shadow rays, each with probability q_j = min(1, s_j / (stake tau)), by systematic
// sampling: equally spaced points over the cumulative sum of the probabilities.
void Residual::choose_units(const PathVertex& vertex, RandomStream& random, Scratch& scratch) const {
  const LanePoint point(vertex.end.point);
  const double scale = 1 / (effort_.stake * stake_factor_ * requirement_);
  double sum = random.uniform();
  double tooth = 1;
  for (std::size_t c = 0; c < scratch.list.size(); ++c) {
    const std::size_t g = scratch.list[c], width = units_.count(g);
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t lane = c * lanes + k;
      const double chance = std::min(1.0, scale * static_cast<double>(scratch.importance[lane]));
      sum += chance;
      if (sum < tooth) continue;
      tooth += 1;
      const std::uint32_t j = units_.column(g, k);
      if (!world_.emitters.is_transceiver(j)) continue;
      ShadowRay ray{.lane_index = static_cast<std::uint32_t>(g * lanes + k), .weight = 1 / chance};
      if (world_.emitters.is_point(j)) {
        ray.light = world_.emitters.point(j, 0, 0);
      } else {
        const double u1 = random.uniform(), u2 = random.uniform();
        ray.light = world_.emitters.point(j, u1, u2);
      }
      const float e = scratch.irradiance[lane], cap = units_.cap(g, k);
      const float used = vertex.is_capped && e > cap ? cap : e;
      if (used < e) ray.taken = static_cast<double>(used / e);
      const float v = c < vertex.row.count ? PackedLane::share(vertex.row.share[lane]) : 0;
      const auto [base, own] = vertex.guided(units_, g, k, point);
      ray.h_base = static_cast<double>(used * v * base);
      ray.h_own = static_cast<double>(used * v * own);
      scratch.shadow_rays.push_back(ray);
    }
  }
}

void Residual::add_direct(const PathVertex& vertex, RandomStream& random, Scratch& scratch,
                          ResidualRows& rows, std::uint64_t& rays) const {
  scratch.shadow_rays.clear();
  if (weigh_units(vertex, scratch) > 0) choose_units(vertex, random, scratch);
  // Emitting surfaces are few, and the cache omits them.
  for (std::size_t j = world_.scene.transceivers.size(); j < world_.emitters.size(); ++j) {
    const double u1 = random.uniform(), u2 = random.uniform();
    scratch.shadow_rays.push_back(
        {.lane_index = units_.lane_index(j), .light = world_.emitters.point(j, u1, u2)});
  }
  scratch.targets.clear();
  for (const ShadowRay& ray : scratch.shadow_rays) scratch.targets.push_back(ray.light.position);
  scratch.shares.resize(scratch.targets.size());
  world_.rays.shares(vertex.end.point, scratch.targets, scratch.shares);
  rays += scratch.targets.size();
  // Mirror paths carry little light for many rays, so only some vertices evaluate them.
  constexpr double mirror_chance = 0.25;
  const bool has_images = world_.mirrors.size() > 0 && random.uniform() < mirror_chance;
  for (std::size_t t = 0; t < scratch.shadow_rays.size(); ++t) {
    const ShadowRay& ray = scratch.shadow_rays[t];
    const std::size_t j = units_.column(ray.lane_index / lanes, ray.lane_index % lanes);
    const auto [parts, traced] =
        arrive(world_, j, ray.light, vertex, has_images && world_.emitters.is_transceiver(j),
               [&] { return static_cast<double>(scratch.shares[t]); });
    rays += traced > 1 ? traced - 1 : 0;
    const auto add = [&](LaneRow& row, const DirectSignal& light, double h) {
      const double value = light.straight * ray.taken + light.mirrored / mirror_chance - h;
      if (value != 0) row.add(ray.lane_index, ray.weight * value);
    };
    add(rows.base, parts.base, ray.h_base);
    add(rows.own, parts.own, ray.h_own);
  }
}

// Samples one of the units that are out of reach and not in the cache, with a probability in proportion to
// the bound on its group's irradiance.
void Residual::add_far(const PathVertex& vertex, RandomStream& random, ResidualRows& rows,
                       std::uint64_t& rays) const {
  if (vertex.row.count == units_.size()) return;
  const LanePoint point(vertex.end.point);
  const auto weight = [&](std::size_t g, std::size_t& next) {
    if (next < vertex.row.count && vertex.row.groups[next] == g) {
      ++next;
      return 0.0;
    }
    const float bound = units_.bound(g, point);
    return bound >= reach_ ? 0.0 : static_cast<double>(bound) * static_cast<double>(units_.count(g));
  };
  double total = 0;
  for (std::size_t g = 0, next = 0; g < units_.size(); ++g) total += weight(g, next);
  if (!(total > 0)) return;
  double left = random.uniform() * total;
  for (std::size_t g = 0, next = 0; g < units_.size(); ++g) {
    const double own = weight(g, next);
    if (own <= left) {
      left -= own;
      continue;
    }
    const std::size_t count = units_.count(g);
    const std::size_t k = to_index(random.bits(), static_cast<std::uint32_t>(count));
    const std::uint32_t j = units_.column(g, k);
    const double u1 = random.uniform(), u2 = random.uniform();
    const LightPoint light = world_.emitters.point(j, u1, u2);
    const auto [parts, traced] = arrive(world_, j, light, vertex, true, [&] {
      return world_.rays.transmittance(vertex.end.point, light.position).share;
    });
    rays += traced;
    double taken = 1;  // share of its light that rays from bright spots do not bring
    if (vertex.is_capped) {
      LaneValues irradiance;
      units_.irradiance(g, point, irradiance);
      if (irradiance[k] > units_.cap(g, k)) taken = static_cast<double>(units_.cap(g, k) / irradiance[k]);
    }
    const auto lane_index = static_cast<std::uint32_t>(g * lanes + k);
    const double scale = total * static_cast<double>(count) / own;
    const auto add = [&](LaneRow& row, const DirectSignal& part) {
      const double value = part.straight * taken + part.mirrored;
      if (value != 0) row.add(lane_index, value * scale);
    };
    add(rows.base, parts.base);
    add(rows.own, parts.own);
    return;
  }
}

}  // namespace shelfbeam
