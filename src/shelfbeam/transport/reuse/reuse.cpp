#include "shelfbeam/transport/reuse/reuse.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/cache/smallest_requirement.hpp"
#include "shelfbeam/transport/reuse/bright_spots.hpp"
#include "shelfbeam/transport/reuse/label_sharers.hpp"
#include "shelfbeam/transport/reuse/residual.hpp"
#include "shelfbeam/transport/world/direct.hpp"
#include "shelfbeam/transport/world/label_clusters.hpp"
#include "shelfbeam/transport/world/next_event.hpp"

namespace shelfbeam {

namespace {

constexpr std::size_t largest_cluster = 96;
// The cache keeps irradiances above this share of the smallest requirement.
constexpr double min_share = 0.005;

SurfaceLinks links_of(const World& world, std::uint64_t key, const ReuseEffort& effort,
                      const RunControl& control) {
  const auto search = effort.seeks_rare_light ? detail::CellSearch::units : detail::CellSearch::labels;
  auto cells = std::make_shared<const detail::SurfaceCells>(world, key, search, control);
  control.report(Task::preparing, 0.1);
  return {world, std::move(cells), key, {}, control};
}

}  // namespace

struct ReuseEstimator::Tables {
  struct Workspace {
    Residual::Scratch residual;
    std::vector<LaneRow> labels;
    std::vector<ResidualRows> points;
    std::vector<SurfacePoint> at;
    // First hits of the labels' rays: their vertices, and the labels that found them.
    struct Found {
      std::uint32_t owner;
      double weight;  // of the radiance from there
      bool is_shared;
    };
    std::vector<PathVertex> vertices;
    std::vector<Found> found;
    Sharing sharing;
    std::vector<RayEnd> targets;
    std::vector<double> direct;
  };

  Tables(const World& w, std::uint64_t s, const ReuseEffort& e, const SurfaceLinks& links,
         const RunControl& control)
      : world(w),
        requirement(smallest_requirement(w.scene)),
        effort(e),
        units(w),
        spots(w, units, mix_key(s, hash64("bright spots")), e.spots),
        targets(spots.targets()),
        shared_cache(std::make_shared<const RadianceCache>(
            w, units, links, static_cast<float>(min_share * requirement), spots.steep_lights(s), control)),
        cache(*shared_cache),
        residual(w, units, cache, spots, targets, requirement, e) {}

  // For another state of the world, with the cache of the first.
  Tables(const World& w, std::uint64_t s, const ReuseEffort& e, const Tables& first)
      : world(w),
        requirement(first.requirement),
        effort(e),
        units(w, first.units),
        spots(w, units, mix_key(s, hash64("bright spots")), e.spots),
        targets(spots.targets()),
        shared_cache(first.shared_cache),
        cache(*shared_cache),
        residual(w, units, cache, spots, targets, requirement, e) {}

