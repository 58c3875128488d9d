#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/transport/cache/surface_links.hpp"
#include "shelfbeam/transport/operator/unit_beam.hpp"

namespace shelfbeam {

/// How the light of a unit reaches the points of a cell straight. Cells beyond its reach have no light at
/// all.
enum class CellSight : std::uint8_t { beyond, hidden, partial, open };

/// The irradiance that one unit gives the surfaces of a shop, W/m^2. Quadrants of cells are numbered by
/// SurfaceCells::node.
struct SurfaceField {
  std::vector<std::uint32_t> nodes;  ///< quadrants with points within reach of the unit; others are dark
  std::vector<float> straight;       ///< by quadrant; also over one plane mirror
  std::vector<float> mirrored;       ///< by cell: the part of this over mirrors; empty without mirrors
  std::vector<float> indirect;       ///< by quadrant: by one or more further bounces
  std::vector<float> strongest;      ///< by cell: at its points, without obstacles
  std::vector<CellSight> sight;      ///< by cell
  /// Mean irradiance that cells beyond the reach would get without obstacles, times their share of all cells.
  float omitted = 0;
  float flux_error = 0;  ///< standard error of all straight light, relative: cells have few points
};

/// The surfaces of a shop and the light between them, ready for any unit.
class SurfaceNodes {
 public:
  /// Sends two times `gather_rays` rays from each quadrant. Throws Interrupted when cancelled.
  SurfaceNodes(const World& world, std::uint64_t seed, std::uint32_t gather_rays, const RunControl& control);
  /// The same from the cells and links of a file.
  SurfaceNodes(std::shared_ptr<const detail::SurfaceCells> cells, std::array<SurfaceLinks, 2> halves);

  std::size_t size() const { return first_point_.size() - 1; }
  const detail::SurfaceCells& cells() const { return *cells_; }
  /// By material.
  const std::vector<SurfaceGuide>& guides() const { return *halves_.front().guides(); }
  /// The links between quadrants, in two halves from different rays.
  const std::array<SurfaceLinks, 2>& halves() const { return halves_; }
  const BeamPoints& points() const { return points_; }
  /// The first point of a quadrant; it has none if the next quadrant has the same.
  std::uint32_t first_point(std::size_t node) const { return first_point_[node]; }
  bool has_points(std::size_t node) const { return first_point_[node] < first_point_[node + 1]; }

  /// By cell: whether the next surface before it is closer than cells are wide. Its light then changes within
  /// the cell.
  std::vector<std::uint8_t> narrow_cells(const World& world) const;

  /// The straight light of a unit, by shadow rays to the points of cells: to more points where it is bright,
  /// measured by the requirement. `cap` limits the irradiance of every point. Cells farther away than
  /// `reach`, m, are omitted.
  SurfaceField light(const World& world, const UnitBeam& beam, float cap, float requirement,
                     double reach) const;

  /// By cell: the growth of light in two rounds between cells, after many rounds. It is at most the square of
  /// the spectral radius of the part of the shop around the cell.
  const std::vector<float>& growth() const { return growth_; }
  /// Chooses the rounds of `bounce` and `total_light`, which reach 0.2 % of the light where it grows so.
  void choose_rounds(double max_growth);

  /// Adds the further bounces of this light, and of further irradiance by a first bounce (by quadrant; may be
  /// empty).
  void bounce(std::span<const float> first_bounce, SurfaceField& field) const;

  /// The total light on all cells, given the straight part. A sample takes the links of each cell from one of
  /// the halves at random, so that samples spread like errors of the links; without one, the mean counts.
  std::vector<float> total_light(const std::vector<float>& straight,
                                 std::optional<std::uint64_t> sample) const;

  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t quadrants = detail::SurfaceCells::quadrants;

  SurfaceNodes(const std::shared_ptr<const detail::SurfaceCells>& cells, const World& world,
               std::uint64_t seed, std::uint32_t gather_rays, const RunControl& control);
  struct Flux {
    double sum = 0, variance = 0;  ///< of the irradiance of quadrants
  };
  Flux light_cells(std::span<const std::uint32_t> cells, const World& world, const UnitBeam& beam, float cap,
                   float requirement, SurfaceField& field) const;
  void add_images(std::span<const std::uint32_t> cells, const World& world, const UnitBeam& beam,
                  float requirement, SurfaceField& field) const;
  void find_growth();
  template <class Sum>
  std::vector<float> iterate(std::span<const std::uint32_t> cells, const std::vector<float>& source,
                             std::vector<float> light, const Sum& sum) const;
  void mean_of_cells(std::span<const std::uint32_t> cells, std::span<const float> by_node,
                     std::vector<float>& mean) const;
  void fill_unknown(std::size_t cell, std::vector<float>& by_node) const;

  std::shared_ptr<const detail::SurfaceCells> cells_;
  std::array<SurfaceLinks, 2> halves_;       // between quadrants,
  std::array<SurfaceLinks, 2> cell_halves_;  // and between cells
  BeamPoints points_;
  std::vector<std::uint32_t> first_point_;  // by quadrant
  std::vector<float> growth_;
  double squared_radius_ = 0;  // of eigenvalues of the links between cells
  int rounds_ = 1;
};

}  // namespace shelfbeam
