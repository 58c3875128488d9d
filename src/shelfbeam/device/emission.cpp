#include "shelfbeam/device/emission.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "shelfbeam/device/direction_densities.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

double intensity(const SinTwoTheta& e, const Vec3& d) {
  return d.z > 0 ? 2 * e.peak * d.z * std::sqrt(d.x * d.x + d.y * d.y) : 0;
}
double power(const SinTwoTheta& e) {
  return 4 * pi / 3 * e.peak;
}
double pdf(const SinTwoTheta&, const Vec3& d) {
  return intensity(SinTwoTheta{3 / (4 * pi)}, d);
}
Vec3 draw(const SinTwoTheta&, double u1, double u2) {
  const double across = std::cbrt(u1), phi = 2 * pi * u2;
  return {across * std::cos(phi), across * std::sin(phi), std::sqrt(1 - across * across)};
}
double intensity(const IsotropicHemisphere& e, const Vec3& d) {
  return d.z > 0 ? e.intensity : 0;
}
double power(const IsotropicHemisphere& e) {
  return 2 * pi * e.intensity;
}
double pdf(const IsotropicHemisphere&, const Vec3& d) {
  return detail::CosinePower{0}.pdf(d);
}
Vec3 draw(const IsotropicHemisphere&, double u1, double u2) {
  return detail::CosinePower{0}.draw(u1, u2);
}
double pdf(const GeneralizedLambertian& e, const Vec3& d) {
  return detail::CosinePower{e.order}.pdf(d);
}
double intensity(const GeneralizedLambertian& e, const Vec3& d) {
  return e.flux * pdf(e, d);
}
double power(const GeneralizedLambertian& e) {
  return e.flux;
}
Vec3 draw(const GeneralizedLambertian& e, double u1, double u2) {
  return detail::CosinePower{e.order}.draw(u1, u2);
}
double intensity(const EmissionTable& e, const Vec3& d) {
  return e.intensity.value(d);
}
double power(const EmissionTable& e) {
  return e.intensity.integral();
}
double pdf(const EmissionTable& e, const Vec3& d) {
  return e.intensity.pdf(d);
}
template <class RotationallySymmetric>
double mean_intensity(const RotationallySymmetric& e, double theta) {
  return intensity(e, {std::sin(theta), 0, std::cos(theta)});
}
double mean_intensity(const EmissionTable& e, double theta) {
  const std::vector<double>& phi = e.intensity.phi();
  if (phi.size() == 1) return e.intensity.value(theta, 0);
  double sum = 0;
  for (std::size_t p = 0; p + 1 < phi.size(); ++p)
    sum +=
        (phi[p + 1] - phi[p]) * (e.intensity.value(theta, phi[p]) + e.intensity.value(theta, phi[p + 1])) / 2;
  return sum / (2 * pi);
}

template <class Profile>
std::optional<DirectionSample> sample(const Profile& e, double u1, double u2) {
  const Vec3 direction = draw(e, u1, u2);
  return usable(direction, pdf(e, direction));
}
std::optional<DirectionSample> sample(const EmissionTable& e, double u1, double u2) {
  return e.intensity.sample(u1, u2);
}

}  // namespace

double intensity(const Emission& emission, const Vec3& direction) {
  return std::visit([&](const auto& e) { return intensity(e, direction); }, emission);
}

double mean_intensity(const Emission& emission, double theta) {
  return std::visit([&](const auto& e) { return mean_intensity(e, theta); }, emission);
}

double power(const Emission& emission) {
  return std::visit([](const auto& e) { return power(e); }, emission);
}

std::optional<DirectionSample> sample(const Emission& emission, double u1, double u2) {
  return std::visit([&](const auto& e) { return sample(e, u1, u2); }, emission);
}

double pdf(const Emission& emission, const Vec3& direction) {
  return std::visit([&](const auto& e) { return pdf(e, direction); }, emission);
}

std::string_view type_name(const Emission& emission) {
  return std::visit([](const auto& e) { return e.type_name; }, emission);
}

}  // namespace shelfbeam
