#include "shelfbeam/transport/cache/radiance_cache.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <tbb/enumerable_thread_specific.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/cache/surface_cells.hpp"

namespace shelfbeam {

namespace {

using detail::CellLight;
using detail::CellLink;

constexpr int rounds = 6;  // of Jacobi iteration
constexpr double max_ratio = 0.995;

std::vector<SurfaceGuide> surface_guides(const Scene& scene) {
  std::vector<SurfaceGuide> guides;
  for (const NamedMaterial& named : scene.materials) guides.emplace_back(named.material);
  return guides;
}

// Calls body(cell) for all cells, on all threads.
template <class Body>
void for_cells(std::size_t count, const RunControl& control, const Body& body) {
  parallel_for_ranges(count, [&](std::size_t first, std::size_t last) {
    for (std::size_t cell = first; cell < last && !control.cancelled(); ++cell) body(cell);
  });
  if (control.cancelled())
    throw Interrupted("the simulation was stopped before it completed two batches of samples");
}

}  // namespace

RadianceCache::RadianceCache(const World& world, const UnitGroups& units, float threshold, std::uint64_t seed,
                             const RunControl& control, bool from_units)
    : guides_(surface_guides(world.scene)), cells_(world, seed, from_units, control) {
  control.report(Task::preparing, 0.1);
  const std::size_t count = cells_.size();
  std::vector<CellLight> light(count);
  std::vector<std::vector<CellLink>> links(count);
  for_cells(count, control, [&](std::size_t cell) {
    light[cell] = detail::straight_light(world, units, cells_, cell, threshold);
    links[cell] = detail::gather_links(world, cells_, cell, guides_, seed);
  });
  cells_.free_points();
  control.report(Task::preparing, 0.5);
  choose_groups(units.size(), light, links, threshold, control);
  control.report(Task::preparing, 0.6);
  iterate(light, links, control);
}

// Chooses the groups of each cell by the rounds of `iterate` with one number per group, its brightest lane.
void RadianceCache::choose_groups(std::size_t n_groups, const std::vector<CellLight>& light,
                                  const std::vector<std::vector<CellLink>>& links, float threshold,
                                  const RunControl& control) {
  const std::size_t count = light.size();
  std::vector<float> straight(count * n_groups);
  for_cells(count, control, [&](std::size_t cell) {
    for (std::size_t c = 0; c < light[cell].groups.size(); ++c) {
      const auto* const mean = light[cell].mean.data() + c * lanes;
      straight[cell * n_groups + light[cell].groups[c]] =
          PackedLane::value(*std::max_element(mean, mean + lanes));
    }
  });
  std::vector<float> now = straight, next(straight.size());
  for (int round = 0; round < rounds; ++round) {
    for_cells(count, control, [&](std::size_t cell) {
      float* const sum = next.data() + cell * n_groups;
      std::copy_n(straight.data() + cell * n_groups, n_groups, sum);
      for (const CellLink& link : links[cell]) {
        const float* const from = now.data() + link.cell * n_groups;
        for (std::size_t g = 0; g < n_groups; ++g) sum[g] += link.weight * from[g];
      }
    });
    now.swap(next);
  }
  begin_.push_back(0);
  for (std::size_t cell = 0; cell < count; ++cell) {
    for (std::size_t g = 0; g < n_groups; ++g)
      if (now[cell * n_groups + g] >= threshold) groups_.push_back(static_cast<std::uint16_t>(g));
    begin_.push_back(groups_.size());
  }
}

// Radiosity by Jacobi iteration for all units at once: computes the total irradiance from the direct one.
// Frees the `light` of each cell after copying it, because a large store has a gigabyte of it.
void RadianceCache::iterate(std::vector<CellLight>& light, const std::vector<std::vector<CellLink>>& links,
                            const RunControl& control) {
  const std::size_t count = light.size();
  share_.assign(detail::SurfaceCells::quadrants * groups_.size() * lanes, 0);
  std::vector<std::uint16_t> straight(groups_.size() * lanes);
  for_cells(count, control, [&](std::size_t cell) {
    const CellLight own = std::move(light[cell]);
    const std::size_t begin = begin_[cell], width = (begin_[cell + 1] - begin) * lanes;
    std::uint8_t* const share = share_.data() + detail::SurfaceCells::quadrants * begin * lanes;
    for (std::size_t a = begin, b = 0; a < begin_[cell + 1]; ++a) {
      while (b < own.groups.size() && own.groups[b] < groups_[a]) ++b;
      if (b == own.groups.size() || own.groups[b] != groups_[a]) continue;
      std::copy_n(own.mean.data() + b * lanes, lanes, straight.data() + a * lanes);
      for (std::size_t q = 0; q < detail::SurfaceCells::quadrants; ++q)
        std::copy_n(own.share[q].data() + b * lanes, lanes, share + q * width + (a - begin) * lanes);
    }
  });
  std::vector<std::uint16_t> whole = straight, fresh(straight.size());
  std::vector<double> of_cell(count);
  std::array<double, 3> totals{};  // of the last three rounds
  tbb::enumerable_thread_specific<std::vector<float>> sums;
  for (int round = 0; round < rounds; ++round) {
    for_cells(count, control, [&](std::size_t cell) {
      const std::size_t begin = begin_[cell], end = begin_[cell + 1];
      std::vector<float>& sum = sums.local();
      sum.assign((end - begin) * lanes, 0);
      LaneKernels::add_packed(end - begin, 1, straight.data() + begin * lanes, sum.data());
      for (const CellLink& link : links[cell]) {
        const std::size_t end_there = begin_[link.cell + 1];
        for (std::size_t a = begin, b = begin_[link.cell]; a < end && b < end_there;) {
          if (groups_[a] != groups_[b]) {
            ++(groups_[a] < groups_[b] ? a : b);
            continue;
          }
          std::size_t run = 1;  // most cells have the same groups as the cells that they see
          while (a + run < end && b + run < end_there && groups_[a + run] == groups_[b + run]) ++run;
          LaneKernels::add_packed(run, link.weight, whole.data() + b * lanes,
                                  sum.data() + (a - begin) * lanes);
          a += run;
          b += run;
        }
      }
      of_cell[cell] = 0;
      for (std::size_t k = 0; k < sum.size(); ++k) {
        fresh[begin * lanes + k] = PackedLane::pack(sum[k]);
        of_cell[cell] += static_cast<double>(sum[k]);
      }
    });
    whole.swap(fresh);
    totals = {totals[1], totals[2], std::accumulate(of_cell.begin(), of_cell.end(), 0.0)};
    control.report(Task::preparing, 0.6 + 0.4 * (round + 1) / rounds);
  }
  // Further rounds as a geometric series, with the ratio of the last two increments.
  const double before = totals[1] - totals[0], last = totals[2] - totals[1];
  const double ratio = before > 0 ? std::clamp(last / before, 0.0, max_ratio) : 0;
  const auto further = static_cast<float>(ratio / (1 - ratio));
  indirect_ = std::move(whole);
  for (std::size_t k = 0; k < indirect_.size(); ++k) {
    const float now = PackedLane::value(indirect_[k]);
    const float tail = further * std::max(0.0F, now - PackedLane::value(fresh[k]));
    indirect_[k] = PackedLane::pack(std::max(0.0F, now + tail - PackedLane::value(straight[k])));
  }
}

RadianceCache::Row RadianceCache::row(const SurfacePoint& point) const {
  const std::uint32_t cell = cells_.find_near(point);
  if (cell == detail::SurfaceCells::nowhere) return {};
  const std::size_t begin = begin_[cell], count = begin_[cell + 1] - begin;
  return {groups_.data() + begin, count,
          share_.data() + (detail::SurfaceCells::quadrants * begin + cells_.quadrant(point) * count) * lanes,
          indirect_.data() + begin * lanes};
}

std::size_t RadianceCache::bytes() const {
  return cells_.bytes() + begin_.size() * sizeof(begin_[0]) + groups_.size() * sizeof(groups_[0]) +
         share_.size() * sizeof(share_[0]) + indirect_.size() * sizeof(indirect_[0]);
}

}  // namespace shelfbeam
