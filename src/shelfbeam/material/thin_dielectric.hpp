#pragma once

#include <optional>
#include <string_view>

#include "shelfbeam/material/optics/scatter_sample.hpp"

namespace shelfbeam {

class Fields;
class JsonCursor;
class KeyRules;
struct ReflectanceKeys;

/// A pane of glass as a single surface. It reflects as a mirror, transmits without displacement and absorbs;
/// all reflections between its two faces are summed.
struct ThinDielectric {
  static constexpr std::string_view type_name = "thin_dielectric";
  static constexpr std::string_view says = "a pane as a single surface: a door, a glass shelf";

  double ior = 1.5;
  double thickness = 0;         ///< m
  double absorption_per_m = 0;  ///< along the ray in the glass: exp(-absorption_per_m x length)

  double eval(const Vec3&, const Vec3&) const { return 0; }
  double pdf(const Vec3&, const Vec3&) const { return 0; }
  std::optional<ScatterSample> sample(const Vec3& wo, double u_lobe, double u1, double u2) const;
  double albedo(const Vec3& wo) const;  ///< reflected and transmitted share
  double specular_reflectance(const Vec3& wo) const;
  bool has_only_specular() const { return true; }
  bool is_opaque() const { return false; }

  void fields(Fields& f, ReflectanceKeys& keys);
  void check(const JsonCursor& json, KeyRules& rules) const;
  ThinDielectric prepared() const;
};

/// Throws std::invalid_argument unless the index is from 1 to 4, the thickness from 0 to 1 m and the
/// absorption from 0 to 1e6 per metre.
ThinDielectric make_thin_dielectric(double ior, double thickness, double absorption_per_m);

/// Shares of the light that the pane reflects and transmits at this cosine to its normal, from either side.
struct PaneShares {
  double reflected = 0, transmitted = 0;
};
PaneShares pane_shares(const ThinDielectric& pane, double cos_theta);

}  // namespace shelfbeam
