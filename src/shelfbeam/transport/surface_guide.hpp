#pragma once

#include <array>
#include <cstddef>

#include "shelfbeam/material/material.hpp"
#include "shelfbeam/transport/unit_groups.hpp"

namespace shelfbeam {

/// A smooth function of a cosine from 0 to 1 by a polynomial through seven points of it, in Newton's form.
struct CosineCurve {
  static constexpr std::size_t nodes = 7;
  static const std::array<float, nodes> at;  ///< Chebyshev's

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

  std::array<float, nodes> factor{};
};

/// How a point of a surface scatters light towards one direction, for the vectorised code: radiance per
/// irradiance from the unit direction l is `base` times entry(cos l) plus the highlight of GGX facets.
struct LaneScatter {
  float ox = 0, oy = 0, oz = 0, on = 0;  ///< where the light goes, and its cosine
  float base = 0, lobe = 0;              ///< lobe: G1(o) / (4 cos o), 0 without a highlight
  float alpha2 = 1;
  CosineCurve entry, fresnel;
};

/// What the control variate of the reuse estimator takes a material to do. Light from a base, Lambertian
/// under a coat or not, looks the same from everywhere but for the factor exit(cos): it can be shared by
/// all who see the point. The rest, highlights, belongs to one direction.
class SurfaceGuide {
 public:
  explicit SurfaceGuide(const Material& material);

  /// Radiance per irradiance in every direction; all there is to know unless `is_coated`.
  float flat() const { return flat_; }
  bool has_base() const { return has_base_; }
  /// Whether `at` tells more than `flat`.
  bool is_coated() const { return is_coated_; }
  /// Of a coat with nothing that a unit's light could be asked for: smooth, or none.
  bool knows_all() const { return knows_all_; }

  /// Share of the base's light that leaves in a direction with this cosine.
  double exit(double cosine) const { return plastic_ == nullptr ? 1 : plastic_->transmission(cosine); }
  /// f of the base without its exit, for light that arrives with this cosine.
  double base(double cosine) const {
    return plastic_ == nullptr ? base_ : base_ * plastic_->transmission(cosine);
  }
  /// f of the base without either.
  double base() const { return base_; }
  const Plastic* plastic() const { return plastic_; }
  /// Share of the irradiance that leaves the base, without the exit.
  double base_albedo() const { return base_albedo_; }
  /// Share that the coat reflects, mirrors apart, of light from a direction with this cosine.
  double lobe_albedo(double cosine) const;

  LaneScatter at(const Vec3& normal, const Vec3& outgoing) const;

 private:
  const Plastic* plastic_ = nullptr;
  float flat_ = 0;
  bool has_base_ = false, is_coated_ = false, knows_all_ = false, has_lobe_ = false;
  double base_ = 0, base_albedo_ = 0, alpha_ = 1;
  CosineCurve entry_, fresnel_;
};

}  // namespace shelfbeam
