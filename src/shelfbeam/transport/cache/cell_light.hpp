#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shelfbeam/transport/cache/surface_cells.hpp"
#include "shelfbeam/transport/cache/surface_guide.hpp"
#include "shelfbeam/transport/cache/unit_groups.hpp"

namespace shelfbeam::detail {

/// What comes straight from the units to a cell, for the groups of units of which anything does.
struct CellLight {
  std::vector<std::uint16_t> groups;  ///< ascending
  /// Of UnitGroups::irradiance, by quadrant, `lanes` for each group.
  std::array<std::vector<std::uint8_t>, SurfaceCells::quadrants> share;
  std::vector<std::uint16_t> mean;  ///< irradiance, W/m^2, likewise; all packed as PackedLane has it
};

/// Shadow rays from a place in each quadrant of the cell, and from a second to units on which these disagree.
/// Groups that cannot give `least` W/m^2 are not asked.
CellLight straight_light(const World& world, const UnitGroups& units, const SurfaceCells& cells,
                         std::size_t cell, float least);

/// A cell from which light comes to another.
struct CellLink {
  std::uint32_t cell;
  float weight;  ///< irradiance here for each W/m^2 of irradiance there
};

/// By rays from the places of a cell; `guides` tell the radiance per irradiance, by material.
std::vector<CellLink> gather_links(const World& world, const SurfaceCells& cells, std::size_t cell,
                                   const std::vector<SurfaceGuide>& guides, std::uint64_t seed);

}  // namespace shelfbeam::detail
