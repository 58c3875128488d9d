#include "shelfbeam/material/lambertian.hpp"

#include "shelfbeam/material/material_fields.hpp"
#include "shelfbeam/material/optics/fresnel.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

double Lambertian::eval(const Vec3&, const Vec3& wi) const {
  return wi.z > 0 ? reflectance / pi : 0;
}

double Lambertian::pdf(const Vec3&, const Vec3& wi) const {
  return pdf_cosine_hemisphere(wi);
}

std::optional<ScatterSample> Lambertian::sample(const Vec3&, double, double u1, double u2) const {
  if (reflectance <= 0) return std::nullopt;
  const Vec3 direction = sample_cosine_hemisphere(u1, u2);
  return ScatterSample{direction, reflectance, pdf_cosine_hemisphere(direction)};
}

Lambertian Lambertian::with_reflectance(double other) const {
  return make_lambertian(other);
}

void Lambertian::fields(Fields& f, ReflectanceKeys& keys) {
  describe_reflectance(f, reflectance, keys, "share of the power that is [reflected](#reflectance)");
}

void Lambertian::check(const JsonCursor&, KeyRules&) const {}

Lambertian Lambertian::prepared() const {
  return make_lambertian(reflectance);
}

Lambertian make_lambertian(double reflectance) {
  detail::require_range("reflectance", reflectance, 0, 1);
  return {reflectance};
}

}  // namespace shelfbeam
