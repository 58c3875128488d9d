#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/cache/spot_light.hpp"
#include "shelfbeam/transport/cache/surface_guide.hpp"
#include "shelfbeam/transport/cache/unit_groups.hpp"
#include "shelfbeam/transport/cells/ray_targets.hpp"
#include "shelfbeam/transport/cells/surface_cells.hpp"

namespace shelfbeam::detail {

/// Direct light of the units at a cell, for the groups of units that give any; packed by PackedLane.
struct CellLight {
  std::vector<std::uint16_t> groups;  ///< ascending
  /// Share of UnitGroups::irradiance that arrives, by quadrant, `lanes` values per group.
  std::array<std::vector<std::uint8_t>, SurfaceCells::quadrants> share;
  std::vector<std::uint16_t> mean;  ///< irradiance over the whole cell, W/m^2, `lanes` values per group
  std::vector<SpotIrradiance> from_spots;
};

/// Traces shadow rays from one point in each quadrant of the cell, and from further points to the units on
/// which the earlier points disagree. Omits groups that cannot give `least` W/m^2. The mean takes irradiances
/// up to `caps`, by UnitGroups::lane_index.
CellLight straight_light(const World& world, const UnitGroups& units, const SurfaceCells& cells,
                         std::size_t cell, float least, std::span<const float> caps);

/// A cell (or a quadrant, by SurfaceCells::node) that sends light to another one.
struct CellLink {
  std::uint32_t cell;
  float weight;  ///< irradiance there per irradiance at `cell`
};

/// Rays of a Sobol sequence.
struct GatherRays {
  std::uint32_t first, count;
  std::uint64_t stream;

  GatherRays of_quadrant(std::size_t quadrant) const { return {first, count, mix_key(stream, quadrant)}; }
};

/// Finds the links to some points of a surface with rays from them; `guides` give the radiance per
/// irradiance, by material. Some more rays go to `targets`.
std::vector<CellLink> gather_links(const World& world, const SurfaceCells& cells,
                                   std::span<const SurfacePoint> points, bool by_quadrant,
                                   const std::vector<SurfaceGuide>& guides, const RayTargets& targets,
                                   const GatherRays& rays);

/// Links in ascending order, one for each cell.
std::vector<CellLink> merged(std::vector<CellLink> links);

}  // namespace shelfbeam::detail
