#pragma once

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/material/optics/microfacets.hpp"
#include "shelfbeam/material/optics/scatter_sample.hpp"
#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// Share of unpolarised light that a smooth boundary reflects (2.32, in the index forms of its R_s and R_p).
/// `cos_i` in [0, 1] is the cosine to the normal, `eta` = n_t / n_i > 0; 1 under total internal reflection.
double fresnel_dielectric(double cos_i, double eta);

/// The same for a conductor with the complex index eta + i k, seen from air.
double fresnel_conductor(double cos_i, double eta, double k);

namespace detail {

/// Mirrors `w` about the unit-length normal `h`.
constexpr Vec3 reflected(const Vec3& w, const Vec3& h) {
  return h * (2 * dot(w, h)) - w;
}

/// Snell's law: the direction beyond the boundary from which light comes that leaves along `w` (w . h > 0).
/// `eta` is the index beyond the boundary over the index at `w`. Nothing under total internal reflection.
inline std::optional<Vec3> refracted(const Vec3& w, const Vec3& h, double eta) {
  const double cos_i = dot(w, h);
  const double sin2_t = (1 - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1) return std::nullopt;
  return h * (cos_i / eta - std::sqrt(1 - sin2_t)) - w / eta;
}

/// Throws std::invalid_argument unless low <= value <= high: "ior is 0.9, must be from 1 to 4".
inline void require_range(std::string_view what, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw std::invalid_argument(fmt::format("{} is {}; it must be from {} to {}", what, value, low, high));
}

inline constexpr double largest_ior = 4;  ///< germanium; detects a misplaced decimal point

/// Samples a facet and mirrors `wo` in it; the facet reflects the share fresnel(cosine to its normal).
template <class Fresnel>
std::optional<ScatterSample> sample_reflection(const Microfacets& facets, const Vec3& wo, double u1,
                                               double u2, const Fresnel& fresnel) {
  const Vec3 h = facets.sample(wo, u1, u2);
  const Vec3 direction = reflected(wo, h);
  const double cosine = dot(wo, h);
  if (cosine <= 0 || direction.z <= 0) return std::nullopt;
  return ScatterSample{direction, fresnel(cosine) * facets.weight(wo, direction, h),
                       facets.reflection_pdf(wo, h)};
}

}  // namespace detail
}  // namespace shelfbeam
