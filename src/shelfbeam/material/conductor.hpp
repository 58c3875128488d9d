#pragma once

#include <optional>
#include <string_view>

#include "shelfbeam/material/optics/microfacets.hpp"
#include "shelfbeam/material/optics/scatter_sample.hpp"

namespace shelfbeam {

class JsonCursor;
struct MaterialWriter;

/// Metal: a mirror, or microfacets (2.23), with the Fresnel reflectance of the complex index eta + i k
/// (2.32).
struct Conductor {
  static constexpr std::string_view type_name = "conductor";

  double eta = 0, k = 0;
  std::optional<Microfacets> facets;  ///< none: smooth

  double eval(const Vec3& known, const Vec3& sampled) const;
  double pdf(const Vec3& known, const Vec3& sampled) const;
  std::optional<ScatterSample> sample(const Vec3& known, double u_lobe, double u1, double u2) const;
  double albedo(const Vec3& known) const;
  double specular_reflectance(const Vec3& known) const;
  bool has_only_specular() const { return !facets; }
  bool is_opaque() const { return true; }

  static Conductor read(const JsonCursor& json, double wavelength_nm);
  void write(MaterialWriter& writer) const;
};

/// Throws std::invalid_argument unless eta and k are from 0 to 100 and not both 0. An ideal mirror is eta =
/// 0, k = 1.
Conductor make_conductor(double eta, double k, const std::optional<Microfacets>& facets = std::nullopt);

}  // namespace shelfbeam
