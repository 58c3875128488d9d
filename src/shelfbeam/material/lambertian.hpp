#pragma once

#include <optional>
#include <string_view>

#include "shelfbeam/material/optics/scatter_sample.hpp"

namespace shelfbeam {

class Fields;
class JsonCursor;
class KeyRules;
struct ReflectanceKeys;

/// Ideal diffuse reflection, f_r = rho / pi (2.21).
struct Lambertian {
  static constexpr std::string_view type_name = "lambertian";
  static constexpr std::string_view says = "ideal diffuse reflection";

  double reflectance = 0;  ///< rho, the hemispherical reflectance at the store's wavelength, in [0, 1]

  double eval(const Vec3& wo, const Vec3& wi) const;
  double pdf(const Vec3& wo, const Vec3& wi) const;
  std::optional<ScatterSample> sample(const Vec3& wo, double u_lobe, double u1, double u2) const;
  double albedo(const Vec3&) const { return reflectance; }
  double specular_reflectance(const Vec3&) const { return 0; }
  bool has_only_specular() const { return false; }
  bool is_opaque() const { return true; }
  Lambertian with_reflectance(double other) const;

  /// Describes the keys in a store file except "type" (material_fields.hpp).
  void fields(Fields& f, ReflectanceKeys& keys);
  /// Checks the rules that tie keys together; `prepared` is the material with these values, for use.
  void check(const JsonCursor& json, KeyRules& rules) const;
  Lambertian prepared() const;
};

/// Throws std::invalid_argument unless the reflectance is in [0, 1].
Lambertian make_lambertian(double reflectance);

}  // namespace shelfbeam
