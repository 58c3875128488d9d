#include "shelfbeam/transport/cache/surface_links.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/random.hpp"

namespace shelfbeam {

namespace {

auto surface_guides(const Scene& scene) {
  auto guides = std::make_shared<std::vector<SurfaceGuide>>();
  for (const NamedMaterial& named : scene.materials) guides->emplace_back(named.material);
  return guides;
}

}  // namespace

SurfaceLinks::SurfaceLinks(const World& world, std::shared_ptr<const detail::SurfaceCells> cells,
                           std::uint64_t seed, const Effort& effort, const RunControl& control)
    : guides_(surface_guides(world.scene)), cells_(std::move(cells)) {
  const std::size_t quadrants = detail::SurfaceCells::quadrants;
  RayTargets targets(world.scene);
  for (const Vec3& unit : cells_->close_units()) targets.add_unit(unit);
  std::vector<std::vector<detail::CellLink>> links(cells_->size() * (effort.by_quadrant ? quadrants : 1));
  parallel_for_ranges(links.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last && !control.cancelled(); ++row) {
      const std::size_t cell = effort.by_quadrant ? row / quadrants : row;
      const auto points =
          effort.by_quadrant ? cells_->sample_points(cell, row % quadrants) : cells_->sample_points(cell);
      const detail::GatherRays rays{effort.first_ray, effort.gather_rays, mix_key(seed, cells_->key(cell))};
      links[row] = detail::gather_links(world, *cells_, points, effort.by_quadrant, *guides_, targets,
                                        effort.by_quadrant ? rays.of_quadrant(row % quadrants) : rays);
    }
  });
  if (control.cancelled()) throw Interrupted("stopped before the light between the surfaces was known");
  add_rows(std::move(links));
}

SurfaceLinks::SurfaceLinks(const World& world, std::shared_ptr<const detail::SurfaceCells> cells)
    : SurfaceLinks(surface_guides(world.scene), std::move(cells)) {}

SurfaceLinks::SurfaceLinks(std::shared_ptr<const std::vector<SurfaceGuide>> guides,
                           std::shared_ptr<const detail::SurfaceCells> cells)
    : guides_(std::move(guides)), cells_(std::move(cells)) {}

bool SurfaceLinks::fit(std::size_t rows) const {
  if (first_.size() != rows + 1 || start_.size() != rows || first_.front() != 0 ||
      first_.back() != links_.size() || !std::is_sorted(first_.begin(), first_.end()))
    return false;
  bool all_fit = true;
  for (std::size_t row = 0; row < rows; ++row)
    each_link(row, [&](std::uint32_t from, float) { all_fit = all_fit && from < rows; });
  return all_fit;
}

SurfaceLinks SurfaceLinks::between_cells(std::span<const SurfaceLinks> of_quadrants) {
  constexpr std::uint32_t quadrants = detail::SurfaceCells::quadrants;
  SurfaceLinks result(of_quadrants.front().guides_, of_quadrants.front().cells_);
  std::vector<std::vector<detail::CellLink>> links(result.cells_->size());
  parallel_for_ranges(links.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t cell = first; cell < last; ++cell) {
      std::vector<detail::CellLink> all;
      float known = 0;
      for (std::size_t q = 0; q < quadrants; ++q) {
        if (result.cells_->sample_points(cell, q).empty()) continue;
        ++known;
        for (const SurfaceLinks& some : of_quadrants)
          some.each_link(quadrants * cell + q, [&](std::uint32_t from, float weight) {
            all.push_back({from / quadrants, weight});
          });
      }
      links[cell] = detail::merged(std::move(all));
      for (detail::CellLink& link : links[cell])
        link.weight /= known * static_cast<float>(of_quadrants.size());
    }
  });
  result.add_rows(std::move(links));
  return result;
}

void SurfaceLinks::add_rows(std::vector<std::vector<detail::CellLink>> rows) {
  for (std::vector<detail::CellLink>& row : rows) {
    add_row(row);
    std::vector<detail::CellLink>().swap(row);
  }
  links_.shrink_to_fit();
}

void SurfaceLinks::add_row(std::span<const detail::CellLink> links) {
  constexpr std::uint32_t max_step = 0xFFFF;
  std::uint32_t at = links.empty() ? 0 : links.front().cell;
  start_.push_back(at);
  for (const detail::CellLink& link : links) {
    for (; link.cell - at > max_step; at += max_step) links_.push_back({max_step, 0});
    const float steps = std::min(1.0F, link.weight) / step_of_weights;
    links_.push_back(
        {static_cast<std::uint16_t>(link.cell - at), static_cast<std::uint16_t>(std::lround(steps))});
    at = link.cell;
  }
  first_.push_back(static_cast<std::uint32_t>(links_.size()));
}

}  // namespace shelfbeam
