#include "shelfbeam/transport/cache/surface_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/world/specular_chain.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double cell_size = 0.5;  // m
// Shifts the borders of cells off those of shelves and floors, so that rounding moves no points across them.
constexpr double cell_shift = 0.1370;

using Cell = std::array<std::int64_t, 3>;

Vec3 in_cells(const Vec3& p) {
  return {(p.x + cell_shift) / cell_size, (p.y + cell_shift) / cell_size, (p.z + cell_shift) / cell_size};
}

Cell cell_of(const Vec3& scaled) {
  return {static_cast<std::int64_t>(std::floor(scaled.x)), static_cast<std::int64_t>(std::floor(scaled.y)),
          static_cast<std::int64_t>(std::floor(scaled.z))};
}

std::uint64_t key_of(const Cell& cell, const Vec3& n) {
  const auto bits = [](std::int64_t c) { return static_cast<std::uint64_t>(c & 0xFFFFF); };
  const double ax = std::abs(n.x), ay = std::abs(n.y), az = std::abs(n.z);
  const std::uint64_t facing = az >= ax && az >= ay ? (n.z > 0 ? 0U : 1U)
                               : ax >= ay           ? (n.x > 0 ? 2U : 3U)
                                                    : (n.y > 0 ? 4U : 5U);
  return (bits(cell[0]) << 43) | (bits(cell[1]) << 23) | (bits(cell[2]) << 3) | facing;
}

std::uint64_t key_of(const SurfacePoint& point) {
  return key_of(cell_of(in_cells(point.position)), point.normal);
}

std::size_t hash(std::uint64_t key) {
  return mix_key(key, 0x5EED);
}

// A point that a walk has met, with a random rank among the points of its cell and quadrant.
struct Found {
  std::uint64_t key;
  std::uint32_t quadrant, rank;
  SurfacePoint point;

  bool operator<(const Found& other) const {
    return std::tie(key, quadrant, rank) < std::tie(other.key, other.quadrant, other.rank);
  }
};

constexpr std::uint32_t bounces = 4;  // of a walk

struct Begin {
  SurfacePoint from;
  Vec3 direction;
};

// Walks from a device, of the given kind, on surfaces that all scatter like white paint. `begin` draws their
// first ray from four random numbers.
template <class Draw>
std::vector<Found> explore(const World& world, const std::string& id, std::uint32_t kind, std::uint32_t walks,
                           std::uint64_t seed, const Draw& begin) {
  std::vector<Found> found;
  const std::uint64_t stream = mix_key(seed, hash64(id));
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
      found.push_back({key_of(end->point), static_cast<std::uint32_t>(SurfaceCells::quadrant(end->point)),
                       random.bits(), end->point});
      from = end->point;
      const double v1 = random.uniform(), v2 = random.uniform();
      direction = Frame::about(from.normal).to_world(sample_cosine_hemisphere(v1, v2));
    }
  }
  return found;
}

std::vector<Found> walks_from_label(const World& world, std::size_t i, std::uint32_t walks,
                                    std::uint64_t seed) {
  const auto begin = [&](const std::array<double, 4>& u) -> std::optional<Begin> {
    const auto first = sample(world.receivers.responsivity(i), u[2], u[3]);
    if (!first) return std::nullopt;
    return Begin{world.receivers.point(i, u[0], u[1]), world.receivers.frame(i).to_world(first->direction)};
  };
  return explore(world, world.scene.labels[i].id, 0, walks, seed, begin);
}

std::vector<Found> walks_from_unit(const World& world, std::size_t j, std::uint32_t walks,
                                   std::uint64_t seed) {
  const auto begin = [&](const std::array<double, 4>& u) -> std::optional<Begin> {
    const auto emitted = world.emitters.emit(j, u);
    if (!emitted) return std::nullopt;
    return Begin{{emitted->from.position, emitted->from.normal}, emitted->direction};
  };
  return explore(world, world.scene.transceivers[j].id, 1, walks, seed, begin);
}

// Calls walks(k) for k < count on all threads, and joins the points that it returns.
template <class Walks>
std::vector<Found> join(std::size_t count, const RunControl& control, const Walks& walks) {
  std::vector<std::vector<Found>> parts(count);
  parallel_for_ranges(count, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last && !control.cancelled(); ++k) parts[k] = walks(k);
  });
  std::vector<Found> all;
  for (std::vector<Found>& some : parts) {
    all.insert(all.end(), some.begin(), some.end());
    std::vector<Found>().swap(some);
  }
  return all;
}

// Removes the points in cells that contain one of the sorted points.
void remove_known(const std::vector<Found>& known, std::vector<Found>& points) {
  const auto by_key = [](const Found& a, const Found& b) { return a.key < b.key; };
  std::erase_if(points, [&](const Found& point) {
    return std::binary_search(known.begin(), known.end(), point, by_key);
  });
}

