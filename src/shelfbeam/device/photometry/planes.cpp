#include "shelfbeam/device/photometry/planes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "shelfbeam/math/warp.hpp"

namespace shelfbeam::detail {

namespace {

Plane between(const Plane& a, const Plane& b, double phi) {
  const double t = (phi - a.phi) / (b.phi - a.phi);
  Plane plane{phi, a.values};
  for (std::size_t i = 0; i < plane.values.size(); ++i)
    plane.values[i] = a.values[i] * (1 - t) + b.values[i] * t;
  return plane;
}

/// Rotates the circle of planes so that it begins at 0.
std::vector<Plane> from_zero(std::vector<Plane> planes) {
  if (planes.front().phi == 0) return planes;
  const auto after = std::find_if(planes.begin(), planes.end(), [](const Plane& p) { return p.phi >= 360; });
  std::vector<Plane> turned{after->phi == 360 ? *after : between(*std::prev(after), *after, 360)};
  turned.insert(turned.end(), after->phi == 360 ? std::next(after) : after, planes.end());
  for (Plane& plane : turned) plane.phi -= 360;
  // The first original plane is skipped, because its copy 360 degrees later is already the last of `turned`.
  turned.insert(turned.end(), std::next(planes.begin()), after);
  turned.push_back({360, turned.front().values});
  return turned;
}

}  // namespace

void unfold(std::vector<Plane>& planes) {
  const double about = planes.back().phi;
  for (std::size_t k = planes.size() - 1; k-- > 0;)
    planes.push_back({2 * about - planes[k].phi, planes[k].values});
}

bool go_around(const std::vector<Plane>& planes) {
  double widest = 0;
  for (std::size_t k = 1; k < planes.size(); ++k)
    widest = std::max(widest, planes[k].phi - planes[k - 1].phi);
  return 360 - planes.back().phi <= widest * 1.001;
}

void close(std::vector<Plane>& planes) {
  if (planes.back().phi != 360) planes.push_back({360, planes.front().values});
}

DirectionTable table_of_planes(const std::vector<double>& theta_deg, std::vector<Plane> planes) {
  if (planes.size() > 1) planes = from_zero(std::move(planes));
  std::vector<double> theta, phi, values;
  for (const double angle : theta_deg) theta.push_back(radians(angle));
  for (const Plane& plane : planes) {
    phi.push_back(planes.size() > 1 ? radians(plane.phi) : 0);
    values.insert(values.end(), plane.values.begin(), plane.values.end());
  }
  return {std::move(theta), std::move(phi), std::move(values)};
}

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
