#include "shelfbeam/material/optics/coat_albedo.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/material/optics/directions.hpp"
#include "shelfbeam/material/optics/fresnel.hpp"

namespace shelfbeam::detail {

namespace {

// A direction just above the horizon stands for the limit, which is finite.
constexpr double least_cosine = 1e-6;

double rough_albedo(double ior, const Microfacets& facets, double cos_theta) {
  const double z = std::max(least_cosine, cos_theta);
  const Vec3 w{std::sqrt(1 - z * z), 0, z};
  const auto value = [&](const Vec3& h) {
    const Vec3 s = reflected(w, h);
    return s.z > 0 ? fresnel_dielectric(dot(w, h), ior) * facets.shadowing(w, s, h) : 0;
  };
  return facets.integrate(w, value, 96);
}

}  // namespace

CoatAlbedo::CoatAlbedo(double ior, const std::optional<Microfacets>& facets)
    : ior_(ior),
      smooth_(!facets),
      alpha_(facets ? facets->alpha_x : 0.1),
      step_(std::asinh(1 / alpha_) / intervals) {
  if (facets)
    for (int k = 0; k <= intervals; ++k)
      table_[static_cast<std::size_t>(k)] = rough_albedo(ior, *facets, std::min(1.0, cosine(k * step_)));

  // 2 E mu dmu by Gauss's rule with four points an interval.
  constexpr std::array<double, 4> node{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                       0.8611363115940526};
  constexpr std::array<double, 4> weight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                         0.3478548451374538};
  for (int k = 0; k < intervals; ++k)
    for (std::size_t g = 0; g < node.size(); ++g) {
      const double x = (k + (1 + node[g]) / 2) * step_, mu = cosine(x);
      average_ += weight[g] * step_ * mu * alpha_ * std::cosh(x) * at(mu);
    }
}

double CoatAlbedo::cosine(double x) const {
  return alpha_ * std::sinh(x);
}

double CoatAlbedo::at(double cos_theta) const {
  if (smooth_) return fresnel_dielectric(std::min(1.0, cos_theta), ior_);
  // Cubic through four neighbours (Lagrange's form, one-sided at the ends).
  // asinh, faster than the library's, which takes care of small numbers that do not matter here.
  const double c = std::clamp(cos_theta, 0.0, 1.0) / alpha_;
  const double x = std::log(c + std::sqrt(c * c + 1)) / step_;
  const int first = std::clamp(static_cast<int>(x) - 1, 0, intervals - 3);
  const double f = x - first;
  const double* e = &table_[static_cast<std::size_t>(first)];
  return e[0] * -(f - 1) * (f - 2) * (f - 3) / 6 + e[1] * f * (f - 2) * (f - 3) / 2 +
         e[2] * -f * (f - 1) * (f - 3) / 2 + e[3] * f * (f - 1) * (f - 2) / 6;
}

}  // namespace shelfbeam::detail
