#include "shelfbeam/material/conductor.hpp"

#include <algorithm>
#include <stdexcept>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/material/material_fields.hpp"
#include "shelfbeam/material/optics/fresnel.hpp"

namespace shelfbeam {

double Conductor::eval(const Vec3& wo, const Vec3& wi) const {
  if (!facets || wi.z <= 0) return 0;
  const Vec3 h = normalized(wo + wi);
  return fresnel_conductor(dot(wo, h), eta, k) * facets->reflection(wo, wi, h);
}

double Conductor::pdf(const Vec3& wo, const Vec3& wi) const {
  if (!facets || wi.z <= 0) return 0;
  return facets->reflection_pdf(wo, normalized(wo + wi));
}

std::optional<ScatterSample> Conductor::sample(const Vec3& wo, double, double u1, double u2) const {
  if (!facets) return ScatterSample{detail::reflected(wo, {0, 0, 1}), specular_reflectance(wo), 1, true};
  return detail::sample_reflection(*facets, wo, u1, u2,
                                   [&](double cosine) { return fresnel_conductor(cosine, eta, k); });
}

double Conductor::albedo(const Vec3& wo) const {
  if (!facets) return specular_reflectance(wo);
  const double share = facets->integrate(wo, [&](const Vec3& h) {
    const Vec3 s = detail::reflected(wo, h);
    return s.z > 0 ? fresnel_conductor(dot(wo, h), eta, k) * facets->shadowing(wo, s, h) : 0;
  });
  return std::min(1.0, share);  // quadrature error
}

double Conductor::specular_reflectance(const Vec3& wo) const {
  return facets ? 0 : fresnel_conductor(wo.z, eta, k);
}

void Conductor::fields(Fields& f, ReflectanceKeys&) {
  f.scalar("eta", Scalar::number, eta,
           {.says = "real part of the index of refraction; not 0 if `k` is 0", .least = 0, .most = 100});
  f.scalar("k", Scalar::number, k,
           {.says = "imaginary part; `eta` 0 and `k` 1 give an ideal mirror", .least = 0, .most = 100});
  describe_facets(f, facets, {});
}

void Conductor::check(const JsonCursor& json, KeyRules& rules) const {
  rules.rule({"eta", "k"}, [&] {
    if (eta == 0 && k == 0) json.fail("has eta and k of 0", "an ideal mirror has eta 0 and k 1");
  });
  check_facets(facets, json, rules);
}

Conductor Conductor::prepared() const {
  return make_conductor(eta, k, prepared_facets(facets));
}

Conductor make_conductor(double eta, double k, const std::optional<Microfacets>& facets) {
  detail::require_range("eta", eta, 0, 100);
  detail::require_range("k", k, 0, 100);
  if (eta + k == 0) throw std::invalid_argument("eta and k are both 0; an ideal mirror has eta 0 and k 1");
  return {eta, k, facets};
}

}  // namespace shelfbeam
