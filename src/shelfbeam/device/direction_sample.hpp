#pragma once

#include <optional>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// A direction drawn at random, in the device's frame.
struct DirectionSample {
  Vec3 direction;  ///< unit
  double pdf = 0;  ///< per solid angle, 1/sr; positive
};

/// The sample, unless rounding left the direction where the density is zero.
inline std::optional<DirectionSample> usable(const Vec3& direction, double density) {
  if (!(density > 0)) return std::nullopt;
  return DirectionSample{direction, density};
}

}  // namespace shelfbeam
