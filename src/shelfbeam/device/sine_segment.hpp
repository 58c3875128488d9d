#pragma once

namespace shelfbeam::detail {

/// A function of theta that goes linearly from `first` at `begin` to `last` at `end`, weighted with sin
/// theta.
struct SineSegment {
  double begin, end;
  double first, last;

  /// The integral of f(theta) sin(theta) from `begin` to `begin + reach`.
  double integral_to(double reach) const;
  double integral() const { return integral_to(end - begin); }

  /// The theta up to which the integral is `part`, for 0 <= part <= integral().
  double invert(double part) const;
};

/// Where in [0, 1] a density that goes linearly from `first` at 0 to `last` at 1 has the share u of its
/// integral below it.
double invert_linear_density(double first, double last, double u);

}  // namespace shelfbeam::detail
