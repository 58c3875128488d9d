#include "shelfbeam/transport/cache/radiance_cache.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <tbb/enumerable_thread_specific.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/cells/cell_grid.hpp"
#include "shelfbeam/transport/cells/surface_cells.hpp"

namespace shelfbeam {

namespace {

// All further rounds of a Jacobi iteration as a geometric series: the factor by which the last increment is
// added once more, from the sums of light after the last three rounds.
float geometric_tail(const std::array<double, 3>& totals) {
  constexpr double max_ratio = 0.995;
  const double before = totals[1] - totals[0], last = totals[2] - totals[1];
  const double ratio = before > 0 ? std::clamp(last / before, 0.0, max_ratio) : 0;
  return static_cast<float>(ratio / (1 - ratio));
}

using detail::CellLight;

constexpr int rounds = 6;  // of Jacobi iteration

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

RadianceCache::RadianceCache(const World& world, const UnitGroups& units, const SurfaceLinks& links,
                             float threshold, std::span<const SpotLight> spots, const RunControl& control)
    : guides_(links.guides()), cells_(links.cells()->without_points()) {
  std::vector<float> caps(units.size() * lanes, std::numeric_limits<float>::max());
  for (const SpotLight& spot : spots)
    caps[spot.lane_index] = units.cap(spot.lane_index / lanes, spot.lane_index % lanes);
  std::vector<CellLight> light(cells_.size());
  for_cells(light.size(), control, [&](std::size_t cell) {
    light[cell] = detail::straight_light(world, units, *links.cells(), cell, threshold, caps);
    light[cell].from_spots = light_from_spots(world, units, *guides_, links.cells()->sample_points(cell),
                                              spots, threshold, links.cells()->key(cell));
  });
  control.report(Task::preparing, 0.5);
  choose_groups(units.size(), light, links, threshold, control);
  control.report(Task::preparing, 0.6);
  iterate(light, links, control);
}

// Chooses the groups of each cell by the rounds of `iterate` with one number per group, its brightest lane.
void RadianceCache::choose_groups(std::size_t n_groups, const std::vector<CellLight>& light,
                                  const SurfaceLinks& links, float threshold, const RunControl& control) {
  const std::size_t count = light.size();
  std::vector<float> straight(count * n_groups);
  for_cells(count, control, [&](std::size_t cell) {
    for (std::size_t c = 0; c < light[cell].groups.size(); ++c) {
      const auto* const mean = light[cell].mean.data() + c * lanes;
      straight[cell * n_groups + light[cell].groups[c]] =
          PackedLane::value(*std::max_element(mean, mean + lanes));
    }
    for (const auto& [lane_index, irradiance] : light[cell].from_spots)
      straight[cell * n_groups + lane_index / lanes] += irradiance;
  });
  std::vector<float> now = straight, next(straight.size());
  for (int round = 0; round < rounds; ++round) {
    for_cells(count, control, [&](std::size_t cell) {
      float* const sum = next.data() + cell * n_groups;
      std::copy_n(straight.data() + cell * n_groups, n_groups, sum);
      links.each_link(cell, [&](std::uint32_t other, float weight) {
        const float* const from = now.data() + other * n_groups;
        for (std::size_t g = 0; g < n_groups; ++g) sum[g] += weight * from[g];
      });
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
void RadianceCache::iterate(std::vector<CellLight>& light, const SurfaceLinks& links,
                            const RunControl& control) {
  const std::size_t count = light.size();
  share_.assign(detail::SurfaceCells::quadrants * groups_.size() * lanes, 0);
  std::vector<std::uint16_t> straight(groups_.size() * lanes), source(straight.size());
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
    std::copy_n(straight.data() + begin * lanes, width, source.data() + begin * lanes);
    for (const auto& [lane_index, irradiance] : own.from_spots) {
      const auto first = groups_.begin() + static_cast<std::ptrdiff_t>(begin),
                 last = first + static_cast<std::ptrdiff_t>(width / lanes);
      const auto group = std::lower_bound(first, last, lane_index / lanes);
      if (group == last || *group != lane_index / lanes) continue;
      std::uint16_t& value =
          source[static_cast<std::size_t>(group - groups_.begin()) * lanes + lane_index % lanes];
      value = PackedLane::pack(PackedLane::value(value) + irradiance);
    }
  });
  std::vector<std::uint16_t> whole = source, fresh(straight.size());
  std::vector<double> of_cell(count);
  std::array<double, 3> totals{};  // of the last three rounds
  tbb::enumerable_thread_specific<std::vector<float>> sums;
  for (int round = 0; round < rounds; ++round) {
    for_cells(count, control, [&](std::size_t cell) {
      const std::size_t begin = begin_[cell], end = begin_[cell + 1];
      std::vector<float>& sum = sums.local();
      sum.assign((end - begin) * lanes, 0);
      LaneKernels::add_packed(end - begin, 1, source.data() + begin * lanes, sum.data());
      links.each_link(cell, [&](std::uint32_t other, float weight) {
        const std::size_t end_there = begin_[other + 1];
        for (std::size_t a = begin, b = begin_[other]; a < end && b < end_there;) {
          if (groups_[a] != groups_[b]) {
            ++(groups_[a] < groups_[b] ? a : b);
            continue;
          }
          std::size_t run = 1;  // most cells have the same groups as the cells that they see
          while (a + run < end && b + run < end_there && groups_[a + run] == groups_[b + run]) ++run;
          LaneKernels::add_packed(run, weight, whole.data() + b * lanes, sum.data() + (a - begin) * lanes);
          a += run;
          b += run;
        }
      });
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
  const float further = geometric_tail(totals);
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
          share_.data() +
              (detail::SurfaceCells::quadrants * begin + detail::CellGrid::quadrant(point) * count) * lanes,
          indirect_.data() + begin * lanes};
}

std::size_t RadianceCache::bytes() const {
  return cells_.bytes() + begin_.size() * sizeof(begin_[0]) + groups_.size() * sizeof(groups_[0]) +
         share_.size() * sizeof(share_[0]) + indirect_.size() * sizeof(indirect_[0]);
}

}  // namespace shelfbeam
