#pragma once

#include <cmath>

#include "shelfbeam/math/cpu_vectors.hpp"

namespace shelfbeam {

/// Emission profiles with vectorised code.
enum class LaneProfile { sine, isotropic, lambertian, table };

/// A vector in single precision.
struct LaneVector {
  float x, y, z;
};
SHELFBEAM_INLINE inline float dot(const LaneVector& a, const LaneVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Units nearer than this count as at this distance, which suffices for an approximation.
inline constexpr float min_squared_distance = 1e-6F;

/// I(theta) cos / d^2 at a point, without obstacles, with the fewest roots and divisions for each profile.
/// `way` leads from the point to the unit; `scale` is the intensity that defines the profile. `table` has
/// steps + 1 intensities by (1 + cos theta) / 2.
template <LaneProfile profile>
SHELFBEAM_INLINE inline float profile_irradiance(const LaneVector& way, const LaneVector& normal,
                                                 const LaneVector& axis, float scale, const float* table,
                                                 int steps) {
  const float whole = dot(way, way);
  const float squared = whole > min_squared_distance ? whole : min_squared_distance;
  const float inverse = 1 / squared;
  const float facing = dot(normal, way);  // distance times the cosine at the point
  const float at_point = (facing > 0 ? facing : 0) * scale;
  const float along = -dot(axis, way);  // the same at the unit
  const float at_unit = along > 0 ? along : 0;
  if constexpr (profile == LaneProfile::sine) {
    const float across = squared - at_unit * at_unit;
    return 2 * at_unit * at_point * std::sqrt((across > 0 ? across : 0) * inverse) * inverse * inverse;
  } else if constexpr (profile == LaneProfile::isotropic) {
    return (along > 0 ? at_point : 0) * inverse * std::sqrt(inverse);
  } else if constexpr (profile == LaneProfile::lambertian) {
    return at_unit * at_point * inverse * inverse;
  } else {
    const float root = std::sqrt(inverse);
    const float cosine = along * root;
    const float c = cosine < -1 ? -1 : cosine > 1 ? 1 : cosine;
    const float place = (1 + c) / 2 * static_cast<float>(steps);
    const int at = static_cast<int>(place);
    const int below = at < steps ? at : steps - 1;
    const float part = place - static_cast<float>(below);
    return at_point * inverse * root * (table[below] + part * (table[below + 1] - table[below]));
  }
}

}  // namespace shelfbeam
