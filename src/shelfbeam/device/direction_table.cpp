#include "shelfbeam/device/direction_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "shelfbeam/device/direction_densities.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

// Angles computed from degrees may exceed their range by a rounding error.
constexpr double tolerance = 1e-12;

bool ascends(const std::vector<double>& angles) {
  return std::adjacent_find(angles.begin(), angles.end(), [](double a, double b) { return !(a < b); }) ==
         angles.end();
}

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(std::string("DirectionTable: ") + what);
}

struct Position {
  std::size_t lower;
  double fraction;
};

Position locate(const std::vector<double>& axis, double value) {
  const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, value);
  const auto lower = static_cast<std::size_t>(above - axis.begin()) - 1;
  return {lower, (value - axis[lower]) / (axis[lower + 1] - axis[lower])};
}

double mix(double a, double b, double t) {
  return a * (1 - t) + b * t;
}

}  // namespace

DirectionTable::DirectionTable(std::vector<double> theta, std::vector<double> phi,
                               std::vector<double> values) {
  require(theta.size() >= 2 && ascends(theta), "requires at least two ascending thetas");
  require(theta.front() >= 0 && theta.back() <= pi + tolerance, "a theta is outside 0 to pi");
  require(phi.size() == 1 || (phi.size() >= 2 && phi.front() == 0 && ascends(phi) &&
                              std::abs(phi.back() - 2 * pi) <= tolerance),
          "phi must be one value, or ascend from 0 to 2 pi");
  require(values.size() == theta.size() * phi.size(), "requires a value for each theta and phi");
  require(std::all_of(values.begin(), values.end(), [](double v) { return v >= 0 && std::isfinite(v); }),
          "a value is negative or not finite");

  auto grid = std::make_shared<Grid>();
  const std::size_t thetas = theta.size(), phis = phi.size();
  grid->along_theta.resize(values.size());
  for (std::size_t p = 0; p < phis; ++p) {
    const double* row = &values[p * thetas];
    double* sums = &grid->along_theta[p * thetas];
    for (std::size_t t = 0; t + 1 < thetas; ++t)
      sums[t + 1] = sums[t] + detail::SineSegment{theta[t], theta[t + 1], row[t], row[t + 1]}.integral();
  }
  const auto total = [&](std::size_t p) { return grid->along_theta[(p + 1) * thetas - 1]; };
  grid->along_phi.resize(phis);
  for (std::size_t p = 0; p + 1 < phis; ++p)
    grid->along_phi[p + 1] = grid->along_phi[p] + (phi[p + 1] - phi[p]) * (total(p) + total(p + 1)) / 2;
  grid->integral = phis == 1 ? 2 * pi * total(0) : grid->along_phi.back();
  require(std::isfinite(grid->integral), "the integral is not finite");
  grid->theta = std::move(theta);
  grid->phi = std::move(phi);
  grid->values = std::move(values);
  grid_ = std::move(grid);
}

double DirectionTable::value(const Vec3& direction) const {
  const double theta = std::atan2(std::hypot(direction.x, direction.y), direction.z);
  if (grid_->phi.size() == 1) return value(theta, 0);
  const double phi = std::atan2(direction.y, direction.x);
  return value(theta, phi < 0 ? phi + 2 * pi : phi);
}

double DirectionTable::value(double theta, double phi) const {
  const Grid& g = *grid_;
  if (!(theta >= g.theta.front() && theta <= g.theta.back())) return 0;
  const Position t = locate(g.theta, theta);
  const auto along_theta = [&](std::size_t plane) {
    const double* row = &g.values[plane * g.theta.size()];
    return mix(row[t.lower], row[t.lower + 1], t.fraction);
  };
  if (g.phi.size() == 1) return along_theta(0);
  const Position p = locate(g.phi, phi);
  return std::max(0.0, mix(along_theta(p.lower), along_theta(p.lower + 1), p.fraction));
}

DirectionTable DirectionTable::with_integral(double integral) const {
  require(grid_->integral > 0, "is zero everywhere");
  std::vector<double> scaled = grid_->values;
  for (double& v : scaled) v *= integral / grid_->integral;
  return {grid_->theta, grid_->phi, std::move(scaled)};
}

std::optional<DirectionSample> DirectionTable::sample(double u1, double u2) const {
  const Grid& g = *grid_;
  if (!(g.integral > 0)) return std::nullopt;
  const std::size_t thetas = g.theta.size();

  // The plane of phi: two rows and the weight of the upper row.
  std::size_t lower = 0, upper = 0;
  double between = 0, phi = 2 * pi * u2;
  if (g.phi.size() > 1) {
    const double part = u2 * g.along_phi.back();
    lower = locate(g.along_phi, part).lower;
    upper = lower + 1;
    const double mass = g.along_phi[upper] - g.along_phi[lower];
    const double share = mass > 0 ? std::min(1.0, (part - g.along_phi[lower]) / mass) : 0;
    between = detail::invert_linear_density(g.along_theta[upper * thetas - 1],
                                            g.along_theta[(upper + 1) * thetas - 1], share);
    phi = mix(g.phi[lower], g.phi[upper], between);
  }
  const auto blend = [&](const std::vector<double>& rows, std::size_t t) {
    return mix(rows[lower * thetas + t], rows[upper * thetas + t], between);
  };

  const double part = u1 * blend(g.along_theta, thetas - 1);
  std::size_t first = 0, last = thetas - 1;
  while (last - first > 1) {
    const std::size_t middle = (first + last) / 2;
    (blend(g.along_theta, middle) <= part ? first : last) = middle;
  }
  const detail::SineSegment segment{g.theta[first], g.theta[last], blend(g.values, first),
                                    blend(g.values, last)};
  const double theta = segment.invert(part - blend(g.along_theta, first));

  const double across = std::sin(theta);
  const Vec3 direction{across * std::cos(phi), across * std::sin(phi), std::cos(theta)};
  return usable(direction, pdf(direction));
}

double DirectionTable::pdf(const Vec3& direction) const {
  return grid_->integral > 0 ? value(direction) / grid_->integral : 0;
}

}  // namespace shelfbeam
