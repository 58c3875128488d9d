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

/// Metal: a mirror, or microfacets (2.23), with the Fresnel reflectance of the index eta + i k (2.32).
struct Conductor {
  static constexpr std::string_view type_name = "conductor";
  static constexpr std::string_view says =
      "metal with the complex index of refraction eta + i k, smooth (a mirror) or rough";

  double eta = 0, k = 0;
  std::optional<Microfacets> facets;  ///< none: smooth

  double eval(const Vec3& wo, const Vec3& wi) const;
  double pdf(const Vec3& wo, const Vec3& wi) const;
  std::optional<ScatterSample> sample(const Vec3& wo, double u_lobe, double u1, double u2) const;
  double albedo(const Vec3& wo) const;
  double specular_reflectance(const Vec3& wo) const;
  bool has_only_specular() const { return !facets; }
  bool is_opaque() const { return true; }

  void fields(Fields& f, ReflectanceKeys& keys);
  void check(const JsonCursor& json, KeyRules& rules) const;
  Conductor prepared() const;
};

/// Throws std::invalid_argument unless eta and k are from 0 to 100 and not both 0. An ideal mirror has
/// eta = 0 and k = 1.
Conductor make_conductor(double eta, double k, const std::optional<Microfacets>& facets = std::nullopt);

}  // namespace shelfbeam