  // Adds the cache's light on every label, from many rays that only look up the cache, and the light of
  // sources that these rays meet over mirrors.
  void look_up(const Block& block, std::uint64_t key, std::uint32_t batch, Workspace& work,
               std::uint64_t& rays) const {
    for (std::size_t c = 0; c < block.rows.size(); ++c) {
      const std::uint32_t i = block.rows[c];
      LaneRow& row = work.labels[c];
      const Responsivity& responsivity = world.receivers.responsivity(i);
      const double weight = integral(responsivity) / effort.lookups;
      RandomStream random(key, batch, static_cast<std::uint32_t>(c), 1);
      const ScrambledSobol square(mix_key(mix_key(key, batch), 2 * c));
      const bool is_point = world.receivers.is_point(i);
      // Uses a row of the cache one ray later, when it has arrived from memory.
      struct Found {
        PathVertex vertex;
        float weight;
        double density;  ///< of the ray, per area
      };
      std::optional<Found> last;
      const auto use = [&](const Found& found) {
        found.vertex.look_up(units, found.weight, row);
        if (found.vertex.is_capped)
          spots.add_near(found.vertex, found.density, static_cast<double>(found.weight), random, row, rays);
      };
      const auto look = [&](const SurfacePoint& from, const Vec3& direction, double of_ray) {
        const auto end =
            follow_chain(world, from, direction, Departure::scattered, random, rays,
                         [&](std::size_t j, double value) { row.add(units.lane_index(j), of_ray * value); });
        if (!end) return;
        Found found{PathVertex(world, cache, *end), static_cast<float>(of_ray * end->throughput), 0};
        found.vertex.is_capped = end->is_straight;
        if (end->is_straight) found.density = label_density(world, i, from, end->point);
        found.vertex.row.prefetch();
        if (last) use(*last);
        last.emplace(found);
      };
      const auto start = [&] {
        if (is_point) return work.at[c];
        const double u3 = random.uniform(), u4 = random.uniform();
        return world.receivers.point(i, u3, u4);
      };
      const Frame& frame = world.receivers.frame(i);
      const auto view = targets.seen_from(work.at[c].position, frame.to_world({0, 0, 1}), effort.lookups);
      for (std::uint32_t s = 0; s < effort.lookups; ++s) {
        const auto [u1, u2] = square.point(s);
        const auto drawn = shelfbeam::sample(responsivity, u1, u2);
        if (!drawn) continue;
        const SurfacePoint from = start();
        const Vec3 direction = frame.to_world(drawn->direction);
        const double own = view.is_empty() ? 1 : effort.lookups * pdf(responsivity, drawn->direction);
        look(from, direction, weight * view.weight(own, from.position, direction));
      }
      view.each_ray(mix_key(mix_key(key, batch), 2 * c), [&](std::size_t target, double u1, double u2) {
        const SurfacePoint from = start();
        const Vec3 direction = view.direction(target, from.position, u1, u2);
        const double own = effort.lookups * pdf(responsivity, frame.to_local(direction));
        if (!(own > 0)) return;
        look(from, direction, weight * own / (own + view.density(from.position, direction)));
      });
      if (last) use(*last);
    }
  }

  // Adds the direct light of bright spots at the labels.
  void add_spots(const Block& block, std::uint64_t key, std::uint32_t batch, Workspace& work,
                 std::uint64_t& rays) const {
    work.targets.clear();
    for (const SurfacePoint& point : work.at) work.targets.push_back(point);
    const auto receive = [&](std::uint32_t c, const Vec3& from) {
      const double response = world.receivers.response(block.rows[c], from);
      return SpotReceiver{response, response / integral(world.receivers.responsivity(block.rows[c]))};
    };
    spots.add_light(work.targets, {0.05 * requirement, effort.spot_rays}, {mix_key(key, 0x5B075), batch},
                    work.residual.spots, rays, receive,
                    [&](std::uint32_t c, std::uint32_t lane_index, double value) {
                      work.labels[c].add(lane_index, value);
                    });
  }

  // K. Much of the light that passes an opening, or comes from the corner beside a spot, is found by few
  // paths. If a small cluster had few paths, short runs would miss it.
  std::uint32_t points_of(const Block& block) const {
    constexpr std::uint32_t most = 8;
    const bool is_rare = effort.is_hidden || cache.any_hidden() || spots.any_steep();
    if (!effort.seeks_rare_light || !is_rare) return effort.points;
    const auto times = static_cast<std::uint32_t>(largest_cluster / block.rows.size());
    return effort.points * std::clamp(times, 1U, most);
  }

  // Adds the residual at some points per label.
  void add_residual(const Block& block, std::uint64_t key, std::uint32_t batch, Workspace& work,
                    std::uint64_t& rays) const {
    const std::uint32_t points = points_of(block);
    std::uint32_t group = 0;
    const auto flush = [&] {
      if (work.vertices.empty()) return;
      while (work.points.size() < work.vertices.size()) work.points.emplace_back(units.size());
      for (ResidualRows& row : work.points) row.clear();
      residual.estimate(work.vertices, {mix_key(key, 0x9E51D), batch, group++}, work.residual,
                        std::span(work.points).first(work.vertices.size()), rays);
      share_points(block, work, rays);
      work.vertices.clear();
      work.found.clear();
    };
    for (std::uint32_t s = 0; s < points; ++s)
      for (std::size_t c = 0; c < block.rows.size(); ++c) {
        const std::uint32_t i = block.rows[c];
        const Responsivity& responsivity = world.receivers.responsivity(i);
        const auto [u1, u2] = ScrambledSobol(mix_key(mix_key(key, batch), 2 * c + 1)).point(s);
        RandomStream random(key, batch, static_cast<std::uint32_t>(c), 2 + s);
        const auto drawn = shelfbeam::sample(responsivity, u1, u2);
        if (!drawn) continue;
        const double weight = integral(responsivity) / points;
        const auto end = follow_chain(world, work.at[c], world.receivers.frame(i).to_world(drawn->direction),
                                      Departure::scattered, random, rays, [](std::size_t, double) {});
        if (!end) continue;
        work.vertices.emplace_back(world, cache, *end);
        work.vertices.back().is_capped = end->is_straight;
        work.found.push_back({static_cast<std::uint32_t>(c), weight * end->throughput,
                              end->is_straight && work.vertices.back().has_base()});
        if (work.vertices.size() == effort.group) flush();
      }
    flush();
  }

