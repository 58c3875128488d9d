#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "shelfbeam/material/material.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"

namespace shelfbeam {

/// A smooth function of a cosine from 0 to 1: its interpolation polynomial through seven nodes, in Newton's
/// form. Vectorised code evaluates it faster than a table.
struct CosineCurve {
  static constexpr std::size_t nodes = 7;
  using Values = std::array<float, nodes>;
  /// The nodes, Chebyshev's: cos^2((k + 1/2) pi / 14).
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

/// A material for vectorised code: its microfacets, and functions of cosines.
struct LaneMaterial {
  float alpha2 = 1;             ///< alpha_x alpha_y, the roughness along and across the surface's x
  float narrow = 1, skew = 0;   ///< alpha_x / alpha_y, and alpha_y / alpha_x - alpha_x / alpha_y
  float across2 = 1, more = 0;  ///< alpha_y^2, and alpha_x^2 - alpha_y^2
  bool is_beckmann = false;     ///< whether D is Beckmann's, else it is GGX
  CosineCurve entry;            ///< share of light that enters the base
  CosineCurve fresnel;
};

/// How a point of a surface scatters light towards a direction o: the radiance per irradiance from a unit in
/// direction l is base x entry(cos l) plus the highlight of microfacets (2.23).
struct LaneScatter {
  float ox = 0, oy = 0, oz = 0, on = 0;  ///< o, and its cosine
  float base = 0;
  float highlight = 0;           ///< G1(o) / (4 cos o); 0 without a highlight
  float tx = 0, ty = 0, tz = 0;  ///< x of the surface (Frame::of_surface) if its roughness is anisotropic
  const LaneMaterial* material = nullptr;
};

/// The control variate's approximation of a material. Light of the base (Lambertian, with or without a coat)
/// has the same radiance in all directions except for the factor exit(cos), so all receivers that see a point
/// can use it. The rest, the highlight, is directional.
class SurfaceGuide {
 public:
  /// `material` must outlive the guide.
  explicit SurfaceGuide(const Material& material);

  /// Radiance per irradiance, the same in every direction; sufficient unless `is_detailed`.
  float flat() const { return flat_; }
  bool has_base() const { return has_base_; }
  bool is_detailed() const { return is_detailed_; }
  /// Whether a unit's light may leave by lobes other than the base.
  bool has_highlight() const { return has_highlight_; }
  /// Whether a unit's light may leave by lobes that the guide does not include.
  bool is_approximate() const { return is_loose_; }

  /// Whether the base has a smooth coat, which reflects like a mirror.
  bool has_smooth_coat() const { return has_base_ && is_detailed_ && !has_highlight_; }

  /// Exit factor: share of the base's light that leaves in a direction with this cosine.
  double exit(double cosine) const { return plastic_ == nullptr ? 1 : plastic_->transmission(cosine); }
  /// The same in the direction from a point to a position.
  double exit_towards(const SurfacePoint& point, const Vec3& position) const {
    return is_detailed_ ? exit(dot(point.normal, normalized(position - point.position))) : 1;
  }
  /// f_r of the base without its exit factor (1/sr), for light that arrives with this cosine.
  double base(double cosine) const {
    return plastic_ == nullptr ? base_ : base_ * plastic_->transmission(cosine);
  }
  /// f_r of the base with neither exit nor entry factor (1/sr).
  double bare_base() const { return base_; }
  /// Share of the irradiance that leaves by the base, without the exit factor.
  double base_albedo() const { return base_albedo_; }
  /// Scattering towards `outgoing`, whose exit factor is `exit`.
  LaneScatter towards(const Vec3& outgoing, const Vec3& normal, double exit) const;

 private:
  const Plastic* plastic_;
  float flat_ = 0;
  bool has_base_ = false, is_detailed_ = false, has_highlight_ = false, is_loose_ = false;
  double base_ = 0, base_albedo_ = 0;
  std::optional<Microfacets> facets_;  ///< as in LaneMaterial
  LaneMaterial lane_;
};

}  // namespace shelfbeam
