// The straight light of units at a vertex, less the cache's: shadow rays of Residual.

#include <algorithm>

#include "shelfbeam/transport/reuse/residual.hpp"

namespace shelfbeam {

namespace {

struct Arrived {
  PathVertex::Parts parts;
  std::uint64_t rays;
};

// What comes from a point of source j to a vertex, as light_from has it, and is reflected there.
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

void Residual::add_direct(const PathVertex& vertex, double stake, RandomStream& random, Scratch& scratch,
                          ResidualRows& rows, std::uint64_t& rays) const {
  const std::size_t n_units = world_.scene.transceivers.size();
  const LanePoint point(vertex.end.point);
  // The cell's groups first, then others in reach, of which the cache says nothing.
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
  // Where light may come that `irradiance` does not know of.
  const SurfaceGuide& guide = *vertex.guide;
  const LaneScatter* const scatter = guide.is_detailed() ? &vertex.scatter : nullptr;
  const float floor = guide.is_loose() || world_.mirrors.size() > 0 || any_loose_ ? 0.002F : 0;
  const std::size_t known = vertex.row.count * lanes;
  const float total =
      LaneKernels::importance(units_, list.data(), vertex.row.count, point, vertex.is_capped,
                              vertex.row.share, floor, scatter, scratch.irradiance.data(),
                              scratch.importance.data()) +
      LaneKernels::importance(units_, list.data() + vertex.row.count, list.size() - vertex.row.count, point,
                              vertex.is_capped, scratch.zeros.data(), floor, scatter,
                              scratch.irradiance.data() + known, scratch.importance.data() + known);
  scratch.places.clear();
  scratch.lights.clear();
  scratch.targets.clear();
  scratch.inverse_probability.clear();
  scratch.known_base.clear();
  scratch.known_own.clear();
  scratch.taken.clear();
  if (total > 0) {
    // Systematic sampling: a comb with teeth at whole numbers over the running sum of the probabilities.
    const double scale = 1 / (stake * crowd_ * requirement_);
    double sum = random.unit();
    double tooth = 1;
    for (std::size_t c = 0; c < list.size(); ++c) {
      const std::size_t width = units_.count(list[c]);
      for (std::size_t k = 0; k < width; ++k) {
        const std::size_t lane = c * lanes + k;
        const double probability = std::min(1.0, scale * static_cast<double>(scratch.importance[lane]));
        sum += probability;
        if (sum < tooth) continue;
        tooth += 1;
        const std::uint32_t j = units_.column(list[c], k);
        if (j >= n_units) continue;
        LightPoint light;
        if (world_.emitters.is_point(j)) {
          light = world_.emitters.point(j, 0, 0);
        } else {
          const double u1 = random.unit(), u2 = random.unit();
          light = world_.emitters.point(j, u1, u2);
        }
        const float whole = scratch.irradiance[lane], cap = units_.cap(list[c], k);
        const float used = vertex.is_capped && whole > cap ? cap : whole;
        const float share = lane < known ? PackedLane::share(vertex.row.share[lane]) : 0;
        scratch.places.push_back(static_cast<std::uint32_t>(list[c] * lanes + k));
        scratch.lights.push_back(light);
        scratch.targets.push_back(light.position);
        scratch.inverse_probability.push_back(1 / probability);
        scratch.taken.push_back(used < whole ? static_cast<double>(used / whole) : 1);
        // What the cache takes the base to send, without its exit, and the rest.
        const float arrived = used * share;
        float base = guide.has_base() ? guide.flat() : 0, own = guide.has_base() ? 0 : guide.flat();
        if (guide.is_detailed()) {
          const LaneKernels::Parts parts = LaneKernels::parts(units_, list[c], k, point, vertex.scatter);
          base = static_cast<float>(guide.bare_base()) * parts.entry;
          own = parts.highlight;
        }
        scratch.known_base.push_back(static_cast<double>(arrived * base));
        scratch.known_own.push_back(static_cast<double>(arrived * own));
      }
    }
  }
  // Surfaces that shine are few, and the cache does not know them.
  for (std::size_t j = n_units; j < world_.emitters.size(); ++j) {
    const double u1 = random.unit(), u2 = random.unit();
    scratch.places.push_back(units_.place(j));
    scratch.lights.push_back(world_.emitters.point(j, u1, u2));
    scratch.targets.push_back(scratch.lights.back().position);
    scratch.inverse_probability.push_back(1);
    scratch.known_base.push_back(0);
    scratch.known_own.push_back(0);
    scratch.taken.push_back(1);
  }
  scratch.shares.resize(scratch.targets.size());
  world_.rays.shares(vertex.end.point, scratch.targets, scratch.shares);
  rays += scratch.targets.size();
  // Over mirrors comes little light for many rays: it is asked for at some vertices only.
  constexpr double mirror_chance = 0.25;
  const bool has_images = world_.mirrors.size() > 0 && random.unit() < mirror_chance;
  for (std::size_t t = 0; t < scratch.targets.size(); ++t) {
    const std::size_t j = units_.column(scratch.places[t] / lanes, scratch.places[t] % lanes);
    const auto [parts, traced] =
        arrive(world_, j, scratch.lights[t], vertex, has_images && world_.emitters.is_transceiver(j),
               [&] { return static_cast<double>(scratch.shares[t]); });
    rays += traced > 1 ? traced - 1 : 0;
    const double weight = scratch.inverse_probability[t];
    const auto add = [&](LaneRow& row, const DirectSignal& part, double of_cache) {
      const double value = part.straight * scratch.taken[t] + part.mirrored / mirror_chance - of_cache;
      if (value != 0) row.add(scratch.places[t], weight * value);
    };
    add(rows.base, parts.base, scratch.known_base[t]);
    add(rows.own, parts.own, scratch.known_own[t]);
  }
}

// One of the units out of reach that the cache leaves out, too; near ones are likelier.
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
  double left = random.unit() * total;
  for (std::size_t g = 0, next = 0; g < units_.size(); ++g) {
    const double own = weight(g, next);
    if (own <= left) {
      left -= own;
      continue;
    }
    const std::size_t count = units_.count(g);
    const std::size_t k = to_index(random.bits(), static_cast<std::uint32_t>(count));
    const std::uint32_t j = units_.column(g, k);
    const double u1 = random.unit(), u2 = random.unit();
    const LightPoint light = world_.emitters.point(j, u1, u2);
    const auto [parts, traced] = arrive(world_, j, light, vertex, true, [&] {
      return world_.rays.passage(vertex.end.point, light.position).share;
    });
    rays += traced;
    double taken = 1;  // of its light: not that of bright spots
    if (vertex.is_capped) {
      LaneValues irradiance;
      units_.irradiance(g, point, irradiance);
      if (irradiance[k] > units_.cap(g, k)) taken = static_cast<double>(units_.cap(g, k) / irradiance[k]);
    }
    const auto place = static_cast<std::uint32_t>(g * lanes + k);
    const double scale = total * static_cast<double>(count) / own;
    const auto add = [&](LaneRow& row, const DirectSignal& part) {
      const double value = part.straight * taken + part.mirrored;
      if (value != 0) row.add(place, value * scale);
    };
    add(rows.base, parts.base);
    add(rows.own, parts.own);
    return;
  }
}

}  // namespace shelfbeam
