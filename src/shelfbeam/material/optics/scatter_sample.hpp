#pragma once

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// A direction drawn from a material.
struct ScatterSample {
  Vec3 direction;
  double weight = 0;      ///< eval |cos(theta)| / pdf; of a specular lobe its share over its probability
  double pdf = 0;         ///< per solid angle; of a specular lobe the probability with which it was chosen
  bool specular = false;  ///< one of finitely many directions: `eval` and `pdf` do not see it
};

}  // namespace shelfbeam
