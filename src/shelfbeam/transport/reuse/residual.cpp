#include "shelfbeam/transport/reuse/residual.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/world/next_event.hpp"

namespace shelfbeam {

namespace {

// Share of the rays at a vertex that do not leave by its base. Where other vertices share the base, some of
// them see more of it than this path.
double share_otherwise(const PathVertex& vertex) {
  constexpr double least = 0.1;
  const SurfaceGuide& guide = *vertex.guide;
  if (!guide.has_base()) return 1;
  if (!guide.is_detailed()) return 0;
  if (guide.base_albedo() == 0) return 1;
  const double base = (vertex.end.is_straight ? guide.exit(1) : vertex.exit) * guide.base_albedo();
  const double coat = 1 - vertex.exit;
  return std::clamp(coat / (coat + base), least, 1 - least);
}

// Number of `rays` for this share; a smooth coat needs one, a share of 0 none.
std::uint32_t rays_otherwise(const PathVertex& vertex, double share, std::uint32_t rays) {
  if (share == 0) return 0;
  if (!vertex.guide->has_highlight()) return 1;
  if (share == 1) return rays;
  return std::max(1U, static_cast<std::uint32_t>(std::lround(share * rays)));
}

}  // namespace

// A generation multiplies the variance by albedo^2 over the survival.
double survival_at(double albedo) {
  struct Step {
    double max_albedo, survival;
  };
  constexpr std::array<Step, 4> steps{{{0.77, 0}, {0.85, 0.8}, {0.93, 0.9}, {0.975, 0.96}}};
  constexpr double of_brighter = 0.99;
  for (const Step& step : steps)
    if (albedo <= step.max_albedo) return step.survival;
  return of_brighter;
}

// The end of a ray and the weight of the radiance from there.
struct Residual::Found {
  PathVertex vertex;
  double weight;
};

// `stake_factor_`: at points that see many hundreds of units, shadow rays would otherwise take most of the
// time.
Residual::Residual(const World& world, const UnitGroups& units, const RadianceCache& cache,
                   const BrightSpots& spots, const RayTargets& targets, double requirement,
                   const ReuseEffort& effort)
    : world_(world),
      units_(units),
      cache_(cache),
      spots_(spots),
      targets_(targets),
      requirement_(requirement),
      reach_(static_cast<float>(0.05 * requirement)),
      effort_(effort),
      any_loose_(units.any_approximate()),
      stake_factor_(std::clamp(cache.units_per_cell() / 300, 1.0, 4.0)) {}

// Adds the direct light of bright spots at the bases.
void Residual::add_spots(std::span<const PathVertex> vertices, const Key& key, std::uint32_t generation,
                         Scratch& scratch, std::span<ResidualRows> rows, std::uint64_t& rays) const {
  if (spots_.size() == 0 || !spots_.rule().for_vertices) return;
  std::vector<std::uint32_t>& with_base = scratch.with_base;
  const std::uint64_t stream = mix_key(key.stream, (std::uint64_t{key.group} << 32) | generation);
  const auto receive = [&](std::uint32_t k, const Vec3& from) {
    const PathVertex& vertex = vertices[with_base[k]];
    const double cosine = dot(from, vertex.end.point.normal);
    if (!(cosine > 0)) return SpotReceiver{};
    return SpotReceiver{cosine * vertex.guide->base(cosine), cosine / pi};
  };
  for (const bool close : {false, true}) {
    with_base.clear();
    scratch.targets.clear();
    for (std::uint32_t a = 0; a < vertices.size(); ++a) {
      if (!vertices[a].has_base() || targets_.is_close(vertices[a].end.point.position) != close) continue;
      with_base.push_back(a);
      scratch.targets.push_back(vertices[a].end.point);
    }
    spots_.add_light(scratch.targets,
                     {0.05 * requirement_, (close ? effort_.more_if_close : 1) * effort_.spot_rays},
                     {mix_key(stream, close ? 0x5B076 : 0x5B075), key.batch}, scratch.spots, rays, receive,
                     [&](std::uint32_t k, std::uint32_t lane_index, double value) {
                       rows[with_base[k]].base.add(lane_index, value);
                     });
  }
}

// Subtracts the radiance that leaves the vertex by further bounces according to the cache.
void Residual::subtract_indirect(const PathVertex& vertex, ResidualRows& rows) const {
  const auto subtract = [&](LaneRow& row, double albedo) {
    if (!(albedo > 0)) return;
    row.use(vertex.row.groups, vertex.row.count);
    LaneKernels::add_listed(vertex.row.groups, vertex.row.count, static_cast<float>(-albedo / pi),
                            vertex.row.indirect, row.mutable_values());
  };
  if (vertex.has_base()) subtract(rows.base, vertex.guide->base_albedo());
  subtract(rows.own, vertex.own_albedo);
}

// Looks up the cache with rays that leave by the base or by other lobes; returns the end of the first ray.
std::optional<Residual::Found> Residual::gather(const PathVertex& vertex, bool by_base, std::uint32_t count,
                                                std::uint64_t points, RandomStream& random, LaneRow& row,
                                                std::uint64_t& rays) const {
  std::optional<Found> first, last;
  const ScrambledSobol square(points);
  // Uses a row of the cache one ray later, when it has arrived from memory.
  const auto use = [&](const Found& found) {
    found.vertex.look_up(units_, static_cast<float>(found.weight / count), row);
    if (!found.vertex.is_capped) return;
    spots_.add_near(found.vertex, cosine_area_density(vertex.end.point, found.vertex.end.point),
                    found.weight / count, random, row, rays);
  };
  const auto look = [&](const Vec3& direction, Departure departure, double weight) {
    const auto end = follow_chain(
        world_, vertex.end.point, direction, departure, random, rays,
        [&](std::size_t j, double value) { row.add(units_.lane_index(j), weight * value / count); });
    if (!end) return false;
    Found found{PathVertex(world_, cache_, *end), weight * end->throughput};
    found.vertex.is_capped = by_base && end->is_straight && spots_.rule().for_vertices;
    found.vertex.row.prefetch();
    if (last) use(*last);
    last.emplace(found);
    return true;
  };
  const SurfacePoint& here = vertex.end.point;
  const auto view =
      by_base && count > 0 ? targets_.seen_from(here.position, here.normal, count) : RayTargets::View();
  for (std::uint32_t t = 0; t < count; ++t) {
    const auto [u1, u2] = square.point(t);
    const auto scattered =
        by_base ? vertex.scatter_by_base(u1, u2) : vertex.scatter_otherwise(random.uniform(), u1, u2);
    if (!scattered) continue;
    const Vec3& direction = scattered->direction;
    const double part = view.weight(count * dot(here.normal, direction) / pi, here.position, direction);
    const bool is_found = look(direction, scattered->departure, scattered->weight * part);
    if (t > 0 || !is_found) continue;
    first.emplace(*last);
    first->weight /= part;
  }
  view.each_ray(points, [&](std::size_t target, double u1, double u2) {
    const Vec3 direction = view.direction(target, here.position, u1, u2);
    const double cosine = dot(here.normal, direction);
    if (!(cosine > 0)) return;
    const double density = count * cosine / pi + view.density(here.position, direction);
    look(direction, Departure::scattered, count * cosine * vertex.guide->base(cosine) / density);
  });
  if (last) use(*last);
  return first;
}

// Extends all paths generation by generation until none continues, then shares the results in reverse order.
// Paths between white walls are too long for recursion.
void Residual::estimate(std::span<const PathVertex> vertices, const Key& key, Scratch& scratch,
                        std::span<ResidualRows> rows, std::uint64_t& rays) const {
  struct Level {
    std::span<const PathVertex> vertices;
    std::span<ResidualRows> rows;
  };
  std::vector<Level> levels{{vertices, rows}};
  for (;;) {
    const auto generation = static_cast<std::uint32_t>(levels.size() - 1);
    if (scratch.generations.size() <= generation) scratch.generations.emplace_back();
    Scratch::Generation& next = scratch.generations[generation];
    extend(levels.back().vertices, key, generation, scratch, levels.back().rows, next, rays);
    const std::size_t count = next.vertices.size();
    if (count == 0) break;
    while (next.rows.size() < count) next.rows.emplace_back(units_.size());
    levels.push_back({next.vertices, std::span(next.rows).first(count)});
    for (ResidualRows& row : levels.back().rows) row.clear();
  }
  for (std::size_t g = levels.size() - 1; g-- > 0;) {
    const Scratch::Generation& next = scratch.generations[g];
    for (std::size_t b = 0; b < next.vertices.size(); ++b)
      share(levels[g].vertices, next.chances, next.continuations[b], next.vertices[b], next.rows[b], scratch,
            levels[g].rows, rays);
  }
}

// Estimates everything at the vertices but the continuing paths, and samples the vertices of these.
void Residual::extend(std::span<const PathVertex> vertices, const Key& key, std::uint32_t generation,
                      Scratch& scratch, std::span<ResidualRows> rows, Scratch::Generation& next,
                      std::uint64_t& rays) const {
  next.vertices.clear();
  next.continuations.clear();
  next.chances.assign(vertices.size(), 0);
  const std::uint32_t rays_each = generation == 0 ? effort_.gather_rays : effort_.later_gather_rays;

  add_spots(vertices, key, generation, scratch, rows, rays);
  for (std::size_t a = 0; a < vertices.size(); ++a) {
    const PathVertex& vertex = vertices[a];
    const auto index = static_cast<std::uint32_t>(a);
    RandomStream random(key.stream, key.batch, key.group, (generation << 16) + index);
    const std::uint64_t points = mix_key(mix_key(key.stream, (std::uint64_t{key.batch} << 32) | key.group),
                                         (generation << 16) + index);
    const std::uint32_t count =
        (targets_.is_close(vertex.end.point.position) ? effort_.more_if_close : 1) * rays_each;
    add_direct(vertex, random, scratch, rows[a], rays);
    add_far(vertex, random, rows[a], rays);
    subtract_indirect(vertex, rows[a]);

    const double otherwise = share_otherwise(vertex);
    const std::uint32_t others = rays_otherwise(vertex, otherwise, count);
    const std::uint32_t of_base = otherwise == 1 ? 0 : std::max(others + 1, count) - others;
    const auto by_base = gather(vertex, true, of_base, points, random, rows[a].base, rays);
    const auto by_other = gather(vertex, false, others, mix_key(points, 0x0FF), random, rows[a].own, rays);

    const double survival = std::max(effort_.survival, survival_at(vertex.albedo));
    next.chances[a] = survival * (1 - otherwise);
    const double u = random.uniform();
    if (u >= survival) continue;
    const bool samples_base = u < next.chances[a];
    const std::optional<Found>& found = samples_base ? by_base : by_other;
    if (!found) continue;
    const ChainEnd& end = found->vertex.end;
    next.vertices.push_back(found->vertex);
    next.continuations.push_back(
        {index,
         found->weight / (samples_base ? next.chances[a] : survival - next.chances[a]),
         samples_base,
         samples_base && end.is_straight && found->vertex.has_base(),
         {end.throughput * end.probability, end.probability}});
  }
}

// The vertices of a group, which share the points that their rays by the base found.
struct Residual::Sharers {
  std::span<const PathVertex> vertices;
  const std::vector<double>& chances;
  const PathVertex& found;

