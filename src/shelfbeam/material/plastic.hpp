#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "shelfbeam/material/optics/microfacets.hpp"
#include "shelfbeam/material/optics/scatter_sample.hpp"

namespace shelfbeam {

class JsonCursor;
struct MaterialWriter;

namespace detail {
class CoatAlbedo;
}

/// A clear dielectric coat, smooth or of microfacets (2.23), over a Lambertian base:
///
///     f = f_coat + rho (1 - E(i)) (1 - E(o)) / (pi ior^2 (1 - rho F_int))
///
/// E is the coat's own albedo and F_int = 1 - (1 - E_avg) / ior^2 what the coat sends back of the base's
/// light. Reciprocal, and 1 - albedo is what the base absorbs; derived in docs/methods/materials.md. Make it
/// with `make_plastic`.
struct Plastic {
  static constexpr std::string_view type_name = "plastic";

  double ior = 1.5;
  double reflectance = 0.5;           ///< rho of the base
  std::optional<Microfacets> facets;  ///< of the coat; none: smooth
  std::shared_ptr<const detail::CoatAlbedo> coat;
  double base_scale = 0;   ///< rho / (ior^2 (1 - rho F_int))
  double base_albedo = 0;  ///< rho (1 - F_int) / (1 - rho F_int): what leaves of the light that enters

  double eval(const Vec3& known, const Vec3& sampled) const;
  double pdf(const Vec3& known, const Vec3& sampled) const;
  std::optional<ScatterSample> sample(const Vec3& known, double u_lobe, double u1, double u2) const;
  double albedo(const Vec3& known) const;
  double specular_reflectance(const Vec3& known) const;
  bool has_only_specular() const { return false; }
  bool is_opaque() const { return true; }
  Plastic with_reflectance(double other) const;

  static Plastic read(const JsonCursor& json, double wavelength_nm);
  void write(MaterialWriter& writer) const;

  /// The base by itself is transmission(known.z) base_scale / pi transmission(sampled.z): the share 1 - E of
  /// light that passes the coat.
  double transmission(double cosine) const;
  /// Draws from the coat alone; the weight is f_coat cos / density, or the reflectance of a smooth one.
  std::optional<ScatterSample> sample_coat(const Vec3& known, double u1, double u2) const;

 private:
  double coat_probability(const Vec3& known) const;
};

/// Throws std::invalid_argument unless the index is from 1 to 4, the reflectance from 0 to 1 and the facets
/// isotropic. Tabulates a rough coat, which takes some milliseconds; copies share the table.
Plastic make_plastic(double ior, double reflectance, const std::optional<Microfacets>& facets = std::nullopt);

}  // namespace shelfbeam
