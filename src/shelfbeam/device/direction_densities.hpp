#pragma once

#include <cmath>

#include "shelfbeam/math/warp.hpp"

namespace shelfbeam::detail {

/// A linear function of theta from `first` at `begin` to `last` at `end`, weighted with sin theta.
struct SineSegment {
  double begin, end;
  double first, last;

  /// The integral of f(theta) sin(theta) from `begin` to `begin + reach`.
  double integral_to(double reach) const;
  double integral() const { return integral_to(end - begin); }

  /// The upper limit theta for which the integral is `part`, 0 <= part <= integral().
  double invert(double part) const;
};

/// The u-quantile of a density on [0, 1] that is linear from `first` at 0 to `last` at 1.
double invert_linear_density(double first, double last, double u);

/// Directions about +z with density proportional to cos^order theta, zero for cos theta below `lowest`.
struct CosinePower {
  double order = 1;
  double lowest = 0;  ///< cosine of the cut-off

  /// The integral of cos^order theta over the cone.
  double integral() const { return 2 * pi / (order + 1) * (1 - tail()); }

  double value(double cos_theta) const {
    return cos_theta > 0 && cos_theta >= lowest ? std::pow(cos_theta, order) : 0;
  }
  double pdf(const Vec3& d) const { return value(d.z) / integral(); }

  /// Samples cos^(order + 1) theta uniformly between 1 (at u1 = 0) and its value at the cut-off.
  Vec3 draw(double u1, double u2) const {
    const double exponent = std::log1p(-u1 * (1 - tail())) / (order + 1);
    // The same logarithm gives a sine that is accurate near the axis, where a high order puts all directions.
    const double along = std::exp(exponent), across = std::sqrt(-std::expm1(2 * exponent)), phi = 2 * pi * u2;
    return {across * std::cos(phi), across * std::sin(phi), along};
  }

 private:
  double tail() const { return lowest > 0 ? std::pow(lowest, order + 1) : 0; }
};

}  // namespace shelfbeam::detail