// Units with more than a third of their light, over the bounces of a walk, in cells without any of the sorted
// points.
std::vector<std::size_t> hidden_units(const World& world, const std::vector<Found>& known, std::uint64_t seed,
                                      const RunControl& control) {
  constexpr std::uint32_t walks = 64;
  std::vector<std::uint8_t> is_hidden(world.scene.transceivers.size());
  parallel_for_ranges(is_hidden.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last && !control.cancelled(); ++j) {
      std::vector<Found> points = walks_from_unit(world, j, walks, seed);
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

}  // namespace

SurfaceCells::SurfaceCells(const World& world, std::uint64_t seed, bool from_units,
                           const RunControl& control) {
  const std::size_t m = world.receivers.size();
  const auto walks =
      static_cast<std::uint32_t>(std::clamp<std::size_t>(100000 / std::max<std::size_t>(1, m), 8, 128));
  std::vector<Found> all =
      join(m, control, [&](std::size_t i) { return walks_from_label(world, i, walks, seed); });
  std::sort(all.begin(), all.end());
  const std::vector<std::size_t> hidden =
      from_units ? hidden_units(world, all, seed, control) : std::vector<std::size_t>{};
  any_hidden_ = !hidden.empty();
  if (any_hidden_) {
    const auto more =
        static_cast<std::uint32_t>(std::clamp<std::size_t>(all.size() / (bounces * hidden.size()), 64, 1024));
    std::vector<Found> others = join(
        hidden.size(), control, [&](std::size_t k) { return walks_from_unit(world, hidden[k], more, seed); });
    remove_known(all, others);
    all.insert(all.end(), others.begin(), others.end());
    std::sort(all.begin(), all.end());
  }

  for (std::size_t f = 0; f < all.size(); ++f) {
    if (f == 0 || all[f].key != all[f - 1].key) {
      keys_.push_back(all[f].key);
      first_.resize(quadrants * keys_.size(), sample_points_.size());
    }
    std::size_t* const first = first_.data() + quadrants * (keys_.size() - 1);
    if (sample_points_.size() - first[all[f].quadrant] >= max_points) continue;
    sample_points_.push_back(all[f].point);
    for (std::size_t q = all[f].quadrant + 1; q < quadrants; ++q) first[q] = sample_points_.size();
  }
  first_.push_back(sample_points_.size());
  std::size_t slots = 16;
  while (slots < 3 * keys_.size()) slots *= 2;
  slots_.assign(slots, nowhere);
  for (std::uint32_t cell = 0; cell < keys_.size(); ++cell) {
    std::size_t slot = hash(keys_[cell]) & (slots - 1);
    while (slots_[slot] != nowhere) slot = (slot + 1) & (slots - 1);
    slots_[slot] = cell;
  }
}

std::span<const SurfacePoint> SurfaceCells::sample_points(std::size_t cell, std::size_t quadrant) const {
  const std::size_t* const first = first_.data() + quadrants * cell + quadrant;
  return std::span(sample_points_).subspan(first[0], first[1] - first[0]);
}

std::span<const SurfacePoint> SurfaceCells::sample_points(std::size_t cell) const {
  const std::size_t* const first = first_.data() + quadrants * cell;
  return std::span(sample_points_).subspan(first[0], first[quadrants] - first[0]);
}

std::size_t SurfaceCells::quadrant(const SurfacePoint& point) {
  const Vec3 scaled = in_cells(point.position), &n = point.normal;
  const double ax = std::abs(n.x), ay = std::abs(n.y), az = std::abs(n.z);
  const auto upper = [](double c) { return c - std::floor(c) < 0.5 ? std::size_t{0} : std::size_t{1}; };
  if (az >= ax && az >= ay) return 2 * upper(scaled.x) + upper(scaled.y);
  return 2 * upper(ax >= ay ? scaled.y : scaled.x) + upper(scaled.z);
}

void SurfaceCells::free_points() {
  std::vector<SurfacePoint>().swap(sample_points_);
  std::vector<std::size_t>().swap(first_);
}

std::uint32_t SurfaceCells::find_key(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(key) & mask;
  while (slots_[slot] != nowhere && keys_[slots_[slot]] != key) slot = (slot + 1) & mask;
  return slots_[slot];
}

std::uint32_t SurfaceCells::find(const SurfacePoint& point) const {
  return find_key(key_of(point));
}

std::uint32_t SurfaceCells::find_near(const SurfacePoint& point) const {
  const Vec3 scaled = in_cells(point.position);
  Cell at = cell_of(scaled);
  std::uint32_t cell = find_key(key_of(at, point.normal));
  for (int tries = 0; tries < 2 && cell == nowhere; ++tries) {
    double least = 1;
    int nearest = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const double within = scaled[axis] - static_cast<double>(at[static_cast<std::size_t>(axis)]);
      const double border = std::min(within, 1 - within);
      if (within >= 0 && within < 1 && border < least && std::abs(point.normal[axis]) < 0.5) {
        least = border;
        nearest = axis;
      }
    }
    if (nearest < 0) break;
    const auto axis = static_cast<std::size_t>(nearest);
    at[axis] += scaled[nearest] - static_cast<double>(at[axis]) < 0.5 ? -1 : 1;
    cell = find_key(key_of(at, point.normal));
  }
  return cell;
}

std::size_t SurfaceCells::bytes() const {
  return keys_.size() * sizeof(keys_[0]) + slots_.size() * sizeof(slots_[0]) +
         sample_points_.size() * sizeof(sample_points_[0]) + first_.size() * sizeof(first_[0]);
}

}  // namespace shelfbeam::detail
