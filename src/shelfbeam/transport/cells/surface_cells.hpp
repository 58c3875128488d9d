#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/transport/cells/cell_division.hpp"
#include "shelfbeam/transport/cells/surface_walks.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam::detail {

/// The surfaces that random walks meet, divided into cells of half a metre and six facings, and further where
/// a wall runs through such a cell (CellDivision).
class SurfaceCells {
 public:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  /// Walks on the threads of the current arena; ends early when cancelled.
  SurfaceCells(const World& world, std::uint64_t seed, CellSearch search, const RunControl& control);

  /// The planes of a cell, which its first part has; further parts follow it.
  struct Division {
    std::uint32_t first = 0, planes = 0;
  };
  /// What defines the cells, for a file: points have six coordinates (position, normal) and a triangle.
  struct Parts {
    std::vector<std::uint64_t> keys, first;
    std::vector<double> coordinates;
    std::vector<std::uint32_t> triangles;
    std::vector<Division> divisions;
    std::vector<CellDivision::Plane> planes;

    /// Whether these are the parts of some cells, each with points, that no close unit divides.
    bool fit() const;
  };
  explicit SurfaceCells(Parts parts);
  Parts parts() const;
  /// The same cells without points, which `find_near` does not need.
  SurfaceCells without_points() const;

  std::size_t size() const { return keys_.size(); }
  /// Positions of the units close to surfaces, after a search for units.
  const std::vector<Vec3>& close_units() const { return close_units_; }
  /// Whether walks from units had to add cells.
  bool any_hidden() const { return any_hidden_; }
  /// Identifies a cell independently of the other cells.
  std::uint64_t key(std::size_t cell) const { return keys_[cell]; }
  static constexpr std::size_t max_points = 2;
  static constexpr std::size_t max_fine_points = 8;  ///< where a close unit has divided a cell
  /// Up to `max_points`, or `max_fine_points`, random points in each quadrant of a cell; the normals are on
  /// the side that walks met.
  std::span<const SurfacePoint> sample_points(std::size_t cell, std::size_t quadrant) const;
  std::span<const SurfacePoint> sample_points(std::size_t cell) const;

  static constexpr std::uint32_t quadrants = 4;
  /// Numbers the quadrants of all cells.
  static std::uint32_t node(std::uint32_t cell, std::uint32_t quadrant) {
    return quadrants * cell + quadrant;
  }

  /// The cell of a point, on the side of its normal, or a neighbour across the nearest borders if walks have
  /// not met this cell, most likely a sliver between the edge of a surface and the next cell; otherwise
  /// `nowhere`.
  std::uint32_t find_near(const SurfacePoint& point) const;

  std::size_t bytes() const;

 private:
  SurfaceCells() = default;
  void add_cell(std::uint64_t key, const CellDivision& division);
  void index_keys();
  std::uint32_t find_key(std::uint64_t key) const;
  std::uint32_t find_undivided(const SurfacePoint& point) const;

  bool any_hidden_ = false;
  std::vector<Vec3> close_units_;
  std::vector<std::uint64_t> keys_;
  std::vector<std::uint64_t> first_;  // index into sample_points_, by cell and quadrant
  std::vector<SurfacePoint> sample_points_;
  std::vector<Division> divisions_;  // by cell
  std::vector<CellDivision::Plane> planes_;
  std::vector<std::uint32_t> slots_;  // cells by the hash of their keys, open addressing
};

}  // namespace shelfbeam::detail
