#pragma once

#include <vector>

#include "shelfbeam/device/photometry/planes.hpp"

namespace shelfbeam::detail {

/// A profile of photometric type B, as an LM-63 file gives it: the planes of V turn about the horizontal axis
/// y, H is the angle within such a plane; both -90 to 90 degrees. V = 90 at H = 0 is +x, as horizontal angle
/// 0 of type C; H counts clockwise where the horizontal angle of type C counts counter-clockwise:
///   x = cos H sin V,  y = -sin H,  z = cos H cos V.
struct TypeB {
  std::vector<double> vertical;    ///< degrees, ascending from -90 to 90
  std::vector<Plane> horizontals;  ///< H and a value for each V; ascending from -90 to 90

  /// Linear in V and H between the points of the file; for directions with z >= 0.
  double value(const Vec3& direction) const;

  /// Steps in degrees of the table that `resampled` makes: 1, or 1/2 where the file has steps below 2.
  double step() const;

  /// The table through this profile at equal steps of theta and phi. Between its points it differs from
  /// `value` by what the interpolation bends within one step: an eighth of the squared step times the second
  /// derivative, and a quarter of the step times the change of slope at the kinks on the file's own grid.
  DirectionTable resampled() const;
};

}  // namespace shelfbeam::detail
