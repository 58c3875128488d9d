#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// A direction drawn at random, in the device's frame.
struct DirectionSample {
  Vec3 direction;  ///< unit
  double pdf = 0;  ///< per solid angle, 1/sr; positive
};

/// The sample, unless rounding left the direction where the density is zero.
inline std::optional<DirectionSample> usable(const Vec3& direction, double density) {
  if (!(density > 0)) return std::nullopt;
  return DirectionSample{direction, density};
}

/// A non-negative function of direction given at the points of a grid: linear in theta and in phi between
/// them, zero below the first and above the last theta. theta is measured from +z, phi from +x towards +y.
///
/// Integral, density and sampling are those of this interpolation, exactly. Immutable; copies share the data.
class DirectionTable {
 public:
  /// `theta`: radians, at least two, ascending within [0, pi]. `phi`: radians, ascending from 0 to 2 pi, or a
  /// single value for a function of theta alone. `values`: a row of all thetas for each phi. Throws
  /// std::invalid_argument for anything else: readers of files say it with the place first.
  DirectionTable(std::vector<double> theta, std::vector<double> phi, std::vector<double> values);

  const std::vector<double>& theta() const { return grid_->theta; }
  const std::vector<double>& phi() const { return grid_->phi; }
  const std::vector<double>& values() const { return grid_->values; }

  /// At a unit direction.
  double value(const Vec3& direction) const;
  /// At angles; phi in [0, 2 pi].
  double value(double theta, double phi) const;

  /// Over the sphere, per solid angle.
  double integral() const { return grid_->integral; }

  /// The same shape with another integral. Throws std::invalid_argument where all is zero.
  DirectionTable with_integral(double integral) const;

  /// A direction with density value / integral, by inverting the marginal of phi (piecewise quadratic) with
  /// u2 and the conditional of theta (in closed form up to one safeguarded Newton iteration) with u1. Nothing
  /// where all is zero, or where rounding leaves the table at its edge.
  std::optional<DirectionSample> sample(double u1, double u2) const;
  double pdf(const Vec3& direction) const;

 private:
  struct Grid {
    std::vector<double> theta, phi, values;
    std::vector<double> along_theta;  ///< a row for each phi: integral of value sin theta up to each theta
    std::vector<double> along_phi;    ///< integral of the rows' totals up to each phi
    double integral = 0;
  };
  std::shared_ptr<const Grid> grid_;
};

}  // namespace shelfbeam
