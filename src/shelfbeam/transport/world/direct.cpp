#include "shelfbeam/transport/world/direct.hpp"

#include <cmath>
#include <numeric>

namespace shelfbeam {

namespace {

// A lattice in four dimensions: stratum (a, b) of the source is paired with stratum (m a - b, a + m b) of the
// label, modulo an odd side and with a random shift. Every pair of coordinates takes every pair of strata
// once if m and m^2 + 1 are coprime to the side. An m near the square root of the side avoids short vectors
// in the dual lattice.
std::uint32_t multiplier(std::uint32_t side) {
  auto m = static_cast<std::uint32_t>(std::lround(std::sqrt(side)));
  while (std::gcd(m, side) != 1 || std::gcd(m * m + 1, side) != 1) ++m;
  return m;
}

}  // namespace

DirectSignal direct_signal(const World& world, std::size_t i, std::size_t j, const SurfacePoint& label,
                           const LightPoint& light, const PathRules& rules) {
  return light_from(
      world, j, light, label,
      rules.uses_images(world.receivers.is_point(i), world.emitters.is_transceiver(j)),
      [&](const Vec3& direction) { return world.receivers.response(i, direction); },
      [&] { return world.rays.transmittance(label, light.position).share; });
}

bool is_point_to_point(const World& world, std::size_t i, std::size_t j) {
  return world.receivers.is_point(i) && world.emitters.is_point(j);
}

DirectSignal direct_between_points(const World& world, std::size_t i, std::size_t j, const PathRules& rules) {
  return direct_signal(world, i, j, world.receivers.point(i, 0, 0), world.emitters.point(j, 0, 0), rules);
}

DirectSignal sample_direct(const World& world, std::size_t i, std::size_t j, const PathKey& key,
                           std::uint32_t at_least, const PathRules& rules) {
  const std::uint32_t side = at_least | 1U, count = side * side, m = multiplier(side);
  const auto shifts = key.draw(0);
  const std::uint32_t shift1 = to_index(shifts[0], side), shift2 = to_index(shifts[1], side);
  DirectSignal sum;
  for (std::uint32_t a = 0; a < side; ++a)
    for (std::uint32_t b = 0; b < side; ++b) {
      const auto u = key.draw(1 + a * side + b);
      const auto coordinate = [&](std::uint32_t stratum, std::uint32_t bits) {
        return (stratum % side + to_uniform(bits)) / side;
      };
      const double u1 = coordinate(m * a + (side - b) + shift1, u[0]),
                   u2 = coordinate(a + m * b + shift2, u[1]);
      sum += direct_signal(world, i, j, world.receivers.point(i, u1, u2),
                           world.emitters.point(j, coordinate(a, u[2]), coordinate(b, u[3])), rules);
    }
  sum.straight /= count;
  sum.mirrored /= count;
  return sum;
}

}  // namespace shelfbeam
