#include "shelfbeam/transport/cells/surface_walks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/cells/cell_grid.hpp"
#include "shelfbeam/transport/world/specular_chain.hpp"

namespace shelfbeam::detail {

namespace {

FoundPoint found_point(const SurfacePoint& point, RandomStream& random) {
  return {CellGrid::key(point), CellGrid::quadrant(point), random.bits(), point};
}

constexpr std::uint32_t bounces = 4;  // of a walk

struct Begin {
  SurfacePoint from;
  Vec3 direction;
};

// Walks of the given kind on surfaces that all scatter like white paint. `begin` draws their
// first ray from four random numbers.
template <class Draw>
std::vector<FoundPoint> explore(const World& world, std::uint64_t stream, std::uint32_t kind,
                                std::uint32_t walks, const Draw& begin) {
  std::vector<FoundPoint> found;
  std::uint64_t rays = 0;
  for (std::uint32_t w = 0; w < walks; ++w) {
    RandomStream random(stream, w, kind, 0xCAC4E);
    const double u1 = random.uniform(), u2 = random.uniform(), u3 = random.uniform(), u4 = random.uniform();
    const auto first = begin({u1, u2, u3, u4});
    if (!first) continue;
    auto [from, direction] = *first;
    for (std::uint32_t bounce = 0; bounce < bounces; ++bounce) {
      const auto end = follow_chain(world, from, direction, Departure::scattered, random, rays,
                                    [](std::size_t, double) {});
      if (!end) break;
      found.push_back(found_point(end->point, random));
      from = end->point;
      const double v1 = random.uniform(), v2 = random.uniform();
      direction = Frame::about(from.normal).to_world(sample_cosine_hemisphere(v1, v2));
    }
  }
  return found;
}

std::vector<FoundPoint> walks_from_label(const World& world, std::size_t i, std::uint32_t walks,
                                         std::uint64_t seed) {
  const auto begin = [&](const std::array<double, 4>& u) -> std::optional<Begin> {
    const auto first = sample(world.receivers.responsivity(i), u[2], u[3]);
    if (!first) return std::nullopt;
    return Begin{world.receivers.point(i, u[0], u[1]), world.receivers.frame(i).to_world(first->direction)};
  };
  return explore(world, mix_key(seed, hash64(world.scene.labels[i].id)), 0, walks, begin);
}

std::vector<FoundPoint> walks_from_unit(const World& world, std::size_t j, std::uint32_t walks,
                                        std::uint64_t seed) {
  const auto begin = [&](const std::array<double, 4>& u) -> std::optional<Begin> {
    const auto emitted = world.emitters.emit(j, u);
    if (!emitted) return std::nullopt;
    return Begin{{emitted->from.position, emitted->from.normal}, emitted->direction};
  };
  return explore(world, mix_key(seed, hash64(world.scene.transceivers[j].id)), 1, walks, begin);
}

// Calls walks(k) for k < count on all threads, and joins the points that it returns.
template <class Walks>
std::vector<FoundPoint> join(std::size_t count, const RunControl& control, const Walks& walks) {
  std::vector<std::vector<FoundPoint>> parts(count);
  parallel_for_ranges(count, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last && !control.cancelled(); ++k) parts[k] = walks(k);
  });
  std::vector<FoundPoint> all;
  for (std::vector<FoundPoint>& some : parts) {
    all.insert(all.end(), some.begin(), some.end());
    std::vector<FoundPoint>().swap(some);
  }
  return all;
}

// Adds points to sorted points.
void add_points(std::vector<FoundPoint>& all, std::vector<FoundPoint> others) {
  std::sort(others.begin(), others.end());
  const auto sorted = static_cast<std::ptrdiff_t>(all.size());
  all.insert(all.end(), others.begin(), others.end());
  std::inplace_merge(all.begin(), all.begin() + sorted, all.end());
}

// Removes the points in cells that contain one of the sorted points.
void remove_known(const std::vector<FoundPoint>& known, std::vector<FoundPoint>& points) {
  const auto by_key = [](const FoundPoint& a, const FoundPoint& b) { return a.key < b.key; };
  std::erase_if(points, [&](const FoundPoint& point) {
    return std::binary_search(known.begin(), known.end(), point, by_key);
  });
}

