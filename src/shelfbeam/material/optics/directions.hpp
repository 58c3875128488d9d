#pragma once

#include <cmath>
#include <optional>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam::detail {

/// Mirrors `w` about the unit normal `h`.
constexpr Vec3 reflected(const Vec3& w, const Vec3& h) {
  return h * (2 * dot(w, h)) - w;
}

/// Snell's law: where light that leaves the boundary along `w` (w . h > 0) came from beyond it; `eta` is the
/// index there over the index at `w`. Nothing under total internal reflection.
inline std::optional<Vec3> refracted(const Vec3& w, const Vec3& h, double eta) {
  const double cos_i = dot(w, h);
  const double sin2_t = (1 - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1) return std::nullopt;
  return h * (cos_i / eta - std::sqrt(1 - sin2_t)) - w / eta;
}

}  // namespace shelfbeam::detail
