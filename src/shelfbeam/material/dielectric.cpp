#include "shelfbeam/material/dielectric.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/material/material_fields.hpp"
#include "shelfbeam/material/optics/fresnel.hpp"

namespace shelfbeam {

namespace {

// The facet that reflects or refracts light from `s` to `w`.
struct Facet {
  Vec3 h;
  double share;     // reflected (F) or refracted (1 - F) share
  double jacobian;  // solid angle of h over solid angle of s
};

std::optional<Facet> facet_between(const Vec3& w, const Vec3& s, double eta) {
  const bool reflects = s.z > 0;
  const Vec3 sum = reflects ? w + s : w + s * eta;
  if (sum == Vec3{}) return std::nullopt;
  const Vec3 h = normalized(sum.z > 0 ? sum : -sum);
  const double wh = dot(w, h), sh = dot(s, h);
  if (wh <= 0 || (sh > 0) != reflects) return std::nullopt;
  const double reflectance = fresnel_dielectric(wh, eta);
  if (reflects) return Facet{h, reflectance, 1 / (4 * wh)};
  const double both = wh + eta * sh;
  return Facet{h, 1 - reflectance, eta * eta * std::abs(sh) / (both * both)};
}

}  // namespace

double Dielectric::eval(const Vec3& wo, const Vec3& wi) const {
  if (!facets) return 0;
  const auto facet = facet_between(wo, wi, ior);
  if (!facet) return 0;
  return facet->share * facets->density(facet->h) * facets->shadowing(wo, wi, facet->h) * dot(wo, facet->h) *
         facet->jacobian / std::abs(wo.z * wi.z);
}

double Dielectric::pdf(const Vec3& wo, const Vec3& wi) const {
  if (!facets) return 0;
  const auto facet = facet_between(wo, wi, ior);
  return facet ? facet->share * facets->pdf(wo, facet->h) * facet->jacobian : 0;
}

std::optional<ScatterSample> Dielectric::sample(const Vec3& wo, double u_lobe, double u1, double u2) const {
  const Vec3 h = facets ? facets->sample(wo, u1, u2) : Vec3{0, 0, 1};
  const double wh = dot(wo, h);
  if (wh <= 0) return std::nullopt;
  const double reflectance = fresnel_dielectric(wh, ior);
  const bool reflects = u_lobe < reflectance;
  const auto direction = reflects ? std::optional(detail::reflected(wo, h)) : detail::refracted(wo, h, ior);
  if (!direction || direction->z == 0 || (direction->z > 0) != reflects) return std::nullopt;
  if (!facets) return ScatterSample{*direction, 1, reflects ? reflectance : 1 - reflectance, true};
  return ScatterSample{*direction, facets->weight(wo, *direction, h), pdf(wo, *direction)};
}

double Dielectric::albedo(const Vec3& wo) const {
  if (!facets) return 1;
  const double share = facets->integrate(wo, [&](const Vec3& h) {
    const double reflectance = fresnel_dielectric(dot(wo, h), ior);
    const Vec3 mirrored = detail::reflected(wo, h);
    const auto through = detail::refracted(wo, h, ior);
    return (mirrored.z > 0 ? reflectance * facets->shadowing(wo, mirrored, h) : 0) +
           (through && through->z < 0 ? (1 - reflectance) * facets->shadowing(wo, *through, h) : 0);
  });
  return std::min(1.0, share);  // quadrature error
}

double Dielectric::specular_reflectance(const Vec3& wo) const {
  return facets ? 0 : fresnel_dielectric(wo.z, ior);
}

void Dielectric::fields(Fields& f, ReflectanceKeys&) {
  describe_ior(f, ior, "index of refraction inside; at least 1.01 if rough");
  describe_facets(f, facets, {.refracts = true});
}

void Dielectric::check(const JsonCursor& json, KeyRules& rules) const {
  check_facets(facets, json, rules);
  rules.rule({"ior"}, [&] {
    if (facets) json["ior"].number(1.01, detail::largest_ior);
  });
}

Dielectric Dielectric::prepared() const {
  return make_dielectric(ior, prepared_facets(facets));
}

Dielectric make_dielectric(double ior, const std::optional<Microfacets>& facets) {
  detail::require_range("ior", ior, facets ? 1.01 : 1, detail::largest_ior);
  if (facets && facets->masking == Masking::cook_torrance)
    throw std::invalid_argument("cook-torrance masking is only defined for reflection");
  return {ior, facets};
}

}  // namespace shelfbeam
