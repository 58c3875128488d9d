#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/transport/cache/surface_guide.hpp"
#include "shelfbeam/transport/cache/unit_groups.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam::detail {

/// The surfaces that labels hear from, cut into cells of half a metre and six facings: those that random
/// walks from the labels have met.
class SurfaceCells {
 public:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  /// Walks on the threads of the present arena; ends early when cancelled.
  SurfaceCells(const World& world, std::uint64_t seed, const RunControl& control);

  std::size_t size() const { return keys_.size(); }
  /// What a cell is known by, whatever the other cells are.
  std::uint64_t key(std::size_t cell) const { return keys_[cell]; }
  static constexpr std::size_t most_places = 2;
  /// Up to so many points of each quadrant of a cell, at random; the normals are on the side that was met.
  std::span<const SurfacePoint> places(std::size_t cell, std::size_t quadrant) const;
  std::span<const SurfacePoint> places(std::size_t cell) const;

  /// Which quarter of its cell a point lies in, along the two axes that it does not face.
  static constexpr std::size_t quadrants = 4;
  static std::size_t quadrant(const SurfacePoint& point);

  /// The cell of a point, by the side of its normal.
  std::uint32_t find(const SurfacePoint& point) const;
  /// The same, or where the walks have missed that (most likely a sliver between the edge of a surface and
  /// the next cell) a neighbour across the nearest borders.
  std::uint32_t find_near(const SurfacePoint& point) const;

  /// Frees the places: `find` needs none.
  void forget_places();

  std::size_t bytes() const;

 private:
  std::uint32_t find_key(std::uint64_t key) const;

  std::vector<std::uint64_t> keys_;
  std::vector<std::size_t> first_;  // of the places, by cell and quadrant
  std::vector<SurfacePoint> places_;
  std::vector<std::uint32_t> slots_;  // cells, by the hash of their keys: open addressing
};

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
