#include "shelfbeam/transport/radiance_cache.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/sobol.hpp"
#include "shelfbeam/transport/specular_chain.hpp"

namespace shelfbeam {

namespace {

constexpr double cell_size = 0.5;  // m
// Cells do not end where shelves and floors do, so that rounding does not throw points into the next.
constexpr double cell_shift = 0.1370;
constexpr std::size_t places_per_cell = 4;
constexpr std::uint32_t gather_rays = 64;  // a cell
constexpr int rounds = 6;
constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

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

std::uint64_t scattered(std::uint64_t key) {
  return mix_key(key, 0x5EED);
}

// A surface point that walks have met, and a random rank among those of its cell.
struct Found {
  std::uint64_t key;
  std::uint32_t rank;
  SurfacePoint point;

  bool operator<(const Found& other) const { return key != other.key ? key < other.key : rank < other.rank; }
};

template <class Body>
void in_parallel(std::size_t count, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k) body(k);
  });
}

// Walks from all labels that scatter like white paint; what they meet is what labels hear from.
std::vector<Found> explore(const World& world, std::uint64_t seed, std::atomic<std::uint64_t>& rays) {
  const std::size_t m = world.receivers.size();
  const auto walks =
      static_cast<std::uint32_t>(std::clamp<std::size_t>(100000 / std::max<std::size_t>(1, m), 8, 128));
  constexpr std::uint32_t bounces = 4;
  std::vector<std::vector<Found>> by_label(m);
  in_parallel(m, [&](std::size_t i) {
    std::uint64_t traced = 0;
    const std::uint64_t stream = mix_key(seed, hash64(world.scene.labels[i].id));
    for (std::uint32_t w = 0; w < walks; ++w) {
      RandomStream random(stream, w, 0, 0xCAC4E);
      const double u1 = random.unit(), u2 = random.unit();
      SurfacePoint from = world.receivers.point(i, u1, u2);
      const double u3 = random.unit(), u4 = random.unit();
      const auto first = sample(world.receivers.responsivity(i), u3, u4);
      if (!first) continue;
      Vec3 direction = world.receivers.frame(i).to_world(first->direction);
      for (std::uint32_t bounce = 0; bounce < bounces; ++bounce) {
        const auto end =
            follow_chain(world, from, direction, false, random, traced, [](std::size_t, double) {});
        if (!end) break;
        by_label[i].push_back({key_of(end->point), random.bits(), end->point});
        from = end->point;
        const double v1 = random.unit(), v2 = random.unit();
        direction = Frame::about(from.normal).to_world(sample_cosine_hemisphere(v1, v2));
      }
    }
    rays += traced;
  });
  std::vector<Found> all;
  for (std::vector<Found>& some : by_label) {
    all.insert(all.end(), some.begin(), some.end());
    std::vector<Found>().swap(some);
  }
  std::sort(all.begin(), all.end());
  return all;
}

struct Link {
  std::uint32_t cell;
  float weight;  // irradiance here per irradiance there
};

}  // namespace

