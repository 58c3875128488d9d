#pragma once

#include <cmath>

#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam::test {

/// Irradiance in W/m^2 of an element below a horizontal Lambertian disc that emits downwards; the disc lies
/// on the front side of the element's plane. It is the vector sum for an element parallel to the disc and one
/// perpendicular to it (configuration factors B-13 and B-14 of Howell's catalogue), times the exitance Phi /
/// A.
inline double irradiance_of_disc(double flux, double radius, const Vec3& centre, const Vec3& at,
                                 const Vec3& normal) {
  const double h = centre.z - at.z, dx = centre.x - at.x, dy = centre.y - at.y, a = std::hypot(dx, dy);
  const double r2 = radius * radius, s = h * h + a * a + r2, root = std::sqrt(s * s - 4 * a * a * r2);
  const double parallel = (1 - (h * h + a * a - r2) / root) / 2;
  const double across = a > 0 ? h / (2 * a) * (s / root - 1) : 0;
  const double towards = a > 0 ? (normal.x * dx + normal.y * dy) / a : 0;
  return flux / (pi * r2) * (normal.z * parallel + towards * across);
}

/// Irradiance of an element that faces the centre of such a disc at a distance, where share(cosine) of the
/// light is transmitted at each angle: 2 pi L times the integral of share cos sin over the angle, by
/// Simpson's rule.
template <class Share>
double irradiance_of_coaxial_disc(double flux, double radius, double distance, const Share& share) {
  constexpr int intervals = 200;
  const double step = std::atan(radius / distance) / intervals;
  double sum = 0;
  for (int k = 0; k <= intervals; ++k) {
    const double theta = k * step, weight = k == 0 || k == intervals ? 1 : k % 2 == 1 ? 4 : 2;
    sum += weight * share(std::cos(theta)) * std::cos(theta) * std::sin(theta);
  }
  return 2 * flux / (pi * radius * radius) * sum * step / 3;
}

}  // namespace shelfbeam::test
