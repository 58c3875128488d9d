#include "shelfbeam/device/emission.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

double intensity(const SinTwoTheta& e, const Vec3& d) {
  return d.z > 0 ? 2 * e.peak * d.z * std::hypot(d.x, d.y) : 0;
}
double power(const SinTwoTheta& e) {
  return 4 * pi / 3 * e.peak;
}
std::string_view type_name(const SinTwoTheta&) {
  return "sin2theta";
}

double intensity(const IsotropicHemisphere& e, const Vec3& d) {
  return d.z > 0 ? e.intensity : 0;
}
double power(const IsotropicHemisphere& e) {
  return 2 * pi * e.intensity;
}
std::string_view type_name(const IsotropicHemisphere&) {
  return "isotropic";
}

double intensity(const GeneralizedLambertian& e, const Vec3& d) {
  return d.z > 0 ? e.flux * (e.order + 1) / (2 * pi) * std::pow(d.z, e.order) : 0;
}
double power(const GeneralizedLambertian& e) {
  return e.flux;
}
std::string_view type_name(const GeneralizedLambertian&) {
  return "lambertian";
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

double intensity(const EmissionTable& e, const Vec3& d) {
  const double theta = std::atan2(std::hypot(d.x, d.y), d.z);
  if (theta > e.theta.back()) return 0;
  const Position t = locate(e.theta, theta);
  const std::size_t thetas = e.theta.size();
  const auto along_theta = [&](std::size_t plane) {
    const double* row = &e.intensity[plane * thetas];
    return row[t.lower] * (1 - t.fraction) + row[t.lower + 1] * t.fraction;
  };
  if (e.phi.size() == 1) return along_theta(0);
  double phi = std::atan2(d.y, d.x);
  if (phi < 0) phi += 2 * pi;
  const Position p = locate(e.phi, phi);
  return along_theta(p.lower) * (1 - p.fraction) + along_theta(p.lower + 1) * p.fraction;
}

double power(const EmissionTable& e) {
  // Over one theta interval: the integral of (a + b theta) sin theta is -(a + b theta) cos theta + b sin
  // theta.
  const std::size_t thetas = e.theta.size();
  const auto plane_flux = [&](std::size_t plane) {
    double sum = 0;
    for (std::size_t t = 0; t + 1 < thetas; ++t) {
      const double t0 = e.theta[t], t1 = e.theta[t + 1];
      const double i0 = e.intensity[plane * thetas + t], i1 = e.intensity[plane * thetas + t + 1];
      const double slope = (i1 - i0) / (t1 - t0);
      sum += i0 * std::cos(t0) - i1 * std::cos(t1) + slope * (std::sin(t1) - std::sin(t0));
    }
    return sum;
  };
  if (e.phi.size() == 1) return 2 * pi * plane_flux(0);
  double flux = 0;
  for (std::size_t p = 0; p + 1 < e.phi.size(); ++p)
    flux += (e.phi[p + 1] - e.phi[p]) * (plane_flux(p) + plane_flux(p + 1)) / 2;
  return flux;
}

std::string_view type_name(const EmissionTable&) {
  return "table";
}

}  // namespace

double intensity(const Emission& emission, const Vec3& direction) {
  return std::visit([&](const auto& e) { return intensity(e, direction); }, emission);
}

double power(const Emission& emission) {
  return std::visit([](const auto& e) { return power(e); }, emission);
}

std::string_view type_name(const Emission& emission) {
  return std::visit([](const auto& e) { return type_name(e); }, emission);
}

}  // namespace shelfbeam
