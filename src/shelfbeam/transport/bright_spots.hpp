#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/transport/unit_groups.hpp"

namespace shelfbeam {

/// Light of a unit on a surface, as a source of its own: the share above the unit's cap of what a ray from
/// the unit brings.
struct SpotLight {
  std::uint32_t place = 0;  ///< of the unit, UnitGroups::place
  SurfacePoint point;       ///< its normal on the side of the unit
  Frame frame;              ///< of the surface as its material has it
  Vec3 incoming;            ///< unit, to the unit, in `frame`
  MaterialId material;
  double power = 0;  ///< W, over the chance of being drawn

  /// W/sr towards a unit direction, cosine included.
  double intensity(const Scene& scene, const Vec3& direction) const;
};

/// The light of bright spots: on a wall or shelf beside a unit the irradiance is so high that few rays from
/// elsewhere find most of its light. It is split at a cap: labels' straight rays take what lies below,
/// rays from the unit the excess, e - cap, of which every label takes its part that sees the spot.
class BrightSpots {
 public:
  /// Finds the units that have such spots, and where their rays meet them, and sets their caps. A spot of a
  /// unit that seems to have none is left to the rays from elsewhere altogether.
  BrightSpots(const World& world, UnitGroups& units, std::uint64_t seed);

  std::size_t size() const { return spots_.size(); }

  /// Which units are asked for how many rays: those of which the mean of these points gets this irradiance,
  /// W/m^2, with one; with more the square of that, up to `most`; with less with a chance in proportion.
  struct Effort {
    double relevant;
    std::uint32_t most;
  };

  /// Draws lights for all that stands at some points; whatever the points, their expectation is the whole
  /// excess. `key` and `batch` identify the draw.
  void draw(std::span<const Vec3> points, const Effort& effort, std::uint64_t key, std::uint32_t batch,
            std::vector<SpotLight>& lights, std::uint64_t& rays) const;

 private:
  struct Spot {
    std::uint32_t unit;
    double flux;                  ///< in the excess, roughly, W
    std::vector<double> chances;  ///< of the strata of its rays, running sums
  };
  const World& world_;
  const UnitGroups& units_;
  std::vector<Spot> spots_;
};

}  // namespace shelfbeam
