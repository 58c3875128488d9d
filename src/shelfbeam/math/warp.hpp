#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

inline constexpr double pi = std::numbers::pi;

constexpr double radians(double degrees) {
  return degrees * pi / 180;
}

/// Samples a direction on the hemisphere about +z with density cos(theta) / pi per solid angle.
inline Vec3 sample_cosine_hemisphere(double u1, double u2) {
  const double r = std::sqrt(u1), phi = 2 * pi * u2;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0, 1 - u1))};
}
inline double pdf_cosine_hemisphere(const Vec3& direction) {
  return std::max(0.0, direction.z) / pi;
}

}  // namespace shelfbeam
