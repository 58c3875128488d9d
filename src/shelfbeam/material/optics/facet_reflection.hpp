#pragma once

#include <optional>

#include "shelfbeam/material/optics/directions.hpp"
#include "shelfbeam/material/optics/microfacets.hpp"
#include "shelfbeam/material/optics/scatter_sample.hpp"

namespace shelfbeam::detail {

/// Draws a mirror image of `known` in a facet that it sees, which reflects fresnel(cosine to its normal).
template <class Fresnel>
std::optional<ScatterSample> sample_reflection(const Microfacets& facets, const Vec3& known, double u1,
                                               double u2, const Fresnel& fresnel) {
  const Vec3 h = facets.sample(known, u1, u2);
  const Vec3 direction = reflected(known, h);
  const double cosine = dot(known, h);
  if (cosine <= 0 || direction.z <= 0) return std::nullopt;
  return ScatterSample{direction, fresnel(cosine) * facets.weight(known, direction, h),
                       facets.reflection_pdf(known, h)};
}

}  // namespace shelfbeam::detail
