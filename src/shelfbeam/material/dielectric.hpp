#pragma once

#include <optional>
#include <string_view>

#include "shelfbeam/material/optics/microfacets.hpp"
#include "shelfbeam/material/optics/scatter_sample.hpp"

namespace shelfbeam {

class Fields;
class JsonCursor;
class KeyRules;
struct ReflectanceKeys;

/// The surface of a transparent solid in air, which reflects and refracts; smooth (2.32) or rough (2.23 and
/// Walter, Marschner, Li, Torrance, EGSR 2007). Radiance is divided by the square of the index of its medium;
/// see docs/methods/materials.md.
struct Dielectric {
  static constexpr std::string_view type_name = "dielectric";
  static constexpr std::string_view says =
      "the surface of a clear solid that absorbs nothing: a jar, a bottle";

  double ior = 1.5;                   ///< index of refraction below the surface over the one above it
  std::optional<Microfacets> facets;  ///< none: smooth

  double eval(const Vec3& wo, const Vec3& wi) const;
  double pdf(const Vec3& wo, const Vec3& wi) const;
  std::optional<ScatterSample> sample(const Vec3& wo, double u_lobe, double u1, double u2) const;
  double albedo(const Vec3& wo) const;  ///< reflected and refracted share
  double specular_reflectance(const Vec3& wo) const;
  bool has_only_specular() const { return !facets; }
  bool is_opaque() const { return false; }
  Dielectric from_below() const { return {1 / ior, facets}; }

  void fields(Fields& f, ReflectanceKeys& keys);
  void check(const JsonCursor& json, KeyRules& rules) const;
  Dielectric prepared() const;
};

/// Throws std::invalid_argument unless the index is from 1 to 4 (from 1.01 for a rough surface, because
/// without a change of index the half vector is undefined) and the masking is Smith's.
Dielectric make_dielectric(double ior, const std::optional<Microfacets>& facets = std::nullopt);

}  // namespace shelfbeam
