#include "shelfbeam/transport/operator/unit_survey.hpp"

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/world/specular_chain.hpp"

namespace shelfbeam {

UnitSurvey survey_unit(const World& probe, const SurfaceNodes& nodes, const std::vector<std::uint8_t>& seen,
                       std::uint64_t seed) {
  constexpr std::uint32_t emitted_rays = 256;
  const double hand = 0.1 * probe.surfaces->enlargement;  // m
  UnitSurvey survey;
  const ScrambledSobol square(seed);
  for (std::uint32_t r = 0; r < emitted_rays; ++r) {
    const auto [u1, u2] = square.point(r);
    RandomStream random(seed, r, 0, 0x5E77);
    const double u3 = random.uniform(), u4 = random.uniform();
    const auto emitted = probe.emitters.emit(0, {u1, u2, u3, u4});
    if (!emitted) continue;
    std::uint64_t rays = 0;
    const auto end = follow_chain(probe, {emitted->from.position, emitted->from.normal}, emitted->direction,
                                  Departure::scattered, random, rays, [](std::size_t, double) {});
    const double share = 1.0 / emitted_rays;
    if (end && length(end->point.position - emitted->from.position) < hand) survey.near += share;
    const auto is_metal = [&] { return !nodes.guides()[end->material.value].has_base(); };
    if (end && (!end->is_straight || is_metal())) survey.bent += share;
    if (!end) continue;
    const std::uint32_t cell = nodes.cells().find_near(end->point);
    if (cell == detail::SurfaceCells::nowhere)
      survey.unexplored += share;
    else if (seen[cell] == 0)
      survey.unseen += share;
  }
  return survey;
}

}  // namespace shelfbeam
