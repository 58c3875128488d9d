#include "shelfbeam/material/thin_dielectric.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/material/material_fields.hpp"
#include "shelfbeam/material/optics/fresnel.hpp"

namespace shelfbeam {

PaneShares pane_shares(const ThinDielectric& pane, double cos_theta) {
  const double cos_i = std::min(1.0, std::abs(cos_theta));
  const double f = fresnel_dielectric(cos_i, pane.ior);
  const double cos_t = std::sqrt(1 - (1 - cos_i * cos_i) / (pane.ior * pane.ior));
  if (f >= 1 || cos_t <= 0) return {1, 0};
  // `once` is the transmittance of one crossing. Each face reflects `f` on both sides (geometric series).
  const double once = std::exp(-pane.absorption_per_m * pane.thickness / cos_t);
  const double transmitted = (1 - f) * (1 - f) * once / (1 - f * f * once * once);
  return {f + f * once * transmitted, transmitted};
}

std::optional<ScatterSample> ThinDielectric::sample(const Vec3& wo, double u_lobe, double, double) const {
  const auto [r, t] = pane_shares(*this, wo.z);
  const double share = r + t;
  if (share <= 0) return std::nullopt;
  if (u_lobe * share < r) return ScatterSample{detail::reflected(wo, {0, 0, 1}), share, r / share, true};
  return ScatterSample{-wo, share, t / share, true};
}

double ThinDielectric::albedo(const Vec3& wo) const {
  const auto [r, t] = pane_shares(*this, wo.z);
  return r + t;
}

double ThinDielectric::specular_reflectance(const Vec3& wo) const {
  return pane_shares(*this, wo.z).reflected;
}

void ThinDielectric::fields(Fields& f, ReflectanceKeys&) {
  describe_ior(f, ior, "index of refraction");
  f.scalar("thickness", Scalar::distance, thickness,
           {.says = "thickness of the pane", .most = 1, .is_optional = true});
  f.scalar("absorption_per_m", Scalar::number, absorption_per_m,
           {.says = "light falls to exp(-`absorption_per_m` x length) along its path in the glass; requires "
                    "`thickness`",
            .least = 0,
            .most = 1e6,
            .unit = "1/m",
            .is_optional = true});
}

void ThinDielectric::check(const JsonCursor& json, KeyRules& rules) const {
  rules.rule({}, [&] {
    if (json.find("absorption_per_m") && !json.find("thickness"))
      json.fail("has 'absorption_per_m', but no 'thickness'", "add it");
  });
}

ThinDielectric ThinDielectric::prepared() const {
  return make_thin_dielectric(ior, thickness, absorption_per_m);
}

ThinDielectric make_thin_dielectric(double ior, double thickness, double absorption_per_m) {
  detail::require_range("ior", ior, 1, detail::largest_ior);
  detail::require_range("thickness", thickness, 0, 1);
  detail::require_range("absorption_per_m", absorption_per_m, 0, 1e6);
  return {ior, thickness, absorption_per_m};
}

}  // namespace shelfbeam
