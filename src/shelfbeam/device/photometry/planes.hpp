#pragma once

#include <vector>

#include "shelfbeam/device/direction_table.hpp"

namespace shelfbeam::detail {

/// One half-plane of a measured profile: its horizontal angle in degrees, and a value for each vertical
/// angle.
struct Plane {
  double phi;
  std::vector<double> values;
};

/// Appends the images of all planes, mirrored about the last: 0 to 90 becomes 0 to 180.
void unfold(std::vector<Plane>& planes);

/// Whether planes that begin at 0 go around the circle: to 360, or near enough that the next step would reach
/// it.
bool go_around(const std::vector<Plane>& planes);

/// Appends the plane at 360, which is that at 0, unless it is there.
void close(std::vector<Plane>& planes);

/// The table of planes that ascend around the full circle: from some angle below 360 to that angle plus 360.
/// A single plane is a profile symmetric about the axis. Where no plane lies at 0 it is interpolated.
DirectionTable table_of_planes(const std::vector<double>& theta_deg, std::vector<Plane> planes);

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
