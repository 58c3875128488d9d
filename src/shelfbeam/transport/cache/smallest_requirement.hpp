#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The smallest requirement of a label, as an irradiance in W/m^2, by which estimators measure light; 0.001
/// without any.
inline double smallest_requirement(const Scene& scene) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Label& label : scene.labels) {
    const double requirement = scene.irradiance_for(label);
    if (requirement > 0) smallest = std::min(smallest, requirement);
  }
  return std::isfinite(smallest) ? smallest : 1e-3;
}

}  // namespace shelfbeam
