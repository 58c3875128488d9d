#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "shelfbeam/device/direction_table.hpp"

namespace shelfbeam {

// Emission profiles eta(theta, phi) of 2.9: radiant intensity in W/sr. theta is measured from the device's
// axis (+z of its frame), phi from its +x towards +y; nothing is emitted beyond 90 degrees unless a table
// says so.

/// eta = peak sin 2 theta: most of the light leaves at 45 degrees (the paper's transceiver).
struct SinTwoTheta {
  static constexpr std::string_view type_name = "sin2theta";

  double peak = 1;  ///< W/sr at 45 degrees
};

/// The same intensity over the hemisphere.
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

/// A measured profile, of the store file or of an IES or EULUMDAT file (photometry.hpp).
struct EmissionTable {
  static constexpr std::string_view type_name = "table";

  DirectionTable intensity;  ///< W/sr
};

/// The closed set of profiles. To add one: a struct above and a case in each function of emission.cpp.
using Emission = std::variant<SinTwoTheta, IsotropicHemisphere, GeneralizedLambertian, EmissionTable>;

/// Radiant intensity in W/sr towards a unit direction in the device's frame.
double intensity(const Emission& emission, const Vec3& direction);

/// Radiant intensity in W/sr at an angle of 0 to pi from the axis, averaged over phi.
double mean_intensity(const Emission& emission, double theta);

/// Total flux in W: closed forms; for a table the exact integral of the interpolation.
double power(const Emission& emission);

/// A direction in the device's frame with density intensity / power, from u1 and u2 in [0, 1): closed forms
/// (for sin 2 theta the paper's theta = arcsin cbrt(u1), phi = 2 pi u2); tables by exact inversion. Nothing
/// where the draw has no density (on the axis of sin 2 theta, which u1 = 0 gives).
std::optional<DirectionSample> sample(const Emission& emission, double u1, double u2);

/// The density of `sample` per solid angle.
double pdf(const Emission& emission, const Vec3& direction);

/// The name used in the store file.
std::string_view type_name(const Emission& emission);

}  // namespace shelfbeam
