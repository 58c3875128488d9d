#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/transport/cache/lane_kernels.hpp"
#include "shelfbeam/transport/cache/surface_cells.hpp"

namespace shelfbeam {

/// A rough solution of the whole transport, fixed before the first batch, for every unit at once: surfaces in
/// cells of half a metre and six facings, each with the share of every unit's light that reaches it and the
/// irradiance over further bounces. It is the control variate of the reuse estimator: whatever it gives is
/// subtracted again where paths are sampled, so its errors cost variance and never bias.
class RadianceCache {
 public:
  /// Units that give less than `least` W/m^2 to a cell are left out of it, sixteen at a time.
  /// Throws Interrupted when cancelled.
  RadianceCache(const World& world, const UnitGroups& groups, float least, std::uint64_t seed,
                const RunControl& control = {});

  /// The groups that a cell holds, ascending, a row of lanes each.
  struct Row {
    const std::uint16_t* groups = nullptr;
    std::size_t count = 0;
    const std::uint8_t* share = nullptr;      ///< of UnitGroups::irradiance that arrives, packed
    const std::uint16_t* indirect = nullptr;  ///< irradiance over one or more further bounces, W/m^2, packed

    /// Fetches the row from memory while something else is done.
    void prefetch() const {
      constexpr std::size_t line = 64;
      for (std::size_t k = 0; k < count * lanes; k += line) __builtin_prefetch(share + k);
      for (std::size_t k = 0; k < count * lanes; k += line / 2) __builtin_prefetch(indirect + k);
    }
  };
  /// Of the cell around a point; empty where nothing is known. The point's normal is on the side meant.
  Row row(const SurfacePoint& point) const;

  const SurfaceGuide& guide(MaterialId material) const { return guides_[material.value]; }

  std::size_t cells() const { return cells_.size(); }
  /// How many units a cell holds, in the mean.
  double units_a_cell() const {
    return cells() > 0 ? static_cast<double>(entries()) / static_cast<double>(cells()) : 0;
  }
  std::size_t entries() const { return groups_.size() * lanes; }
  std::size_t bytes() const;

 private:
  void choose_groups(std::size_t n_groups, const std::vector<detail::CellLight>& light,
                     const std::vector<std::vector<detail::CellLink>>& links, float least,
                     const RunControl& control);
  void iterate(std::vector<detail::CellLight>& light, const std::vector<std::vector<detail::CellLink>>& links,
               const RunControl& control);

  std::vector<SurfaceGuide> guides_;  // by material
  detail::SurfaceCells cells_;
  std::vector<std::size_t> begin_;  // by cell: first of its groups
  std::vector<std::uint16_t> groups_;
  std::vector<std::uint8_t> share_;      // by cell, quadrant, group and lane
  std::vector<std::uint16_t> indirect_;  // `lanes` for each of groups_
};

}  // namespace shelfbeam
