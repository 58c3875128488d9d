#pragma once

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// A direction drawn from a material.
struct ScatterSample {
  Vec3 direction;
  double weight = 0;      ///< eval |cos(theta)| / pdf; for a specular lobe, its share over its probability
  double pdf = 0;         ///< per solid angle; for a specular lobe, the probability of choosing it
  bool specular = false;  ///< one of finitely many directions, which `eval` and `pdf` do not cover
};

}  // namespace shelfbeam
