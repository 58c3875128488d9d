#include "shelfbeam/device/photometry/type_b.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shelfbeam/math/warp.hpp"

namespace shelfbeam::detail {

double TypeB::value(const Vec3& direction) const {
  const double v = std::clamp(std::atan2(direction.x, direction.z) * 180 / pi, -90.0, 90.0);
  const double h = std::asin(std::clamp(-direction.y, -1.0, 1.0)) * 180 / pi;
  const auto right = std::upper_bound(vertical.begin() + 1, vertical.end() - 1, v);
  const auto column = static_cast<std::size_t>(right - vertical.begin()) - 1;
  const auto above = std::upper_bound(horizontals.begin() + 1, horizontals.end() - 1, h,
                                      [](double angle, const Plane& plane) { return angle < plane.phi; });
  const Plane &upper = *above, &lower = *std::prev(above);
  const double s = (v - vertical[column]) / (vertical[column + 1] - vertical[column]);
  const double t = (h - lower.phi) / (upper.phi - lower.phi);
  const auto along = [&](const Plane& plane) {
    return plane.values[column] * (1 - s) + plane.values[column + 1] * s;
  };
  return std::max(0.0, along(lower) * (1 - t) + along(upper) * t);
}

double TypeB::step() const {
  double smallest = 180;
  for (std::size_t k = 1; k < vertical.size(); ++k)
    smallest = std::min(smallest, vertical[k] - vertical[k - 1]);
  for (std::size_t k = 1; k < horizontals.size(); ++k)
    smallest = std::min(smallest, horizontals[k].phi - horizontals[k - 1].phi);
  return smallest < 2 ? 0.5 : 1;
}

DirectionTable TypeB::resampled() const {
  const auto steps_of_90 = static_cast<int>(std::lround(90 / step()));
  std::vector<double> theta_deg;
  for (int t = 0; t <= steps_of_90; ++t) theta_deg.push_back(90.0 * t / steps_of_90);
  std::vector<Plane> planes;
  for (int p = 0; p <= 4 * steps_of_90; ++p) {
    Plane plane{90.0 * p / steps_of_90, {}};
    const double phi = radians(plane.phi);
    for (const double angle : theta_deg) {
      const double theta = radians(angle);
      plane.values.push_back(
          value({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)}));
    }
    planes.push_back(std::move(plane));
  }
  return table_of_planes(theta_deg, std::move(planes));
}

}  // namespace shelfbeam::detail
