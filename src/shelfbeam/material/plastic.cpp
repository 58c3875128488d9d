#include "shelfbeam/material/plastic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "shelfbeam/material/material_fields.hpp"
#include "shelfbeam/material/optics/fresnel.hpp"
#include "shelfbeam/material/optics/microfacets.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

// The limit at the horizon is finite; a direction just above the horizon approximates it.
constexpr double min_cosine = 1e-6;

double rough_albedo(double ior, const Microfacets& facets, double cos_theta) {
  const double z = std::max(min_cosine, cos_theta);
  const Vec3 w{std::sqrt(1 - z * z), 0, z};
  const auto value = [&](const Vec3& h) {
    const Vec3 s = detail::reflected(w, h);
    return s.z > 0 ? fresnel_dielectric(dot(w, h), ior) * facets.shadowing(w, s, h) : 0;
  };
  return facets.integrate(w, value, 96);
}

}  // namespace

/// E(cos theta): share of the light from one direction that a dielectric coat reflects before it enters.
/// Closed form for a smooth coat; a table for an isotropic rough coat, with an error below 2e-4 (4e-4 for
/// roughness below 0.05).
class detail::CoatAlbedo {
 public:
  CoatAlbedo(double ior, const std::optional<Microfacets>& facets)
      : ior_(ior),
        smooth_(!facets),
        alpha_(facets ? facets->alpha_x : 0.1),
        step_(std::asinh(1 / alpha_) / intervals) {
    if (facets)
      for (int k = 0; k <= intervals; ++k)
        table_[static_cast<std::size_t>(k)] = rough_albedo(ior, *facets, std::min(1.0, cosine(k * step_)));

    // Integral of 2 E mu dmu by Gauss-Legendre quadrature with four points per interval.
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

  double at(double cos_theta) const {
    if (smooth_) return fresnel_dielectric(std::min(1.0, cos_theta), ior_);
    // Cubic through four neighbours (Lagrange's form, one-sided at the ends). This asinh is faster than the
    // library's, because it neglects the precision of small numbers, which do not matter here.
    const double c = std::clamp(cos_theta, 0.0, 1.0) / alpha_;
    const double x = std::log(c + std::sqrt(c * c + 1)) / step_;
    const int first = std::clamp(static_cast<int>(x) - 1, 0, intervals - 3);
    const double f = x - first;
    const double* e = &table_[static_cast<std::size_t>(first)];
    return e[0] * -(f - 1) * (f - 2) * (f - 3) / 6 + e[1] * f * (f - 2) * (f - 3) / 2 +
           e[2] * -f * (f - 1) * (f - 3) / 2 + e[3] * f * (f - 1) * (f - 2) / 6;
  }
  /// Cosine-weighted mean, 2 integral of E mu dmu: exact for the interpolation of `at`.
  double average() const { return average_; }

 private:
  static constexpr int intervals = 48;

  // Nodes are equidistant in x = asinh(cos(theta) / alpha): E changes on the scale of alpha at grazing angles
  // and more and more slowly towards the normal.
  double cosine(double x) const { return alpha_ * std::sinh(x); }

  double ior_;
  bool smooth_;
  double alpha_, step_;
  std::array<double, intervals + 1> table_{};
  double average_ = 0;
};

double Plastic::eval(const Vec3& wo, const Vec3& wi) const {
  if (wi.z <= 0) return 0;
  const double base = base_scale / pi * transmission(wo.z) * transmission(wi.z);
  if (!facets) return base;
  const Vec3 h = normalized(wo + wi);
  return base + fresnel_dielectric(dot(wo, h), ior) * facets->reflection(wo, wi, h);
}

double Plastic::pdf(const Vec3& wo, const Vec3& wi) const {
  if (wi.z <= 0) return 0;
  const double p = coat_probability(wo);
  const double base = (1 - p) * pdf_cosine_hemisphere(wi);
  return facets ? base + p * facets->reflection_pdf(wo, normalized(wo + wi)) : base;
}

std::optional<ScatterSample> Plastic::sample(const Vec3& wo, double u_lobe, double u1, double u2) const {
  const double p = coat_probability(wo);
  Vec3 direction;
  if (u_lobe >= p) {
    direction = sample_cosine_hemisphere(u1, u2);
  } else if (facets) {
    direction = detail::reflected(wo, facets->sample(wo, u1, u2));
  } else {
    return ScatterSample{detail::reflected(wo, {0, 0, 1}), specular_reflectance(wo) / p, p, true};
  }
  const double density = pdf(wo, direction);
  if (direction.z <= 0 || density <= 0) return std::nullopt;
  return ScatterSample{direction, eval(wo, direction) * direction.z / density, density};
}

double Plastic::transmission(double cosine) const {
  return 1 - coat->at(cosine);
}

std::optional<ScatterSample> Plastic::sample_coat(const Vec3& wo, double u1, double u2) const {
  if (!facets) return ScatterSample{detail::reflected(wo, {0, 0, 1}), specular_reflectance(wo), 1, true};
  return detail::sample_reflection(*facets, wo, u1, u2,
                                   [&](double cosine) { return fresnel_dielectric(cosine, ior); });
}

double Plastic::albedo(const Vec3& wo) const {
  const double e = coat->at(wo.z);
  return e + (1 - e) * base_albedo;
}

double Plastic::specular_reflectance(const Vec3& wo) const {
  return facets ? 0 : coat->at(wo.z);
}

double Plastic::coat_probability(const Vec3& wo) const {
  const double e = coat->at(wo.z), base = (1 - e) * base_albedo;
  return e > 0 ? e / (e + base) : 0;
}

Plastic Plastic::with_reflectance(double other) const {
  return make_plastic(ior, other, facets);
}

void Plastic::fields(Fields& f, ReflectanceKeys& keys) {
  describe_ior(f, ior, "index of refraction of the coat");
  describe_reflectance(f, reflectance, keys, "[reflectance](#reflectance) of the base under the coat");
  describe_facets(f, facets, {.has_directions = false});
}

void Plastic::check(const JsonCursor& json, KeyRules& rules) const {
  check_facets(facets, json, rules);
}

Plastic Plastic::prepared() const {
  return make_plastic(ior, reflectance, prepared_facets(facets));
}

Plastic make_plastic(double ior, double reflectance, const std::optional<Microfacets>& facets) {
  detail::require_range("ior", ior, 1, detail::largest_ior);
  detail::require_range("reflectance", reflectance, 0, 1);
  if (facets && !facets->isotropic()) throw std::invalid_argument("the coat of plastic must be isotropic");
  auto coat = std::make_shared<const detail::CoatAlbedo>(ior, facets);
  const double f_int = 1 - (1 - coat->average()) / (ior * ior);
  const double scale = reflectance / (1 - reflectance * f_int);
  return {ior, reflectance, facets, std::move(coat), scale / (ior * ior), scale * (1 - f_int)};
}

}  // namespace shelfbeam
