#pragma once

#include <vector>

#include "shelfbeam/device/direction_table.hpp"

namespace shelfbeam::detail {

/// A half-plane of a measured profile: its horizontal angle in degrees and a value for each vertical angle.
struct Plane {
  double phi;
  std::vector<double> values;
};

/// Appends the mirror images of all planes about the last: 0 to 90 becomes 0 to 180.
void unfold(std::vector<Plane>& planes);

/// Whether planes that begin at 0 cover the circle: to 360, or so close that the next step would reach it.
bool go_around(const std::vector<Plane>& planes);

/// Appends the plane at 360, a copy of the plane at 0, if it is missing.
void close(std::vector<Plane>& planes);

/// The table of planes that ascend around the full circle, from any angle below 360 to that angle plus 360.
/// A single plane describes a profile symmetric about the axis. A missing plane at 0 is interpolated.
DirectionTable table_of_planes(const std::vector<double>& theta_deg, std::vector<Plane> planes);

/// A profile of photometric type B of an LM-63 file: the planes of V rotate about the horizontal axis y, and
/// H is the angle within a plane; both are -90 to 90 degrees. V = 90 at H = 0 is +x, like horizontal angle 0
/// of type C. H counts clockwise, unlike the horizontal angle of type C:
///   x = cos H sin V,  y = -sin H,  z = cos H cos V.
struct TypeB {
  std::vector<double> vertical;    ///< degrees, ascending from -90 to 90
  std::vector<Plane> horizontals;  ///< H and a value for each V; H ascending from -90 to 90

  /// Bilinear in V and H between the points of the file; for directions with z >= 0.
  double value(const Vec3& direction) const;

  /// Step in degrees of the table from `resampled`: 1, or 1/2 if the file has steps below 2.
  double step() const;

  /// The table of this profile at equal steps of theta and phi. Between its points it differs from `value` by
  /// the interpolation error: an eighth of the squared step times the second derivative, and a quarter of the
  /// step times the change of slope at kinks on the file's own grid.
  DirectionTable resampled() const;
};

}  // namespace shelfbeam::detail
