#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

// Emission profiles eta(theta, phi) of 2.9: radiant intensity in W/sr. theta is measured from the device's
// axis
// (+z of its frame), phi from its +x towards +y; nothing is emitted beyond 90 degrees unless a table says so.

/// eta = peak sin 2 theta: most of the light leaves at 45 degrees (the paper's transceiver).
struct SinTwoTheta {
  double peak = 1;  ///< W/sr at 45 degrees
};

/// The same intensity over the hemisphere.
struct IsotropicHemisphere {
  double intensity = 1;  ///< W/sr
};

/// eta = flux (order + 1) / (2 pi) cos^order theta.
struct GeneralizedLambertian {
  double order = 1;
  double flux = 1;  ///< W
};

/// Bilinear interpolation of a measured profile; zero beyond the last theta.
struct EmissionTable {
  std::vector<double> theta;  ///< radians, ascending from 0, at most pi
  std::vector<double> phi;  ///< radians, ascending from 0 to 2 pi (last plane = first); one value: symmetric
  std::vector<double> intensity;  ///< W/sr, one row of all thetas a phi
};

/// The closed set of profiles. To add one: a struct above and a case in each function of emission.cpp.
using Emission = std::variant<SinTwoTheta, IsotropicHemisphere, GeneralizedLambertian, EmissionTable>;

/// Radiant intensity in W/sr towards a unit direction in the device's frame.
double intensity(const Emission& emission, const Vec3& direction);

/// Total flux in W: closed forms; for a table the exact integral of the interpolation.
double power(const Emission& emission);

/// The name used in the store file.
std::string_view type_name(const Emission& emission);

}  // namespace shelfbeam
