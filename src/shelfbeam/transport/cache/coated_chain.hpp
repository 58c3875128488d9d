#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/transport/cache/surface_guide.hpp"
#include "shelfbeam/transport/world/specular_chain.hpp"

namespace shelfbeam {

/// Follows a ray like follow_chain, and beyond smooth coats, which reflect a part of the light like mirrors:
/// calls use(end, weight of the radiance from there) for the first surface that scatters and for those that
/// it sees in coats.
template <class Use>
void follow_coated_chain(const World& world, const std::vector<SurfaceGuide>& guides, SurfacePoint from,
                         Vec3 direction, RandomStream& random, std::uint64_t& rays, const Use& use) {
  constexpr double least = 0.01;  // weight
  constexpr int most = 4;         // coats
  Departure departure = Departure::scattered;
  double weight = 1;
  for (int coats = 0; coats < most; ++coats) {
    auto end = follow_chain(world, from, direction, departure, random, rays, [](std::size_t, double) {});
    if (!end) return;
    if (coats > 0) end->is_straight = false;
    weight *= end->throughput;
    use(*end, weight);
    const SurfaceGuide& guide = guides[end->material.value];
    if (!guide.has_smooth_coat()) return;
    const double cosine = dot(end->point.normal, end->outgoing);
    weight *= 1 - guide.exit(cosine);
    if (weight < least) return;
    from = end->point;
    direction = end->point.normal * (2 * cosine) - end->outgoing;
    departure = after_specular(end->arrived, end->is_imaged);
  }
}

}  // namespace shelfbeam
