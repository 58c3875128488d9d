#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "shelfbeam/device/direction_table.hpp"

namespace shelfbeam {

// Emission profiles eta(theta, phi) of 2.9: radiant intensity in W/sr. theta is measured from the device's
// axis (+z of its frame), phi from its +x towards +y. Only tables can emit beyond 90 degrees.

/// eta = peak sin 2 theta: the intensity is largest at 45 degrees (the paper's transceiver).
struct SinTwoTheta {
  static constexpr std::string_view type_name = "sin2theta";

  double peak = 1;  ///< W/sr at 45 degrees
};

/// Constant intensity over the hemisphere.
struct IsotropicHemisphere {
  static constexpr std::string_view type_name = "isotropic";

  double intensity = 1;  ///< W/sr
};

/// eta = flux (order + 1) / (2 pi) cos^order theta.
struct GeneralizedLambertian {
  static constexpr std::string_view type_name = "lambertian";

  double order = 1;
  double flux = 1;  ///< W
};

/// A measured profile from the store file or from an IES or EULUMDAT file (photometry.hpp).
struct EmissionTable {
  static constexpr std::string_view type_name = "table";

  DirectionTable intensity;  ///< W/sr
};

/// The closed set of profiles. A new profile is a struct above and a case in each function of emission.cpp.
using Emission = std::variant<SinTwoTheta, IsotropicHemisphere, GeneralizedLambertian, EmissionTable>;

/// Radiant intensity in W/sr in a direction of unit length in the device's frame.
double intensity(const Emission& emission, const Vec3& direction);

/// Radiant intensity in W/sr at an angle of 0 to pi from the axis, averaged over phi.
double mean_intensity(const Emission& emission, double theta);

/// Total flux in W, in closed form; for a table, the exact integral of the interpolation.
double power(const Emission& emission);

/// Samples a direction in the device's frame with density intensity / power, from u1 and u2 in [0, 1). Closed
/// forms (for sin 2 theta the paper's theta = arcsin cbrt(u1), phi = 2 pi u2); exact inversion for tables.
/// Nothing if the density is zero (u1 = 0 for sin 2 theta: the axis).
std::optional<DirectionSample> sample(const Emission& emission, double u1, double u2);

/// The density of `sample` per solid angle.
double pdf(const Emission& emission, const Vec3& direction);

/// The name used in the store file.
std::string_view type_name(const Emission& emission);

}  // namespace shelfbeam
