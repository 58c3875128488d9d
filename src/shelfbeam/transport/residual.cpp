#include "shelfbeam/transport/residual.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "shelfbeam/math/sobol.hpp"
#include "shelfbeam/transport/direct.hpp"

namespace shelfbeam {

namespace {

constexpr double most_survival = 0.95;

}  // namespace

PathVertex::PathVertex(const World& world, const RadianceCache& cache, const ChainEnd& where)
    : end(where), row(cache.row(where.point)), guide(&cache.guide(where.material)), flat(guide->flat()) {
  (void)world;
  if (!guide->is_coated()) return;
  const double cosine = dot(end.point.normal, end.outgoing);
  scatter = guide->at(end.point.normal, end.outgoing);
  exit = guide->exit(cosine);
  flat = static_cast<float>((exit * guide->base_albedo() + guide->lobe_albedo(cosine)) / pi);
}

double PathVertex::exit_towards(const Vec3& place) const {
  if (!guide->is_coated()) return 1;
  return guide->exit(dot(end.point.normal, normalized(place - end.point.position)));
}

void PathVertex::look_up(const UnitGroups& units, float weight, LaneRow& to) const {
  to.use(row.groups, row.count);
  const LanePoint point(end.point);
  if (guide->is_coated())
    LaneKernels::add_radiance(units, row.groups, row.count, point, scatter, is_capped, weight, flat, row.share,
                              row.indirect, to.mutable_values());
  else
    LaneKernels::add_irradiance(units, row.groups, row.count, point, is_capped, weight * flat, row.share,
                                row.indirect, to.mutable_values());
}

// f |cos| towards a source, with the label's side known.
double Residual::reflected(const PathVertex& vertex, const Vec3& to_source) const {
  const SurfaceGuide& guide = *vertex.guide;
  if (guide.has_base() && !guide.is_coated())
    return guide.base(1) * std::max(0.0, dot(vertex.end.point.normal, to_source));
  const Frame frame = Frame::of_surface(vertex.end.outside);
  const Vec3 incoming = frame.to_local(to_source);
  return eval(world_.scene.materials[vertex.end.material.value].material, frame.to_local(vertex.end.outgoing),
              incoming) *
         std::abs(incoming.z);
}

// The same of the base alone, without its exit.
double Residual::reflected_by_base(const PathVertex& vertex, const Vec3& to_source) const {
  const double cosine = dot(vertex.end.point.normal, to_source);
  return vertex.guide->has_base() && cosine > 0 ? vertex.guide->base(cosine) * cosine : 0;
}

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
  const LaneScatter* const scatter = guide.is_coated() ? &vertex.scatter : nullptr;
  const float floor = !guide.knows_all() || world_.mirrors.size() > 0 || any_loose_ ? 0.002F : 0;
  const std::size_t known = vertex.row.count * lanes;
  const float total =
      LaneKernels::importance(units_, list.data(), vertex.row.count, point, vertex.is_capped,
                              vertex.row.share, floor, scatter, scratch.irradiance.data(), scratch.importance.data()) +
      LaneKernels::importance(units_, list.data() + vertex.row.count, list.size() - vertex.row.count, point,
                              vertex.is_capped, scratch.zeros.data(), floor, scatter,
                              scratch.irradiance.data() + known, scratch.importance.data() + known);
  scratch.places.clear();
  scratch.lights.clear();
  scratch.targets.clear();
  scratch.inverse_probability.clear();
  scratch.known.clear();
  scratch.known_lobe.clear();
  scratch.taken.clear();
  if (total > 0) {
    // Systematic sampling: a comb with teeth at whole numbers over the running sum of the probabilities.
    const double scale = 1 / (stake * requirement_);
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
        // Of the cache: what the base sends without its exit, and the highlight.
        const float arrived = used * share;
        float base = guide.has_base() ? guide.flat() : 0, lobe = guide.has_base() ? 0 : guide.flat();
        if (guide.is_coated()) {
          const LaneKernels::Parts parts = LaneKernels::parts(units_, list[c], k, point, vertex.scatter,
                                                              static_cast<float>(guide.base()));
          base = parts.base;
          lobe = parts.lobe;
        }
        scratch.known.push_back(static_cast<double>(arrived * base));
        scratch.known_lobe.push_back(static_cast<double>(arrived * lobe));
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
    scratch.known.push_back(0);
    scratch.known_lobe.push_back(0);
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
    const DirectSignal light = light_from(
        world_, j, scratch.lights[t], vertex.end.point, has_images && world_.emitters.is_point(j),
        [&](const Vec3& to_source) { return reflected(vertex, to_source); },
        [&] { return static_cast<double>(scratch.shares[t]); });
    rays += light.rays > 1 ? light.rays - 1 : 0;
    const auto [base, lobe] = split(vertex, scratch.lights[t], light);
    const double weight = scratch.inverse_probability[t];
    if (guide.has_base())
      rows.base.add(scratch.places[t],
                    weight * (base.straight * scratch.taken[t] + base.mirrored / mirror_chance - scratch.known[t]));
    if (scratch.known_lobe[t] != 0 || lobe.straight != 0 || lobe.mirrored != 0)
      rows.lobe.add(scratch.places[t], weight * (lobe.straight * scratch.taken[t] +
                                                 lobe.mirrored / mirror_chance - scratch.known_lobe[t]));
  }
}

