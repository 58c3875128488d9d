#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/transport/cache/cell_light.hpp"
#include "shelfbeam/transport/cache/lane_kernels.hpp"
#include "shelfbeam/transport/cache/surface_links.hpp"

namespace shelfbeam {

/// A rough solution of the whole light transport for every unit at once, fixed before the first batch.
/// Surfaces are divided into cells of half a metre and six facings; each cell stores the share of every
/// unit's direct light that reaches it and the irradiance by further bounces. The cache is the control
/// variate of the reuse estimator: sampled paths estimate the difference to it, so its errors cost variance
/// and never bias.
class RadianceCache {
 public:
  /// A cell omits the groups whose units all give it less than `threshold` W/m^2. `spots` are the light above
  /// the caps of units (UnitGroups) that have some, adjacent by unit. Throws Interrupted when cancelled.
  RadianceCache(const World& world, const UnitGroups& groups, const SurfaceLinks& links, float threshold,
                std::span<const SpotLight> spots = {}, const RunControl& control = {});

  /// The groups in a cell, ascending, one row of lanes each.
  struct Row {
    const std::uint16_t* groups = nullptr;
    std::size_t count = 0;
    const std::uint8_t* share = nullptr;      ///< of UnitGroups::irradiance that arrives, packed
    const std::uint16_t* indirect = nullptr;  ///< irradiance by one or more further bounces, W/m^2, packed

    /// Starts to fetch the row from memory.
    void prefetch() const {
      constexpr std::size_t line = 64;
      for (std::size_t k = 0; k < count * lanes; k += line) __builtin_prefetch(share + k);
      for (std::size_t k = 0; k < count * lanes; k += line / 2) __builtin_prefetch(indirect + k);
    }
  };
  /// The row of the cell around a point, on the side of the point's normal; empty if there is no cell.
  Row row(const SurfacePoint& point) const;

  const SurfaceGuide& guide(MaterialId material) const { return (*guides_)[material.value]; }

  std::size_t cells() const { return cells_.size(); }
  /// Whether a unit shines mostly on surfaces that walks from the labels do not meet.
  bool any_hidden() const { return cells_.any_hidden(); }
  /// Mean number of units per cell.
  double units_per_cell() const {
    return cells() > 0 ? static_cast<double>(entries()) / static_cast<double>(cells()) : 0;
  }
  std::size_t entries() const { return groups_.size() * lanes; }
  std::size_t bytes() const;

 private:
  void choose_groups(std::size_t n_groups, const std::vector<detail::CellLight>& light,
                     const SurfaceLinks& links, float threshold, const RunControl& control);
  void iterate(std::vector<detail::CellLight>& light, const SurfaceLinks& links, const RunControl& control);

  std::shared_ptr<const std::vector<SurfaceGuide>> guides_;  // by material
  detail::SurfaceCells cells_;
  std::vector<std::size_t> begin_;  // by cell: index of its first group in groups_
  std::vector<std::uint16_t> groups_;
  std::vector<std::uint8_t> share_;      // by cell, quadrant, group and lane
  std::vector<std::uint16_t> indirect_;  // `lanes` values per element of groups_
};

}  // namespace shelfbeam
