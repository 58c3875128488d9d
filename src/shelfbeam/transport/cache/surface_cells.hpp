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

/// The surfaces that random walks from the labels meet, divided into cells of half a metre and six facings.
/// Where a unit lights mostly other surfaces, as in a back room with one door, walks from this unit add
/// these.
class SurfaceCells {
 public:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  /// Walks on the threads of the current arena; ends early when cancelled. Without `from_units`, all walks
  /// start at labels.
  SurfaceCells(const World& world, std::uint64_t seed, bool from_units, const RunControl& control);

  std::size_t size() const { return keys_.size(); }
  /// Whether walks from units had to add cells.
  bool any_hidden() const { return any_hidden_; }
  /// Identifies a cell independently of the other cells.
  std::uint64_t key(std::size_t cell) const { return keys_[cell]; }
  static constexpr std::size_t max_points = 2;
  /// Up to `max_points` random points in each quadrant of a cell; the normals are on the side that walks met.
  std::span<const SurfacePoint> sample_points(std::size_t cell, std::size_t quadrant) const;
  std::span<const SurfacePoint> sample_points(std::size_t cell) const;

  /// The quarter of its cell that contains a point, along the two axes that the surface does not face.
  static constexpr std::size_t quadrants = 4;
  static std::size_t quadrant(const SurfacePoint& point);

  /// The cell of a point, on the side of its normal; `nowhere` if walks have not met it.
  std::uint32_t find(const SurfacePoint& point) const;
  /// The same, or a neighbour across the nearest borders if walks have not met this cell, most likely a
  /// sliver between the edge of a surface and the next cell.
  std::uint32_t find_near(const SurfacePoint& point) const;

  /// Frees the points, which `find` does not need.
  void free_points();

  std::size_t bytes() const;

 private:
  std::uint32_t find_key(std::uint64_t key) const;

  bool any_hidden_ = false;
  std::vector<std::uint64_t> keys_;
  std::vector<std::size_t> first_;  // index into places_, by cell and quadrant
  std::vector<SurfacePoint> sample_points_;
  std::vector<std::uint32_t> slots_;  // cells by the hash of their keys, open addressing
};

/// Direct light of the units at a cell, for the groups of units that give any; packed by PackedLane.
struct CellLight {
  std::vector<std::uint16_t> groups;  ///< ascending
  /// Share of UnitGroups::irradiance that arrives, by quadrant, `lanes` values per group.
  std::array<std::vector<std::uint8_t>, SurfaceCells::quadrants> share;
  std::vector<std::uint16_t> mean;  ///< irradiance over the whole cell, W/m^2, `lanes` values per group
};

/// Traces shadow rays from one point in each quadrant of the cell, and from a second point to the units on
/// which the first points disagree. Omits groups that cannot give `least` W/m^2.
CellLight straight_light(const World& world, const UnitGroups& units, const SurfaceCells& cells,
                         std::size_t cell, float least);

/// A cell that sends light to another cell.
struct CellLink {
  std::uint32_t cell;
  float weight;  ///< irradiance at the receiving cell per irradiance at `cell`
};

/// Finds the links to a cell with rays from its points; `guides` give the radiance per irradiance, by
/// material.
std::vector<CellLink> gather_links(const World& world, const SurfaceCells& cells, std::size_t cell,
                                   const std::vector<SurfaceGuide>& guides, std::uint64_t seed);

}  // namespace shelfbeam::detail
