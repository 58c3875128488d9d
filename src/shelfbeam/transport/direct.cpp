#include "shelfbeam/transport/direct.hpp"

#include <cmath>

namespace shelfbeam {

DirectSignal& DirectSignal::operator+=(const DirectSignal& other) {
  straight += other.straight;
  mirrored += other.mirrored;
  rays += other.rays;
  return *this;
}

DirectSignal direct_signal(const World& world, std::size_t i, std::size_t j, const SurfacePoint& label,
                           const LightPoint& light, const PathRules& rules) {
  DirectSignal signal;
  const Vec3 way = light.position - label.position;
  const double squared = length_squared(way);
  if (!(squared > 0)) return signal;
  const Vec3 to_source = way / std::sqrt(squared);
  const double response = world.receivers.response(i, to_source);
  const double value = response > 0 ? response * world.emitters.intensity(j, light, -to_source) / squared : 0;
  if (value > 0) {
    ++signal.rays;
    signal.straight = value * world.rays.passage(label, light.position).share;
  }
  if (!rules.uses_images(world.receivers.is_point(i), world.emitters.is_point(j))) return signal;
  for (std::size_t g = 0; g < world.mirrors.size(); ++g) {
    const auto bend = world.mirrors.bend(g, label.position, light.position);
    if (!bend) continue;
    const double mirrored = world.receivers.response(i, bend->from_first) *
                            world.emitters.intensity(j, light, bend->from_second) / bend->length_squared;
    if (!(mirrored > 0)) continue;
    signal.rays += 2;
    signal.mirrored += mirrored * world.mirrors.share(g, *bend, label, light.position, world.rays);
  }
  return signal;
}

bool is_point_to_point(const World& world, std::size_t i, std::size_t j) {
  return world.receivers.is_point(i) && world.emitters.is_point(j);
}

DirectSignal direct_between_points(const World& world, std::size_t i, std::size_t j, const PathRules& rules) {
  return direct_signal(world, i, j, world.receivers.point(i, 0, 0), world.emitters.point(j, 0, 0), rules);
}

DirectSignal sample_direct(const World& world, std::size_t i, std::size_t j, const PathKey& key,
                           std::uint32_t side, const PathRules& rules) {
  const std::uint32_t count = side * side;
  // Every cell of the label meets one of the source: side + 1 and side^2 have no common divisor, so the cells
  // of the label come in another order, from a random start.
  const std::uint32_t first = to_index(key.draw(0)[0], count);
  DirectSignal sum;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto u = key.draw(k + 1);
    const std::uint32_t cell = (first + k * (side + 1)) % count;
    const auto coordinate = [&](std::uint32_t stratum, std::uint32_t bits) {
      return (stratum + to_unit(bits)) / side;
    };
    sum += direct_signal(
        world, i, j, world.receivers.point(i, coordinate(cell % side, u[0]), coordinate(cell / side, u[1])),
        world.emitters.point(j, coordinate(k % side, u[2]), coordinate(k / side, u[3])), rules);
  }
  sum.straight /= count;
  sum.mirrored /= count;
  return sum;
}

}  // namespace shelfbeam
