#include "shelfbeam/transport/cells/surface_cells.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/transport/cells/cell_grid.hpp"

namespace shelfbeam::detail {

namespace {

std::size_t hash(std::uint64_t key) {
  return mix_key(key, 0x5EED);
}

// Identifies a further part of a cell.
std::uint64_t part_key(std::uint64_t cell, std::uint32_t part) {
  return mix_key(cell, part) | std::uint64_t{1} << 63;
}

}  // namespace

SurfaceCells::SurfaceCells(const World& world, std::uint64_t seed, CellSearch search,
                           const RunControl& control) {
  const FoundSurfaces found = find_surfaces(world, seed, search, control);
  const std::vector<FoundPoint>& all = found.points;
  any_hidden_ = found.any_hidden;
  for (const CloseUnit& unit : found.close_units) close_units_.push_back(unit.position);

  std::vector<std::size_t> begin;
  for (std::size_t f = 0; f < all.size(); ++f)
    if (f == 0 || all[f].key != all[f - 1].key) begin.push_back(f);
  begin.push_back(all.size());
  // A large shop has more points than memory should hold twice.
  constexpr std::size_t at_a_time = 8192;
  for (std::size_t start = 0; start + 1 < begin.size() && !control.cancelled(); start += at_a_time) {
    std::vector<std::optional<CellDivision>> divisions(std::min(at_a_time, begin.size() - 1 - start));
    parallel_for_ranges(divisions.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t d = first; d < last && !control.cancelled(); ++d) {
        const std::size_t k = start + d;
        std::vector<SurfacePoint> points;
        for (std::size_t f = begin[k]; f < begin[k + 1]; ++f) points.push_back(all[f].point);
        divisions[d].emplace(world, std::move(points), found.close_units, mix_key(seed, all[begin[k]].key));
      }
    });
    for (std::size_t d = 0; d < divisions.size() && divisions[d]; ++d)
      add_cell(all[begin[start + d]].key, *divisions[d]);
  }
  first_.push_back(sample_points_.size());
  index_keys();
}

// Adds the parts of a cell, each with its first points in every quadrant.
void SurfaceCells::add_cell(std::uint64_t key, const CellDivision& division) {
  const std::vector<CellDivision::Plane>& planes = division.planes();
  const std::size_t most = division.is_fine() ? max_fine_points : max_points;
  for (std::uint32_t part = 0; part < division.parts().size(); ++part) {
    keys_.push_back(part == 0 ? key : part_key(key, part));
    divisions_.push_back({static_cast<std::uint32_t>(planes_.size()),
                          static_cast<std::uint32_t>(part == 0 ? planes.size() : 0)});
    for (std::size_t q = 0; q < quadrants; ++q) {
      first_.push_back(sample_points_.size());
      for (const SurfacePoint& point : division.parts()[part])
        if (CellGrid::quadrant(point) == q && sample_points_.size() - first_.back() < most)
          sample_points_.push_back(point);
    }
  }
  planes_.insert(planes_.end(), planes.begin(), planes.end());
}

SurfaceCells::SurfaceCells(Parts parts)
    : keys_(std::move(parts.keys)),
      first_(std::move(parts.first)),
      divisions_(std::move(parts.divisions)),
      planes_(std::move(parts.planes)) {
  for (std::size_t k = 0; k < parts.triangles.size(); ++k) {
    const double* const c = parts.coordinates.data() + 6 * k;
    sample_points_.push_back({{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, parts.triangles[k]});
  }
  index_keys();
}

SurfaceCells::Parts SurfaceCells::parts() const {
  Parts parts{keys_, first_, {}, {}, divisions_, planes_};
  for (const SurfacePoint& point : sample_points_) {
    for (const Vec3& v : {point.position, point.normal})
      parts.coordinates.insert(parts.coordinates.end(), {v.x, v.y, v.z});
    parts.triangles.push_back(point.triangle);
  }
  return parts;
}

SurfaceCells SurfaceCells::without_points() const {
  SurfaceCells cells;
  cells.any_hidden_ = any_hidden_;
  cells.keys_ = keys_;
  cells.divisions_ = divisions_;
  cells.planes_ = planes_;
  cells.slots_ = slots_;
  return cells;
}

bool SurfaceCells::Parts::fit() const {
  if (first.size() != quadrants * keys.size() + 1 || first.back() != triangles.size() ||
      coordinates.size() != 6 * triangles.size() || !std::is_sorted(first.begin(), first.end()) ||
      divisions.size() != keys.size())
    return false;
  for (std::size_t cell = 0; cell < keys.size(); ++cell) {
    const std::uint64_t count = first[quadrants * (cell + 1)] - first[quadrants * cell];
    if (count == 0 || count > max_points * quadrants) return false;
    const auto& [begin, size] = divisions[cell];
    if (std::uint64_t{begin} + size > planes.size() || cell + size >= keys.size() ||
        !CellDivision::fit(std::span(planes).subspan(begin, size)))
      return false;
  }
  return true;
}

void SurfaceCells::index_keys() {
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
  const std::uint64_t* const first = first_.data() + quadrants * cell + quadrant;
  return std::span(sample_points_).subspan(first[0], first[1] - first[0]);
}

std::span<const SurfacePoint> SurfaceCells::sample_points(std::size_t cell) const {
  const std::uint64_t* const first = first_.data() + quadrants * cell;
  return std::span(sample_points_).subspan(first[0], first[quadrants] - first[0]);
}

std::uint32_t SurfaceCells::find_key(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(key) & mask;
  while (slots_[slot] != nowhere && keys_[slots_[slot]] != key) slot = (slot + 1) & mask;
  return slots_[slot];
}

std::uint32_t SurfaceCells::find_near(const SurfacePoint& point) const {
  const std::uint32_t cell = find_undivided(point);
  if (cell == nowhere || divisions_[cell].planes == 0) return cell;
  const Division& division = divisions_[cell];
  return cell + CellDivision::part(std::span(planes_).subspan(division.first, division.planes), point);
}

std::uint32_t SurfaceCells::find_undivided(const SurfacePoint& point) const {
  const Vec3 scaled = CellGrid::scaled(point.position);
  CellGrid::Cube at = CellGrid::cube(scaled);
  std::uint32_t cell = find_key(CellGrid::key(at, point.normal));
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
    cell = find_key(CellGrid::key(at, point.normal));
  }
  return cell;
}

std::size_t SurfaceCells::bytes() const {
  return keys_.size() * sizeof(keys_[0]) + divisions_.size() * sizeof(divisions_[0]) +
         planes_.size() * sizeof(planes_[0]) + slots_.size() * sizeof(slots_[0]) +
         sample_points_.size() * sizeof(sample_points_[0]) + first_.size() * sizeof(first_[0]);
}

}  // namespace shelfbeam::detail
