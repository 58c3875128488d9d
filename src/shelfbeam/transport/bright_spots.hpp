#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/transport/lane_row.hpp"
#include "shelfbeam/transport/unit_groups.hpp"

namespace shelfbeam {

/// The light of bright spots: on a wall or shelf right beside a unit the irradiance is so high that few of a
/// label's rays find most of its light. It is split at a cap: labels' rays take what lies below, rays from
/// the unit the excess, e - cap, of which every label of a cluster that sees the spot takes its part.
class BrightSpots {
 public:
  /// Finds the units that have such spots, by some rays from each, and sets their caps. A spot that is missed
  /// here is left to the labels' rays altogether.
  BrightSpots(const World& world, UnitGroups& units, std::uint64_t seed);

  std::size_t size() const { return spots_.size(); }

  /// Adds what the excess of all spots, reflected once, gives the labels that stand at these points.
  /// `relevant` in W/m^2: units that can give less are played at a chance only.
  void add(std::span<const std::uint32_t> labels, std::span<const SurfacePoint> at, double relevant,
           std::uint32_t rays_per_unit, std::uint64_t key, std::uint32_t batch, std::span<LaneRow> rows,
           std::uint64_t& rays) const;

 private:
  struct Spot {
    std::uint32_t unit;
    double flux;  ///< in the excess, roughly, W
  };
  const World& world_;
  const UnitGroups& units_;
  std::vector<Spot> spots_;
};

}  // namespace shelfbeam