  std::size_t size() const { return vertices.size(); }
  RayEnd end(std::uint32_t a) const { return vertices[a].end.point; }
  double rays(std::uint32_t a) const { return chances[a]; }
  double density(std::uint32_t a) const {
    return chances[a] > 0 ? cosine_area_density(vertices[a].end.point, found.end.point) : 0;
  }
  double gain(std::uint32_t a) const {
    const SurfacePoint& here = vertices[a].end.point;
    const double cosine = dot(here.normal, normalized(found.end.point.position - here.position));
    return pi * vertices[a].guide->base(cosine) * found.exit_towards(here.position);
  }
};

// Adds the radiance of a new vertex to its parent and, by its base, to all vertices of the group that see it.
void Residual::share(std::span<const PathVertex> vertices, const std::vector<double>& chances,
                     const Continuation& from, const PathVertex& found, const ResidualRows& carried,
                     Scratch& scratch, std::span<ResidualRows> rows, std::uint64_t& rays) const {
  LaneRow& to_parent = from.by_base ? rows[from.parent].base : rows[from.parent].own;
  to_parent.add(carried.own, from.weight);
  if (from.is_shared)
    share_point(world_, found.end.point, Sharers{vertices, chances, found}, from.parent, from.transmittance,
                scratch.sharing, rays,
                [&](std::uint32_t a, double weight) { rows[a].base.add(carried.base, weight); });
  else
    to_parent.add(carried.base, found.exit * from.weight);
}

}  // namespace shelfbeam
