#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "shelfbeam/transport/operator/label_hits.hpp"
#include "shelfbeam/transport/operator/surface_field.hpp"
#include "shelfbeam/transport/reuse/bright_spots.hpp"

namespace shelfbeam {

/// The bright spots beside one unit (BrightSpots): its irradiance above a cap, as a few point sources on
/// surfaces, one for each quadrant of a cell that rays from the unit meet.
class UnitSpots {
 public:
  /// The unit is the only one of `probe`, which must outlive the spots.
  UnitSpots(const World& probe, const SurfaceNodes& nodes, std::uint64_t seed);

  /// Limit on the irradiance that remains for receivers' own rays, W/m^2.
  float cap() const { return cap_; }
  std::size_t size() const { return lights_.size(); }

  /// Irradiance of the quadrants of cells; empty without spots.
  std::vector<float> light(const SurfaceNodes& nodes, float requirement) const;
  /// Adds the light that reaches the labels of a cluster, by their order in it.
  void add_light(const LabelHits& hits, float requirement, float* sums) const;

 private:
  /// Quadrants that a light lights equally.
  struct Lit {
    std::uint32_t first, count;
    float irradiance;
  };
  std::vector<Lit> lit_by(const SpotLight& light, const SurfaceNodes& nodes, double least) const;

  const World& probe_;
  float cap_ = std::numeric_limits<float>::max();
  std::vector<SpotLight> lights_;
};

}  // namespace shelfbeam