  // Adds the radiance from the bases of points to all labels that see them, the rest to their finders.
  void share_points(const Block& block, Workspace& work, std::uint64_t& rays) const {
    const std::uint32_t points = points_of(block);
    for (std::size_t b = 0; b < work.vertices.size(); ++b) {
      const auto& [owner, weight, is_shared] = work.found[b];
      const PathVertex& vertex = work.vertices[b];
      const ChainEnd& end = vertex.end;
      work.labels[owner].add(work.points[b].own, weight);
      if (is_shared)
        share_point(
            world, end.point, LabelSharers{world, block.rows, work.at, end.point, *vertex.guide, points},
            owner, {end.throughput * end.probability, end.probability}, work.sharing, rays,
            [&](std::uint32_t c, double of_base) { work.labels[c].add(work.points[b].base, of_base); });
      else
        work.labels[owner].add(work.points[b].base, vertex.exit * weight);
    }
  }

  // Whether label or source is so large for their distance that direct light takes several samples per batch.
  bool needs_strata(std::size_t i, std::size_t j) const {
    constexpr double much = 0.1;
    if (j >= world.scene.transceivers.size()) return true;
    const auto& size = world.scene.type_of(world.scene.labels[i]).size;
    const Transceiver& unit = world.scene.transceivers[j];
    const double extent = size[0] + size[1] + 2 * world.scene.type_of(unit).radius;
    return extent > much * length(unit.position - world.scene.labels[i].position);
  }

  // Probability that a batch samples the direct light of an entry; below 1 for units too far or too weak to
  // matter.
  double direct_chance(std::size_t i, std::size_t j) const {
    constexpr double seldom = 0.125, little = 0.01;
    if (j >= world.scene.transceivers.size()) return 1;
    const double away = length(world.scene.transceivers[j].position - world.scene.labels[i].position);
    const double most = static_cast<double>(units.peak(units.lane_index(j) / lanes)) / (away * away);
    return most > little * world.scene.irradiance_for(world.scene.labels[i]) ? 1 : seldom;
  }