RadianceCache::RadianceCache(const World& world, const UnitGroups& units, float least, std::uint64_t seed) {
  for (const NamedMaterial& named : world.scene.materials) {
    constexpr double cosine = 0.7071;
    const Vec3 from{std::sqrt(1 - cosine * cosine), 0, cosine};
    const double scattered_share =
        has_only_specular(named.material)
            ? 0
            : std::max(0.0, albedo(named.material, from) - specular_reflectance(named.material, from));
    factors_.push_back(static_cast<float>(scattered_share / pi));
  }

  std::atomic<std::uint64_t> rays{0};
  std::vector<Found> found = explore(world, seed, rays);
  std::vector<std::size_t> first;  // in `found`, by cell
  std::vector<std::uint64_t> keys;
  for (std::size_t f = 0; f < found.size(); ++f)
    if (f == 0 || found[f].key != found[f - 1].key) {
      first.push_back(f);
      keys.push_back(found[f].key);
    }
  const std::size_t count = keys.size();
  first.push_back(found.size());
  std::size_t slots = 16;
  while (slots < 3 * count) slots *= 2;
  slot_keys_.resize(slots);
  slot_cells_.assign(slots, nowhere);
  for (std::uint32_t p = 0; p < count; ++p) {
    std::size_t slot = scattered(keys[p]) & (slots - 1);
    while (slot_cells_[slot] != nowhere) slot = (slot + 1) & (slots - 1);
    slot_keys_[slot] = keys[p];
    slot_cells_[slot] = p;
  }

  // Direct light, and where light of one bounce more comes from.
  const std::size_t n_groups = units.size();
  struct Direct {
    std::vector<std::uint16_t> groups;
    std::vector<float> share, mean;
  };
  std::vector<Direct> direct(count);
  std::vector<std::vector<Link>> links(count);
  std::vector<float> largest(count * n_groups);  // of a group's lanes
  in_parallel(count, [&](std::size_t p) {
    std::uint64_t traced = 0;
    const std::size_t places = std::min(places_per_cell, first[p + 1] - first[p]);
    std::vector<float> open(n_groups * lanes), arrived(n_groups * lanes);
    std::vector<Vec3> targets;
    std::vector<std::size_t> which;
    std::vector<float> shares;
    std::vector<std::uint8_t> seen(n_groups * lanes), hidden(n_groups * lanes), tested(n_groups * lanes);
    for (std::size_t k = 0; k < places; ++k) {
      const SurfacePoint& at = found[first[p] + k].point;
      const LanePoint point(at);
      targets.clear();
      which.clear();
      for (std::size_t g = 0; g < n_groups; ++g) {
        if (units.bound(g, point) < least) continue;
        LaneValues e;
        units.irradiance(g, point, e);
        for (std::size_t lane = 0; lane < units.count(g); ++lane) {
          if (e[lane] < 0.1F * least) continue;
          // Where the first two places agree, the others need not be asked.
          const bool is_mixed = seen[g * lanes + lane] != 0 && hidden[g * lanes + lane] != 0;
          if (k >= 2 && !is_mixed) continue;
          ++tested[g * lanes + lane];
          open[g * lanes + lane] += e[lane];
          which.push_back(g * lanes + lane);
          targets.push_back(world.scene.transceivers[units.column(g, lane)].position);
        }
      }
      shares.resize(targets.size());
      world.rays.shares(at, targets, shares);
      traced += targets.size();
      for (std::size_t t = 0; t < targets.size(); ++t) {
        (shares[t] > 0 ? seen : hidden)[which[t]] = 1;
        if (shares[t] == 0) continue;
        const std::size_t g = which[t] / lanes;
        LaneValues e;
        units.irradiance(g, point, e);
        float value = e[which[t] % lanes];
        if (units.is_loose(g)) {  // its true profile
          const std::uint32_t j = units.column(g, which[t] % lanes);
          const Vec3 way = targets[t] - at.position;
          const double squared = length_squared(way), distance = std::sqrt(squared);
          const LightPoint light = world.emitters.point(j, 0.5, 0.5);
          value = static_cast<float>(world.emitters.intensity(j, light, way / -distance) *
                                     std::max(0.0, dot(at.normal, way)) / (squared * distance));
        }
        arrived[which[t]] += value * shares[t];
      }
    }
    Direct& own = direct[p];
    for (std::size_t g = 0; g < n_groups; ++g) {
      float most = 0;
      for (std::size_t lane = 0; lane < lanes; ++lane)
        most = std::max(
            most, arrived[g * lanes + lane] / static_cast<float>(std::max<int>(1, tested[g * lanes + lane])));
      largest[p * n_groups + g] = most;
      if (most == 0) continue;
      own.groups.push_back(static_cast<std::uint16_t>(g));
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const float in_open = open[g * lanes + lane], value = arrived[g * lanes + lane];
        own.share.push_back(in_open > 0 ? value / in_open : 0);
        own.mean.push_back(value / static_cast<float>(std::max<int>(1, tested[g * lanes + lane])));
      }
    }

    const ScrambledSobol square(mix_key(seed, keys[p]));
    std::vector<Link>& own_links = links[p];
    for (std::uint32_t r = 0; r < gather_rays; ++r) {
      const SurfacePoint& at = found[first[p] + r % places].point;
      const auto [u1, u2] = square.point(r);
      RandomStream random(mix_key(seed, keys[p]), r, 1, 0xCAC4E);
      const auto end =
          follow_chain(world, at, Frame::about(at.normal).to_world(sample_cosine_hemisphere(u1, u2)), false,
                       random, traced, [](std::size_t, double) {});
      if (!end) continue;
      const std::uint32_t cell = find(key_of(end->point));
      if (cell == nowhere) continue;
      own_links.push_back({cell, static_cast<float>(end->throughput * pi) * radiance_factor(end->material) /
                                     static_cast<float>(gather_rays)});
    }
    std::stable_sort(own_links.begin(), own_links.end(),
                     [](const Link& a, const Link& b) { return a.cell < b.cell; });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < own_links.size(); ++k) {
      if (kept > 0 && own_links[kept - 1].cell == own_links[k].cell)
        own_links[kept - 1].weight += own_links[k].weight;
      else
        own_links[kept++] = own_links[k];
    }
    own_links.resize(kept);
    own_links.shrink_to_fit();
    rays += traced;
  });
  found = {};

  // Which groups matter where: the same rounds as below with one number a group.
  std::vector<float> now = largest, next(largest.size());
  for (int round = 0; round < rounds; ++round) {
    in_parallel(count, [&](std::size_t p) {
      float* sum = next.data() + p * n_groups;
      std::copy_n(largest.data() + p * n_groups, n_groups, sum);
      for (const Link& link : links[p]) {
        const float* from = now.data() + link.cell * n_groups;
        for (std::size_t g = 0; g < n_groups; ++g) sum[g] += link.weight * from[g];
      }
    });
    now.swap(next);
  }
  begin_.push_back(0);
  for (std::size_t p = 0; p < count; ++p) {
    for (std::size_t g = 0; g < n_groups; ++g)
      if (now[p * n_groups + g] >= least) groups_.push_back(static_cast<std::uint16_t>(g));
    begin_.push_back(groups_.size());
  }
  now = {};
  next = {};
  largest = {};

  // Radiosity by Jacobi's rounds, all units at once: total irradiance from the direct one.
  share_.assign(groups_.size() * lanes, 0);
  std::vector<float> mean(groups_.size() * lanes);
  in_parallel(count, [&](std::size_t p) {
    const Direct& own = direct[p];
    for (std::size_t a = begin_[p], b = 0; a < begin_[p + 1]; ++a) {
      while (b < own.groups.size() && own.groups[b] < groups_[a]) ++b;
      if (b == own.groups.size() || own.groups[b] != groups_[a]) continue;
      for (std::size_t k = 0; k < lanes; ++k) {
        share_[a * lanes + k] = PackedLane::pack_share(own.share[b * lanes + k]);
        mean[a * lanes + k] = own.mean[b * lanes + k];
      }
    }
  });
  direct = {};
  std::vector<float> total = mean, fresh(mean.size());
  for (int round = 0; round < rounds; ++round) {
    in_parallel(count, [&](std::size_t p) {
      std::copy(mean.begin() + static_cast<std::ptrdiff_t>(begin_[p] * lanes),
                mean.begin() + static_cast<std::ptrdiff_t>(begin_[p + 1] * lanes),
                fresh.begin() + static_cast<std::ptrdiff_t>(begin_[p] * lanes));
      for (const Link& link : links[p]) {
        for (std::size_t a = begin_[p], b = begin_[link.cell];
             a < begin_[p + 1] && b < begin_[link.cell + 1];) {
          if (groups_[a] < groups_[b]) {
            ++a;
          } else if (groups_[b] < groups_[a]) {
            ++b;
          } else {
            std::size_t run = 1;  // most cells hold the same groups as their neighbours
            while (a + run < begin_[p + 1] && b + run < begin_[link.cell + 1] &&
                   groups_[a + run] == groups_[b + run])
              ++run;
            LaneKernels::add_rows(run, link.weight, total.data() + b * lanes, fresh.data() + a * lanes);
            a += run;
            b += run;
          }
        }
      }
    });
    total.swap(fresh);
  }
  indirect_.resize(total.size());
  for (std::size_t k = 0; k < total.size(); ++k) indirect_[k] = PackedLane::pack(total[k] - mean[k]);
  rays_ = rays;
}

std::uint32_t RadianceCache::find(std::uint64_t key) const {
  const std::size_t mask = slot_keys_.size() - 1;
  std::size_t slot = scattered(key) & mask;
  while (slot_cells_[slot] != nowhere && slot_keys_[slot] != key) slot = (slot + 1) & mask;
  return slot_cells_[slot];
}

RadianceCache::Row RadianceCache::row(const SurfacePoint& point) const {
  const Vec3 scaled = in_cells(point.position);
  Cell at = cell_of(scaled);
  std::uint32_t cell = find(key_of(at, point.normal));
  // The walks have missed this one, most likely a sliver between the edge of a surface and the next cell: a
  // neighbour across the nearest border is as good.
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
    cell = find(key_of(at, point.normal));
  }
  if (cell == nowhere) return {};
  const std::size_t begin = begin_[cell];
  return {groups_.data() + begin, begin_[cell + 1] - begin, share_.data() + begin * lanes,
          indirect_.data() + begin * lanes};
}

std::size_t RadianceCache::bytes() const {
  return slot_keys_.size() * 12 + begin_.size() * sizeof(begin_[0]) + groups_.size() * 2 + share_.size() +
         2 * indirect_.size();
}

}  // namespace shelfbeam
