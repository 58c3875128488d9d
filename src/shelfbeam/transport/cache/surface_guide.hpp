#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "shelfbeam/material/material.hpp"

namespace shelfbeam {

/// A smooth function of a cosine, from 0 to 1, as the polynomial through seven points of it, in Newton's
/// form: vectorised code evaluates it where a table would be slow.
struct CosineCurve {
  static constexpr std::size_t nodes = 7;
  using Values = std::array<float, nodes>;
  /// The cosines of these points, Chebyshev's: cos^2((k + 1/2) pi / 14).
  static constexpr Values at{0.98746396F, 0.89091574F, 0.71694187F, 0.50000000F,
                             0.28305813F, 0.10908426F, 0.01253604F};

  template <class Function>
  static CosineCurve through(const Function& function) {
    std::array<double, nodes> difference{};
    for (std::size_t k = 0; k < nodes; ++k) difference[k] = function(static_cast<double>(at[k]));
    for (std::size_t order = 1; order < nodes; ++order)
      for (std::size_t k = nodes - 1; k >= order; --k)
        difference[k] = (difference[k] - difference[k - 1]) / static_cast<double>(at[k] - at[k - order]);
    CosineCurve curve;
    for (std::size_t k = 0; k < nodes; ++k) curve.factor[k] = static_cast<float>(difference[k]);
    return curve;
  }

  Values factor{};
};

/// What vectorised code has of a material: its facets, and curves of cosines.
struct LaneMaterial {
  float alpha2 = 1;  ///< product of the roughness along the surface's x, alpha_x, and across, alpha_y
  float narrow = 1, skew = 0;   ///< alpha_x / alpha_y, and alpha_y / alpha_x less that
  float across2 = 1, more = 0;  ///< alpha_y^2, and alpha_x^2 less that
  bool is_beckmann = false;     ///< D is Beckmann's, else that of GGX
  CosineCurve entry;            ///< share of light that gets into the base
  CosineCurve fresnel;
};

/// How a point of a surface scatters light towards one direction o: radiance per irradiance from a unit in
/// direction l is base x entry(cos l), and the highlight of facets (2.23).
struct LaneScatter {
  float ox = 0, oy = 0, oz = 0, on = 0;  ///< o, and its cosine
  float base = 0;
  float highlight = 0;           ///< G1(o) / (4 cos o), 0 without one
  float tx = 0, ty = 0, tz = 0;  ///< x of the surface (Frame::of_surface) where its roughness has a direction
  const LaneMaterial* material = nullptr;
};

/// What the control variate of the reuse estimator takes a material to do. The light of a base (Lambertian,
/// under a coat or not) looks the same from everywhere but for the share exit(cos) that leaves: all who see a
/// point can use it. The rest, a highlight, goes one way.
class SurfaceGuide {
 public:
  /// `material` must outlive the guide.
  explicit SurfaceGuide(const Material& material);

  /// Radiance per irradiance, the same in every direction: all there is to know unless `is_detailed`.
  float flat() const { return flat_; }
  bool has_base() const { return has_base_; }
  bool is_detailed() const { return is_detailed_; }
  /// Whether a unit's light may leave otherwise than by the base.
  bool has_highlight() const { return has_highlight_; }
  /// Whether a unit's light can leave in ways of which the guide says nothing.
  bool is_loose() const { return is_loose_; }

  /// Share of the base's light that leaves in a direction with this cosine.
  double exit(double cosine) const { return plastic_ == nullptr ? 1 : plastic_->transmission(cosine); }
  /// f_r of the base without its exit (1/sr), for light that arrives with this cosine.
  double base(double cosine) const {
    return plastic_ == nullptr ? base_ : base_ * plastic_->transmission(cosine);
  }
  /// The same without either.
  double bare_base() const { return base_; }
  /// Share of the irradiance that leaves by the base, without the exit.
  double base_albedo() const { return base_albedo_; }
  /// `exit` is that of the direction.
  LaneScatter towards(const Vec3& outgoing, const Vec3& normal, double exit) const;

 private:
  const Plastic* plastic_;
  float flat_ = 0;
  bool has_base_ = false, is_detailed_ = false, has_highlight_ = false, is_loose_ = false;
  double base_ = 0, base_albedo_ = 0;
  std::optional<Microfacets> facets_;  ///< as LaneMaterial has them
  LaneMaterial lane_;
};

}  // namespace shelfbeam
