#pragma once

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// A direction drawn at random, in the device's frame.
struct DirectionSample {
  Vec3 direction;  ///< unit
  double pdf = 0;  ///< per solid angle, 1/sr; positive
};

}  // namespace shelfbeam