// Parts of the light that comes straight from a source and leaves over the vertex: that of the base, without
// its exit, and that of the highlight. Over mirrors it all counts as the latter, unless there is only a base.
std::pair<DirectSignal, DirectSignal> Residual::split(const PathVertex& vertex, const LightPoint& light,
                                                      const DirectSignal& signal) const {
  const SurfaceGuide& guide = *vertex.guide;
  if (!guide.has_base()) return {{}, signal};
  if (!guide.is_coated()) return {signal, {}};
  DirectSignal base, lobe = signal;
  if (signal.straight > 0) {
    const Vec3 to_source = normalized(light.position - vertex.end.point.position);
    base.straight = signal.straight * reflected_by_base(vertex, to_source) / reflected(vertex, to_source);
    lobe.straight = std::max(0.0, signal.straight - vertex.exit * base.straight);
  }
  return {base, lobe};
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
    const DirectSignal signal = light_from(
        world_, j, light, vertex.end.point, world_.emitters.is_point(j),
        [&](const Vec3& to_source) { return reflected(vertex, to_source); },
        [&] { return world_.rays.passage(vertex.end.point, light.position).share; });
    rays += signal.rays;
    double taken = 1;  // of its light: not that of bright spots
    if (vertex.is_capped) {
      LaneValues irradiance;
      units_.irradiance(g, point, irradiance);
      if (irradiance[k] > units_.cap(g, k)) taken = static_cast<double>(units_.cap(g, k) / irradiance[k]);
    }
    const auto place = static_cast<std::uint32_t>(g * lanes + k);
    const double scale = total * static_cast<double>(count) / own;
    const auto [base, lobe] = split(vertex, light, signal);
    if (base.straight + base.mirrored != 0) rows.base.add(place, (base.straight * taken + base.mirrored) * scale);
    if (lobe.straight + lobe.mirrored != 0) rows.lobe.add(place, (lobe.straight * taken + lobe.mirrored) * scale);
    return;
  }
}

