#pragma once

#include <numbers>
#include <optional>
#include <string_view>
#include <variant>

#include "shelfbeam/device/direction_table.hpp"

namespace shelfbeam {

// The complete angular response R(theta) of a label: the paper's W (2.13) times cos(theta). theta is measured
// from the label's normal. Labels are one-sided: R is zero behind them.

/// R = cos theta: the signal is the irradiance at the label.
struct CosineResponse {
  static constexpr std::string_view type_name = "cosine";
};

/// R = cos^exponent theta up to the cut-off and zero beyond; exponent 1 is the cosine response.
struct CosinePowerResponse {
  static constexpr std::string_view type_name = "cosine_power";

  double exponent = 1;                   ///< not negative
  double cutoff = std::numbers::pi / 2;  ///< radians, above 0, at most pi / 2
};

/// R measured at several angles: linear in theta between them and zero beyond the last.
struct ResponseTable {
  static constexpr std::string_view type_name = "table";

  DirectionTable response;  ///< a single phi, no theta beyond pi / 2
};

/// The closed set of label responses. To add a response, add a struct above and a case in each function of
/// responsivity.cpp.
using Responsivity = std::variant<CosineResponse, CosinePowerResponse, ResponseTable>;

/// R at the angle with this cosine.
double response(const Responsivity& responsivity, double cos_theta);

/// The largest R.
double largest(const Responsivity& responsivity);

/// The integral of R over the hemisphere, per solid angle: the signal in a field of radiance 1.
double integral(const Responsivity& responsivity);

/// Samples a direction about +z with density R / integral from u1 and u2 in [0, 1), for the first ray from a
/// label: all directions then have the same weight. Nothing if the density is zero.
std::optional<DirectionSample> sample(const Responsivity& responsivity, double u1, double u2);

/// The density of `sample` per solid angle.
double pdf(const Responsivity& responsivity, const Vec3& direction);

/// The name used in the store file.
std::string_view type_name(const Responsivity& responsivity);

}  // namespace shelfbeam
