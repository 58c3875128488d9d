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

}  // namespace shelfbeam::detail
