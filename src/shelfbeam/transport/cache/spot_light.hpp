#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/material/material.hpp"
#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/transport/cache/surface_guide.hpp"
#include "shelfbeam/transport/cache/unit_groups.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Light of a unit on a surface, treated as a point source.
struct SpotLight {
  std::uint32_t lane_index = 0;  ///< UnitGroups::lane_index of the unit
  SurfacePoint point;            ///< with the normal on the side of the unit
  Frame frame;                   ///< Frame::of_surface, in which the material is evaluated
  Vec3 incoming;                 ///< unit length, towards the unit, in `frame`
  MaterialId material;
  double power = 0;   ///< of a ray from the unit, W, over its sampling probability
  double capped = 0;  ///< cap / e, below 1

  /// W/sr towards a unit-length direction, cosine included.
  double intensity(const Scene& scene, const Vec3& direction) const;
};

/// Irradiance from spots of a unit, W/m^2.
struct SpotIrradiance {
  std::uint32_t lane_index;
  float value;
};

/// The irradiance that spots give some points on average, by unit; `guides` by material. Spots of a unit are
/// adjacent. Points close to the unit look around instead of connecting to its spots, which are too near.
/// Omits spots of less than `threshold` W/m^2.
std::vector<SpotIrradiance> light_from_spots(const World& world, const UnitGroups& units,
                                             const std::vector<SurfaceGuide>& guides,
                                             std::span<const SurfacePoint> points,
                                             std::span<const SpotLight> spots, float threshold,
                                             std::uint64_t stream);

}  // namespace shelfbeam