// Units with more than a third of their light, over the bounces of a walk, in cells without any of the sorted
// points.
std::vector<std::size_t> hidden_units(const World& world, const std::vector<FoundPoint>& known,
                                      std::uint64_t seed, const RunControl& control) {
  constexpr std::uint32_t walks = 64;
  std::vector<std::uint8_t> is_hidden(world.scene.transceivers.size());
  parallel_for_ranges(is_hidden.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last && !control.cancelled(); ++j) {
      std::vector<FoundPoint> points = walks_from_unit(world, j, walks, seed);
      const std::size_t all = points.size();
      remove_known(known, points);
      is_hidden[j] = 3 * points.size() > all ? 1 : 0;
    }
  });
  std::vector<std::size_t> hidden;
  for (std::size_t j = 0; j < is_hidden.size(); ++j)
    if (is_hidden[j] != 0) hidden.push_back(j);
  return hidden;
}

// Adds the points of walks from hidden units; false if there are none.
bool add_hidden(const World& world, std::vector<FoundPoint>& all, std::uint64_t seed,
                const RunControl& control) {
  const std::vector<std::size_t> hidden = hidden_units(world, all, seed, control);
  if (hidden.empty()) return false;
  const auto more =
      static_cast<std::uint32_t>(std::clamp<std::size_t>(all.size() / (bounces * hidden.size()), 64, 1024));
  std::vector<FoundPoint> others = join(
      hidden.size(), control, [&](std::size_t k) { return walks_from_unit(world, hidden[k], more, seed); });
  remove_known(all, others);
  add_points(all, std::move(others));
  return true;
}

// Blocks whose cells walks have met so often that only corners remain; sorted.
std::vector<std::uint64_t> explored_blocks(const std::vector<FoundPoint>& all) {
  constexpr std::size_t enough = 6;                            // points per cell
  std::vector<std::pair<std::uint64_t, std::uint64_t>> cells;  // block and key of every point
  cells.reserve(all.size());
  for (const FoundPoint& point : all) cells.emplace_back(CellGrid::block(point.key), point.key);
  std::sort(cells.begin(), cells.end());
  std::vector<std::uint64_t> explored;
  for (std::size_t first = 0, last = 0; first < cells.size(); first = last) {
    std::size_t distinct = 0;
    for (; last < cells.size() && cells[last].first == cells[first].first; ++last)
      if (last == first || cells[last] != cells[last - 1]) ++distinct;
    if (last - first >= enough * distinct) explored.push_back(cells[first].first);
  }
  return explored;
}

// Adds the points of walks from every cell that has been found, until these find few others. In explored
// blocks, only corners remain that labels hardly see.
void spread(const World& world, std::vector<FoundPoint>& all, std::uint64_t seed, const RunControl& control) {
  constexpr std::uint32_t first_walks = 2, walks = 8, most = 16;
  const std::vector<std::uint64_t> explored = explored_blocks(all);
  // A hall may be far larger than the part of it that has labels.
  const std::size_t enough = 3 * all.size();
  std::vector<FoundPoint> latest = all;
  for (std::uint32_t generation = 0;
       generation < most && 500 * latest.size() > all.size() && all.size() < enough; ++generation) {
    std::vector<std::size_t> starts;
    for (std::size_t f = 0; f < latest.size(); ++f)
      if (f == 0 || latest[f].key != latest[f - 1].key) starts.push_back(f);
    latest = join(starts.size(), control, [&](std::size_t k) {
      const FoundPoint& start = latest[starts[k]];
      const auto begin = [&](const std::array<double, 4>& u) {
        const Vec3 local = sample_cosine_hemisphere(u[2], u[3]);
        return std::optional(Begin{start.point, Frame::about(start.point.normal).to_world(local)});
      };
      return explore(world, mix_key(seed, start.key), 2 + generation, generation == 0 ? first_walks : walks,
                     begin);
    });
    std::erase_if(latest, [&](const FoundPoint& point) {
      return std::binary_search(explored.begin(), explored.end(), CellGrid::block(point.key));
    });
    remove_known(all, latest);
    std::sort(latest.begin(), latest.end());
    add_points(all, latest);
  }
}

// The surface that a unit lights so closely that the light changes within centimetres: at least 2 % of its
// rays end within a quarter of a metre.
std::optional<CloseUnit> close_unit(const World& world, std::size_t j, std::uint64_t seed) {
  constexpr std::uint32_t count = 256, enough = 6;
  constexpr double close = 0.25;  // m
  const Transceiver& unit = world.scene.transceivers[j];
  const ScrambledSobol square(mix_key(seed, hash64(unit.id)));
  std::uint32_t found = 0;
  std::optional<Hit> nearest;
  double min_squared = close * close;
  for (std::uint32_t r = 0; r < count; ++r) {
    const auto [u1, u2] = square.point(r);
    const auto emitted = world.emitters.emit(j, {u1, u2, 0.5, 0.5});
    if (!emitted) continue;
    const auto hit = world.rays.intersect({emitted->from.position, emitted->from.normal}, emitted->direction);
    if (!hit || is_pane(world.material(*hit))) continue;
    const double squared = length_squared(hit->point.position - emitted->from.position);
    if (squared < close * close) ++found;
    if (squared >= min_squared) continue;
    min_squared = squared;
    nearest = hit;
  }
  if (found < enough) return std::nullopt;
  return CloseUnit{unit.position, nearest->point.normal, dot(nearest->point.normal, nearest->point.position),
                   0};
}

