#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/transport/cache/cell_light.hpp"
#include "shelfbeam/transport/cache/surface_guide.hpp"

namespace shelfbeam {

/// How the surfaces of a shop light each other, for any units: the cells, and for each cell the cells from
/// which it receives light.
class SurfaceLinks {
 public:
  struct Effort {
    std::uint32_t gather_rays = 64;  ///< per row
    std::uint32_t first_ray = 0;     ///< number of the first of these rays, which identifies them
    bool by_quadrant = false;        ///< whether the rows are the quadrants of cells (SurfaceCells::node)
  };

  /// Traces rays on the threads of the current arena. Throws Interrupted when cancelled.
  SurfaceLinks(const World& world, std::shared_ptr<const detail::SurfaceCells> cells, std::uint64_t seed,
               const Effort& effort, const RunControl& control);

  /// Without links, for those of a file (each_part).
  SurfaceLinks(const World& world, std::shared_ptr<const detail::SurfaceCells> cells);
  /// Calls use(vector) for everything that a file needs.
  template <class Links, class Use>
  static void each_part(Links& links, const Use& use) {
    use(links.first_);
    use(links.start_);
    use(links.links_);
  }
  /// The links between cells, from links between quadrants: their mean over the quadrants with links.
  static SurfaceLinks between_cells(std::span<const SurfaceLinks> of_quadrants);

  const std::shared_ptr<const detail::SurfaceCells>& cells() const { return cells_; }
  /// By material.
  const std::shared_ptr<const std::vector<SurfaceGuide>>& guides() const { return guides_; }
  std::size_t rows() const { return first_.size() - 1; }
  /// Calls use(cell or quadrant, weight) for the rows that light a row.
  template <class Use>
  void each_link(std::size_t row, const Use& use) const {
    std::uint32_t from = start_[row];
    for (std::uint32_t k = first_[row]; k < first_[row + 1]; ++k) {
      from += links_[k].step;
      use(from, static_cast<float>(links_[k].weight) * step_of_weights);
    }
  }
  /// The sum of weight x light.
  float sum(std::size_t row, const std::vector<float>& light) const {
    float result = 0;
    each_link(row, [&](std::uint32_t from, float weight) { result += weight * light[from]; });
    return result;
  }

  /// Whether the links are those of so many rows.
  bool fit(std::size_t rows) const;
  /// Without the cells.
  std::size_t bytes() const {
    return first_.size() * (sizeof(first_[0]) + sizeof(start_[0])) + links_.size() * sizeof(links_[0]);
  }

 private:
  /// The links of a row are in ascending order: a step leads from one to the next. Memory traffic takes most
  /// of the time of an iteration. Many weights are the same, so they need more digits than PackedLane keeps.
  struct Link {
    std::uint16_t step;
    std::uint16_t weight;  ///< in steps of weights
  };
  static constexpr float step_of_weights = 1.0F / 0xFFFF;
  SurfaceLinks(std::shared_ptr<const std::vector<SurfaceGuide>> guides,
               std::shared_ptr<const detail::SurfaceCells> cells);
  void add_rows(std::vector<std::vector<detail::CellLink>> rows);
  void add_row(std::span<const detail::CellLink> links);

  std::shared_ptr<const std::vector<SurfaceGuide>> guides_;
  std::shared_ptr<const detail::SurfaceCells> cells_;
  std::vector<std::uint32_t> first_{0};
  std::vector<std::uint32_t> start_;  // by row
  std::vector<Link> links_;
};

}  // namespace shelfbeam