  const World& world;
  const PathRules rules{.strategy = Strategy::nee, .samples_direct = false};
  double requirement;
  ReuseEffort effort;
  UnitGroups units;
  BrightSpots spots;
  RayTargets targets;
  std::shared_ptr<const RadianceCache> shared_cache;
  const RadianceCache& cache;
  Residual residual;
  mutable tbb::enumerable_thread_specific<Workspace> workspaces;
};

ReuseEstimator::ReuseEstimator(const World& world, std::uint64_t seed, const ReuseEffort& effort,
                               const RunControl& control)
    : ReuseEstimator(world, seed, effort,
                     links_of(world, mix_key(seed, hash64("radiance cache")), effort, control), control) {}
ReuseEstimator::ReuseEstimator(const World& world, std::uint64_t seed, const ReuseEffort& effort,
                               const SurfaceLinks& links, const RunControl& control)
    : ReuseEstimator(std::make_shared<const Tables>(world, seed, effort, links, control),
                     all_numbers<LabelId>(world.receivers.size()), seed) {}
ReuseEstimator::ReuseEstimator(std::shared_ptr<const Tables> tables, std::span<const LabelId> labels,
                               std::uint64_t seed)
    : tables_(std::move(tables)) {
  const World& world = tables_->world;
  const std::vector<std::uint32_t> columns = all_numbers(world.emitters.size());
  for (LabelCluster& cluster : cluster_labels(world, labels, largest_cluster)) {
    // The first label identifies a cluster.
    keys_.push_back(mix_key(seed, hash64(world.scene.labels[cluster.front()].id)));
    blocks_.push_back({std::move(cluster), columns});
  }
}
ReuseEstimator::~ReuseEstimator() = default;

std::size_t ReuseEstimator::items() const {
  return blocks_.size();
}
const Estimator::Block& ReuseEstimator::block(std::size_t item) const {
  return blocks_[item];
}
std::uint64_t ReuseEstimator::samples_per_batch() const {
  return tables_->effort.lookups + tables_->effort.points;
}
std::string ReuseEstimator::name() const {
  return fmt::format("reuse, {} + {} first rays per batch", tables_->effort.lookups, tables_->effort.points);
}
std::unique_ptr<Estimator> ReuseEstimator::part(std::span<const LabelId> labels, std::uint64_t seed,
                                                std::uint64_t) const {
  return std::unique_ptr<Estimator>(new ReuseEstimator(tables_, labels, seed));
}
std::unique_ptr<Estimator> ReuseEstimator::for_state(const World& changed, std::uint64_t seed) const {
  // The spread between the states of a shop is many times the noise of a single state.
  auto tables = std::make_shared<const Tables>(changed, seed, small_batches, *tables_);
  return std::unique_ptr<Estimator>(
      new ReuseEstimator(std::move(tables), all_numbers<LabelId>(changed.receivers.size()), seed));
}
std::size_t ReuseEstimator::bytes() const {
  return tables_->cache.bytes();
}

bool ReuseEstimator::sample(std::size_t item, std::uint32_t batch, const CancelToken* cancel,
                            BatchValues& values) const {
  const Block& block = blocks_[item];
  const std::uint64_t key = keys_[item];
  const World& world = tables_->world;
  Tables::Workspace& work = tables_->workspaces.local();
  while (work.labels.size() < block.rows.size()) work.labels.emplace_back(tables_->units.size());
  for (LaneRow& row : work.labels) row.clear();
  work.at.clear();
  for (std::size_t c = 0; c < block.rows.size(); ++c) {
    RandomStream random(key, batch, static_cast<std::uint32_t>(c), 0);
    const double u1 = random.uniform(), u2 = random.uniform();
    work.at.push_back(world.receivers.point(block.rows[c], u1, u2));
  }
  tables_->look_up(block, key, batch, work, values.rays);
  if (cancel != nullptr && cancel->requested()) return false;
  tables_->add_spots(block, key, batch, work, values.rays);
  tables_->add_residual(block, key, batch, work, values.rays);
  if (cancel != nullptr && cancel->requested()) return false;

  const std::size_t n = block.columns.size();
  for (std::size_t c = 0; c < block.rows.size(); ++c) {
    const std::uint32_t i = block.rows[c];
    LaneRow& row = work.labels[c];
    const bool has_areas = !world.receivers.is_point(i) || tables_->units.any_approximate() ||
                           world.emitters.size() > world.scene.transceivers.size();
    work.direct.assign(has_areas ? n : 0, 0);
    for (std::size_t j = 0; j < work.direct.size(); ++j) {
      if (is_point_to_point(world, i, j)) continue;
      const PathKey path{mix_key(mix_key(key, i), j), batch, 0};
      const double chance = tables_->direct_chance(i, j);
      if (to_uniform(path.draw(0, 1)[0]) >= chance) continue;
      const DirectSignal signal =
          sample_direct(world, i, j, path, tables_->needs_strata(i, j) ? 3 : 1, tables_->rules);
      values.rays += signal.rays;
      if (signal.straight + signal.mirrored == 0) continue;
      work.direct[j] = signal.straight / chance;
      row.add(tables_->units.lane_index(j), (signal.straight + signal.mirrored) / chance);
    }
    for (const std::uint16_t g : row.groups())
      for (std::size_t k = 0; k < tables_->units.count(g); ++k) {
        const float value = row.values()[g * lanes + k];
        if (value == 0) continue;
        const std::uint32_t j = tables_->units.column(g, k);
        values.values.push_back({static_cast<std::uint32_t>(c * n + j), static_cast<double>(value),
                                 has_areas ? work.direct[j] : 0});
      }
  }
  return true;
}

}  // namespace shelfbeam