// Finds the units close to surfaces, and adds the points of walks from them.
std::vector<CloseUnit> add_close_units(const World& world, std::vector<FoundPoint>& all, std::uint64_t seed,
                                       const RunControl& control) {
  constexpr std::uint32_t walks = 64;
  std::vector<std::optional<CloseUnit>> found(world.scene.transceivers.size());
  std::vector<FoundPoint> points = join(found.size(), control, [&](std::size_t j) {
    found[j] = close_unit(world, j, seed);
    return found[j] ? walks_from_unit(world, j, walks, mix_key(seed, 1)) : std::vector<FoundPoint>();
  });
  add_points(all, std::move(points));
  std::vector<CloseUnit> units;
  for (const auto& unit : found)
    if (unit) units.push_back(*unit);
  // Some hundred parts of cells for each of many units would take more time and memory than they save.
  constexpr double finest = 0.03, few = 16;  // finest in m
  const double coarser = std::sqrt(std::max(1.0, static_cast<double>(units.size()) / few));
  for (CloseUnit& unit : units) unit.finest = coarser * finest;
  return units;
}

// Adds points close to inner walls, on both sides: a wall divides the cells that it runs through, and walks
// may miss the smaller part of one.
void add_beside_walls(const World& world, std::vector<FoundPoint>& all, std::uint64_t seed) {
  if (!world.scene.room) return;
  constexpr double step = 0.12;                                      // m
  constexpr std::array<double, 4> distances{0.01, 0.05, 0.15, 0.3};  // m from the wall
  const std::uint64_t key = mix_key(seed, hash64("inner walls"));
  std::vector<FoundPoint> points;
  const auto look = [&](const Vec3& from, const Vec3& direction) {
    const auto hit = world.rays.intersect({from, direction}, direction);
    if (!hit) return;
    SurfacePoint point = hit->point;
    if (dot(point.normal, direction) > 0) point.normal = -point.normal;
    RandomStream random(key, static_cast<std::uint32_t>(points.size()), 0, 0xCAC4E);
    points.push_back(found_point(point, random));
  };
  for (const InnerWall& wall : world.scene.room->inner_walls) {
    const double length = wall.length(), top = wall.height.value_or(world.scene.upper.z);
    const Vec3 from{wall.from[0], wall.from[1], 0}, to{wall.to[0], wall.to[1], 0};
    const Vec3 along = (to - from) / length, across{-along.y, along.x, 0};
    for (const double distance : distances)
      for (const double side : {-1.0, 1.0}) {
        const Vec3 start = from + side * (wall.thickness / 2 + distance) * across;
        for (int k = 0; (k + 0.5) * step < length; ++k)
          for (const double up : {-1.0, 1.0})
            look(start + (k + 0.5) * step * along + Vec3{0, 0, top / 2}, {0, 0, up});
        for (int k = 0; (k + 0.5) * step < top; ++k)
          for (const double way : {-1.0, 1.0})
            look(start + length / 2 * along + Vec3{0, 0, (k + 0.5) * step}, way * along);
      }
  }
  add_points(all, std::move(points));
}

}  // namespace

FoundSurfaces find_surfaces(const World& world, std::uint64_t seed, CellSearch search,
                            const RunControl& control) {
  const std::size_t m = world.receivers.size();
  const auto walks =
      static_cast<std::uint32_t>(std::clamp<std::size_t>(100000 / std::max<std::size_t>(1, m), 8, 128));
  FoundSurfaces found;
  std::vector<FoundPoint>& all = found.points;
  all = join(m, control, [&](std::size_t i) { return walks_from_label(world, i, walks, seed); });
  std::sort(all.begin(), all.end());
  if (search == CellSearch::units) {
    found.any_hidden = add_hidden(world, all, seed, control);
    found.close_units = add_close_units(world, all, seed, control);
  }
  if (search == CellSearch::everywhere) spread(world, all, seed, control);
  add_beside_walls(world, all, seed);
  return found;
}

}  // namespace shelfbeam::detail
