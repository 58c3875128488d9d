#include "shelfbeam/material/plastic.hpp"

#include <stdexcept>

#include "shelfbeam/material/optics/coat_albedo.hpp"
#include "shelfbeam/material/optics/directions.hpp"
#include "shelfbeam/material/optics/facet_reflection.hpp"
#include "shelfbeam/material/optics/fresnel.hpp"
#include "shelfbeam/material/optics/require.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

double Plastic::eval(const Vec3& known, const Vec3& sampled) const {
  if (sampled.z <= 0) return 0;
  const double base = base_scale / pi * transmission(known.z) * transmission(sampled.z);
  if (!facets) return base;
  const Vec3 h = normalized(known + sampled);
  return base + fresnel_dielectric(dot(known, h), ior) * facets->reflection(known, sampled, h);
}

double Plastic::pdf(const Vec3& known, const Vec3& sampled) const {
  if (sampled.z <= 0) return 0;
  const double p = coat_probability(known);
  const double base = (1 - p) * pdf_cosine_hemisphere(sampled);
  return facets ? base + p * facets->reflection_pdf(known, normalized(known + sampled)) : base;
}

std::optional<ScatterSample> Plastic::sample(const Vec3& known, double u_lobe, double u1, double u2) const {
  const double p = coat_probability(known);
  Vec3 direction;
  if (u_lobe >= p) {
    direction = sample_cosine_hemisphere(u1, u2);
  } else if (facets) {
    direction = detail::reflected(known, facets->sample(known, u1, u2));
  } else {
    return ScatterSample{detail::reflected(known, {0, 0, 1}), specular_reflectance(known) / p, p, true};
  }
  const double density = pdf(known, direction);
  if (direction.z <= 0 || density <= 0) return std::nullopt;
  return ScatterSample{direction, eval(known, direction) * direction.z / density, density};
}

double Plastic::transmission(double cosine) const {
  return 1 - coat->at(cosine);
}

std::optional<ScatterSample> Plastic::sample_coat(const Vec3& known, double u1, double u2) const {
  if (!facets)
    return ScatterSample{detail::reflected(known, {0, 0, 1}), specular_reflectance(known), 1, true};
  return detail::sample_reflection(*facets, known, u1, u2,
                                   [&](double cosine) { return fresnel_dielectric(cosine, ior); });
}

double Plastic::albedo(const Vec3& known) const {
  const double e = coat->at(known.z);
  return e + (1 - e) * base_albedo;
}

double Plastic::specular_reflectance(const Vec3& known) const {
  return facets ? 0 : coat->at(known.z);
}

double Plastic::coat_probability(const Vec3& known) const {
  const double e = coat->at(known.z), base = (1 - e) * base_albedo;
  return e > 0 ? e / (e + base) : 0;
}

Plastic Plastic::with_reflectance(double other) const {
  return make_plastic(ior, other, facets);
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
