#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "shelfbeam/material/optics/microfacets.hpp"
#include "shelfbeam/material/optics/scatter_sample.hpp"

namespace shelfbeam {

class Fields;
class JsonCursor;
class KeyRules;
struct ReflectanceKeys;

namespace detail {
class CoatAlbedo;
}

/// A clear dielectric coat, smooth or of microfacets (2.23), over a Lambertian base:
///
///     f = f_coat + rho (1 - E(i)) (1 - E(o)) / (pi ior^2 (1 - rho F_int))
///
/// E is the albedo of the coat alone, and F_int = 1 - (1 - E_avg) / ior^2 the share of the base's light that
/// the coat reflects back. The BRDF is reciprocal, and only the base absorbs light. Derivation:
/// docs/methods/materials.md. Construct it with `make_plastic`.
struct Plastic {
  static constexpr std::string_view type_name = "plastic";
  static constexpr std::string_view says = "a clear coat over a diffuse base";

  double ior = 1.5;
  double reflectance = 0.5;           ///< rho of the base
  std::optional<Microfacets> facets;  ///< of the coat; none: smooth
  std::shared_ptr<const detail::CoatAlbedo> coat;
  double base_scale = 0;   ///< rho / (ior^2 (1 - rho F_int))
  double base_albedo = 0;  ///< rho (1 - F_int) / (1 - rho F_int): share of the entering light that leaves

  double eval(const Vec3& wo, const Vec3& wi) const;
  double pdf(const Vec3& wo, const Vec3& wi) const;
  std::optional<ScatterSample> sample(const Vec3& wo, double u_lobe, double u1, double u2) const;
  double albedo(const Vec3& wo) const;
  double specular_reflectance(const Vec3& wo) const;
  bool has_only_specular() const { return false; }
  bool is_opaque() const { return true; }
  Plastic with_reflectance(double other) const;

  void fields(Fields& f, ReflectanceKeys& keys);
  void check(const JsonCursor& json, KeyRules& rules) const;
  Plastic prepared() const;

  /// The share 1 - E of light that passes the coat. The base alone has the BRDF
  /// transmission(wo.z) base_scale / pi transmission(wi.z).
  double transmission(double cosine) const;
  /// Samples the coat alone; the weight is f_coat cos / density, or the reflectance of a smooth coat.
  std::optional<ScatterSample> sample_coat(const Vec3& wo, double u1, double u2) const;

 private:
  double coat_probability(const Vec3& wo) const;
};

/// Throws std::invalid_argument unless the index is from 1 to 4, the reflectance from 0 to 1 and the facets
/// are isotropic. Tabulates a rough coat, which takes some milliseconds; copies share the table.
Plastic make_plastic(double ior, double reflectance, const std::optional<Microfacets>& facets = std::nullopt);

}  // namespace shelfbeam
