#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// A direction drawn at random, in the device's frame.
struct DirectionSample {
  Vec3 direction;  ///< unit length
  double pdf = 0;  ///< per solid angle, 1/sr; positive
};

/// The sample; nothing if rounding moved the direction to a density of zero.
inline std::optional<DirectionSample> usable(const Vec3& direction, double density) {
  if (!(density > 0)) return std::nullopt;
  return DirectionSample{direction, density};
}

/// A non-negative function of direction, given on a grid. It is linear in theta and in phi between the grid
/// points and zero below the first and above the last theta. theta is measured from +z, phi from +x towards
/// +y. Integral, density and sampling are exact for this interpolation. Immutable; copies share the data.
class DirectionTable {
 public:
  /// `theta`: radians, at least two, ascending within [0, pi]. `phi`: radians, ascending from 0 to 2 pi, or a
  /// single value for a function of theta alone. `values`: for each phi, a row with a value per theta. Throws
  /// std::invalid_argument otherwise. Readers of files check first, to report the location of an error.
  DirectionTable(std::vector<double> theta, std::vector<double> phi, std::vector<double> values);

  const std::vector<double>& theta() const { return grid_->theta; }
  const std::vector<double>& phi() const { return grid_->phi; }
  const std::vector<double>& values() const { return grid_->values; }

  /// The value in a direction of unit length.
  double value(const Vec3& direction) const;
  /// The value at angles in radians; phi in [0, 2 pi].
  double value(double theta, double phi) const;

  /// The integral over the sphere, per solid angle.
  double integral() const { return grid_->integral; }

  /// The same shape with another integral. Throws std::invalid_argument if all values are zero.
  DirectionTable with_integral(double integral) const;

  /// Samples a direction with density value / integral. Inverts the marginal of phi (piecewise quadratic) at
  /// u2 and the conditional of theta (closed form, then safeguarded Newton iterations) at u1. Nothing if all
  /// values are zero or rounding moves the direction off the table.
  std::optional<DirectionSample> sample(double u1, double u2) const;
  double pdf(const Vec3& direction) const;

 private:
  struct Grid {
    std::vector<double> theta, phi, values;
    std::vector<double> along_theta;  ///< for each phi a row: integral of value sin theta up to each theta
    std::vector<double> along_phi;    ///< integral of the rows' totals up to each phi
    double integral = 0;
  };
  std::shared_ptr<const Grid> grid_;
};

}  // namespace shelfbeam