void Residual::estimate(std::span<const PathVertex> vertices, const Key& key, std::uint32_t generation,
                        Scratch& scratch, std::span<ResidualRows> rows, std::uint64_t& rays) const {
  while (scratch.generations.size() <= generation) scratch.generations.emplace_back();
  Scratch::Generation& next = scratch.generations[generation];
  next.vertices.clear();
  struct Continuation {
    std::size_t parent;
    double weight, survival;
    bool is_shared, is_base;
    Passage passage;  // straight from the parent
  };
  std::vector<Continuation> continuations;
  std::vector<double> chances(vertices.size());  // of going on by the base
  const std::uint32_t tails = generation == 0 ? effort_.tails : effort_.later_tails;
  const double stake = generation == 0 ? effort_.stake : effort_.later_stake;

  for (std::size_t a = 0; a < vertices.size(); ++a) {
    const PathVertex& vertex = vertices[a];
    const SurfaceGuide& guide = *vertex.guide;
    ResidualRows& row = rows[a];
    const auto place = static_cast<std::uint32_t>(a);
    RandomStream random(key.stream, key.batch, key.group, (generation << 16) + place);
    const std::uint64_t points = mix_key(mix_key(key.stream, (std::uint64_t{key.batch} << 32) | key.group),
                                         (generation << 16) + place);
    add_direct(vertex, stake, random, scratch, row, rays);
    add_far(vertex, random, row, rays);

    const Frame side = Frame::about(vertex.end.point.normal), frame = Frame::of_surface(vertex.end.outside);
    const Vec3 outgoing = guide.has_base() ? side.to_local(vertex.end.outgoing) : frame.to_local(vertex.end.outgoing);
    const double lobe_albedo = guide.is_coated() ? guide.lobe_albedo(outgoing.z) : 0;
    const double from_base = guide.has_base() ? vertex.exit * guide.base_albedo() : 0;
    const auto subtract = [&](LaneRow& from, double albedo) {
      if (!(albedo > 0)) return;
      from.use(vertex.row.groups, vertex.row.count);
      LaneKernels::add_listed(vertex.row.groups, vertex.row.count, static_cast<float>(-albedo / pi),
                              vertex.row.indirect, from.mutable_values());
    };
    if (guide.has_base()) subtract(row.base, guide.base_albedo());
    subtract(row.lobe, guide.is_coated() ? lobe_albedo : guide.has_base() ? 0 : guide.flat() * pi);

    // Rays for the base and for the highlight, as they shine.
    std::uint32_t lobe_tails = guide.has_base() ? 0 : tails;
    const Plastic* const plastic = guide.plastic();
    double coat_share = guide.has_base() ? 0 : 1;
    if (plastic != nullptr) {
      const double coat = 1 - vertex.exit;
      coat_share = from_base > 0 ? std::clamp(coat / (coat + from_base), 0.1, 0.9) : 1;
      lobe_tails = from_base > 0 ? std::clamp(static_cast<std::uint32_t>(std::lround(coat_share * tails)), 1U, tails - 1) : tails;
      if (!plastic->facets) lobe_tails = 1;
    }
    const std::uint32_t base_tails = tails - lobe_tails;
    // As bright as the surface, the chance keeps the variance finite: a generation multiplies it by albedo^2
    // over the chance.
    const double survival = std::clamp(static_cast<double>(vertex.flat) * pi, effort_.survival, most_survival);
    const bool goes_on = random.unit() < survival;
    chances[a] = base_tails > 0 ? survival * (1 - coat_share) : 0;
    const bool goes_by_base = random.unit() >= coat_share;
    // A row of the cache is used one ray later, when it has come from memory.
    struct Found {
      PathVertex vertex;
      double through;
    };
    const auto send = [&](bool is_base, std::uint32_t count, LaneRow& to) {
      if (count == 0) return;
      const ScrambledSobol square(is_base ? points : mix_key(points, 0x10BE));
      std::optional<Found> last;
      const auto use = [&](const Found& found) {
        found.vertex.look_up(units_, static_cast<float>(found.through / count), to);
      };
      for (std::uint32_t t = 0; t < count; ++t) {
        const auto [u1, u2] = square.point(t);
        Vec3 direction;
        double weight = guide.base_albedo();
        bool is_specular = false;
        if (is_base) {
          const Vec3 local = sample_cosine_hemisphere(u1, u2);
          direction = side.to_world(local);
          if (guide.is_coated()) weight = pi * guide.base(local.z);
        } else if (plastic != nullptr) {
          const auto drawn = plastic->sample_coat(outgoing, u1, u2);
          if (!drawn) continue;
          direction = side.to_world(drawn->direction);
          weight = drawn->weight;
          is_specular = drawn->specular;
        } else {
          const auto drawn = sample(world_.scene.materials[vertex.end.material.value].material, outgoing,
                                    random.unit(), u1, u2);
          if (!drawn) continue;
          direction = frame.to_world(drawn->direction);
          weight = drawn->weight;
          is_specular = drawn->specular;
        }
        const auto end = follow_chain(
            world_, vertex.end.point, direction, is_specular, random, rays,
            [&](std::size_t j, double value) { to.add(units_.place(j), weight * value / count); });
        if (!end) continue;
        const PathVertex found(world_, cache_, *end);
        found.row.prefetch();
        const double through = weight * end->throughput;
        if (last) use(*last);
        last.emplace(Found{found, through});
        if (t == 0 && goes_on && is_base == goes_by_base) {
          next.vertices.push_back(found);
          const double chance = survival * (is_base ? 1 - coat_share : coat_share);
          continuations.push_back({a,
                                   through,
                                   chance,
                                   is_base && end->is_straight && found.guide->has_base(),
                                   is_base,
                                   {end->throughput * end->probability, end->probability}});
        }
      }
      if (last) use(*last);
    };
    send(true, base_tails, row.base);
    send(false, lobe_tails, row.lobe);
  }
  if (next.vertices.empty()) return;

  while (next.rows.size() < vertices.size()) next.rows.emplace_back(units_.size());
  for (ResidualRows& row : next.rows) row.clear();
  estimate(next.vertices, key, generation + 1, scratch, std::span(next.rows).first(next.vertices.size()),
           rays);

  std::vector<double> density(vertices.size());
  for (std::size_t b = 0; b < continuations.size(); ++b) {
    const Continuation& from = continuations[b];
    const ResidualRows& carried = next.rows[b];
    const PathVertex& found = next.vertices[b];
    LaneRow& own = from.is_base ? rows[from.parent].base : rows[from.parent].lobe;
    own.add(carried.lobe, from.weight / from.survival);
    if (!from.is_shared) {
      own.add(carried.base, found.exit * from.weight / from.survival);
      continue;
    }
    const SurfacePoint& there = found.end.point;
    scratch.sharers.clear();
    scratch.targets.clear();
    for (std::size_t c = 0; c < vertices.size(); ++c) {
      if (!vertices[c].guide->has_base()) continue;
      const Vec3 way = there.position - vertices[c].end.point.position;
      const double squared = length_squared(way);
      const double cosines =
          std::max(0.0, dot(way, vertices[c].end.point.normal)) * std::max(0.0, -dot(way, there.normal));
      density[c] = squared > 0 ? cosines / (squared * squared) : 0;
      if (c == from.parent || !(density[c] > 0)) continue;
      scratch.sharers.push_back(static_cast<std::uint32_t>(c));
      scratch.targets.push_back(vertices[c].end.point.position);
    }
    scratch.passages.resize(scratch.targets.size());
    world_.rays.passages(there, scratch.targets, scratch.passages);
    rays += scratch.targets.size();
    scratch.sharers.push_back(static_cast<std::uint32_t>(from.parent));
    scratch.passages.push_back(from.passage);
    double sum = 0;
    for (std::size_t t = 0; t < scratch.sharers.size(); ++t)
      sum += chances[scratch.sharers[t]] * density[scratch.sharers[t]] * scratch.passages[t].probability;
    if (!(sum > 0)) continue;
    for (std::size_t t = 0; t < scratch.sharers.size(); ++t) {
      const std::uint32_t c = scratch.sharers[t];
      if (scratch.passages[t].share == 0) continue;
      const Vec3& here = vertices[c].end.point.position;
      double weight = vertices[c].guide->base_albedo();
      if (vertices[c].guide->is_coated())
        weight = pi * vertices[c].guide->base(dot(vertices[c].end.point.normal, normalized(there.position - here)));
      rows[c].base.add(carried.base, weight * found.exit_towards(here) * density[c] * scratch.passages[t].share / sum);
    }
  }
}

}  // namespace shelfbeam
