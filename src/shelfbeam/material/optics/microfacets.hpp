#pragma once

#include <array>
#include <functional>

#include "shelfbeam/base/names.hpp"
#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

enum class FacetDistribution { beckmann, ggx };
template <>
inline constexpr auto names_of<FacetDistribution> = std::to_array<Named<FacetDistribution>>(
    {{"ggx", FacetDistribution::ggx}, {"beckmann", FacetDistribution::beckmann}});

enum class Masking {
  smith,           ///< product of G1 (2.27): exact for GGX (2.31), closed form with erf for Beckmann (2.28)
  smith_rational,  ///< Beckmann: the rational approximation of (2.28)
  cook_torrance    ///< parallel grooves (2.26); reflection only
};
template <>
inline constexpr auto names_of<Masking> =
    std::to_array<Named<Masking>>({{"smith", Masking::smith},
                                   {"smith_rational", Masking::smith_rational},
                                   {"cook_torrance", Masking::cook_torrance}});

enum class FacetSampling {
  visible,  ///< distribution of visible normals (Heitz 2018); GGX only
  all       ///< D cos(theta_h): (2.33) to (2.36)
};
template <>
inline constexpr auto names_of<FacetSampling> =
    std::to_array<Named<FacetSampling>>({{"visible", FacetSampling::visible}, {"all", FacetSampling::all}});

/// The statistics of a rough surface (2.8.3). Directions have unit length and are given in the frame of the
/// mean surface (+z is its normal; x and y are the axes of anisotropy). Construct with `make_microfacets`.
struct Microfacets {
  FacetDistribution distribution = FacetDistribution::ggx;
  double alpha_x = 0.3, alpha_y = 0.3;  ///< roughness; Beckmann: sqrt(2) times the rms slope
  Masking masking = Masking::smith;
  FacetSampling sampling = FacetSampling::visible;

  bool isotropic() const { return alpha_x == alpha_y; }

  /// D(h), facets per solid angle (2.24, 2.29); the integral of D cos(theta_h) is 1.
  double density(const Vec3& h) const;
  /// G1(w, h) of (2.28), (2.31): share of the facets h visible from `w`; 0 if `w` sees their back. `w` may
  /// lie below the surface.
  double masking_of(const Vec3& w, const Vec3& h) const;
  /// G(a, b, h) (2.26), (2.27); except for Cook-Torrance, one direction may lie below the surface.
  double shadowing(const Vec3& a, const Vec3& b, const Vec3& h) const;

  /// Samples a facet normal for a viewer at `w`, w.z > 0, who may see only the facet's back.
  Vec3 sample(const Vec3& w, double u1, double u2) const;
  /// Density per solid angle of `sample`.
  double pdf(const Vec3& w, const Vec3& h) const;
  /// Torrance-Sparrow (2.23) without its Fresnel term, D G / (4 cos cos); `h` is the half vector (2.22).
  double reflection(const Vec3& a, const Vec3& b, const Vec3& h) const;
  /// Density per solid angle of the mirror images of `w` in the sampled facets.
  double reflection_pdf(const Vec3& w, const Vec3& h) const;
  /// G(w, s, h) D(h) (w . h) / (w.z pdf(w, h)): the weight of a facet that was sampled for `w` and reflects
  /// or refracts all its light to `s`.
  double weight(const Vec3& w, const Vec3& s, const Vec3& h) const;
  /// Deterministic quadrature of value(h) D(h) (w . h) / w.z, w.z > 0, over the facets that face `w`, without
  /// masking. It uses `slopes` slopes and half that number of azimuths on either side. The error of an albedo
  /// is below 2e-4, or 2e-3 if refraction has edges. If w.y = 0, `value` must be symmetric about the plane
  /// y = 0.
  double integrate(const Vec3& w, const std::function<double(const Vec3& h)>& value, int slopes = 192) const;
};

/// Throws std::invalid_argument unless both alphas are from 0.001 to 1 (a smoother surface is a mirror).
/// Visible normals are available only for GGX, the rational approximation only for Beckmann.
Microfacets make_microfacets(FacetDistribution distribution, double alpha_x, double alpha_y, Masking masking,
                             FacetSampling sampling);
/// Uses Smith masking, and visible normals for GGX.
Microfacets make_microfacets(FacetDistribution distribution, double alpha_x, double alpha_y);

}  // namespace shelfbeam
