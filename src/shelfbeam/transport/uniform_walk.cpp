#include "shelfbeam/transport/uniform_walk.hpp"

#include <algorithm>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

// However bright the surfaces, a walk ends at last.
constexpr double most_survival = 0.98;

}  // namespace

std::uint64_t uniform_walk(const WalkScene& world, const Label& label, const WalkKey& key,
                           std::span<double> reflected, std::span<double> direct) {
  const Responsivity& responsivity = world.scene.type_of(label).responsivity;
  const auto n = static_cast<std::uint32_t>(reflected.size());
  // Four numbers a vertex: unit, two for the direction, roulette.
  const auto draw = [&](std::uint32_t vertex) {
    return philox({vertex, key.sample, key.batch, 0}, key.stream);
  };
  std::uint64_t rays = 0;

  auto random = draw(0);
  if (!direct.empty()) {
    const std::uint32_t j = to_index(random[0], n);
    direct[j] += n * direct_signal(label, responsivity, world.emitters, j, world.rays);
    ++rays;
  }
  const Vec3 local = sample_cosine_hemisphere(to_unit(random[1]), to_unit(random[2]));
  if (local.z <= 0) return rays;
  Vec3 direction = Frame::about(label.normal).to_world(local);
  const double weight =
      response(responsivity, local.z) / pdf_cosine_hemisphere(local);  // pi for a cosine label
  double beta = weight;                                                // (2.20), with the weight at the label

  std::optional<Hit> hit = world.rays.intersect(label.position, label.normal, direction);
  ++rays;
  for (std::uint32_t vertex = 1; hit; ++vertex) {
    random = draw(vertex);
    const Material& material = world.scene.materials[hit->material.value].material;
    const Frame frame = Frame::about(hit->normal);
    const Vec3 outgoing = frame.to_local(-direction);

    const std::uint32_t j = to_index(random[0], n);
    const Vec3 to_unit_j = world.emitters.position(j) - hit->position;
    const Vec3 incoming = frame.to_local(normalized(to_unit_j));
    if (incoming.z > 0) {
      const double value = beta * n * eval(material, outgoing, incoming) * incoming.z *
                           world.emitters.irradiance(j, hit->position);
      if (value > 0) {
        ++rays;
        if (!world.rays.occluded(hit->position, hit->normal, world.emitters.position(j)))
          reflected[j] += value;
      }
    }

    // The number that chose the unit may choose the lobe, too: connection and continuation are terms of a
    // sum.
    const auto next = sample(material, outgoing, to_unit(random[0]), to_unit(random[1]), to_unit(random[2]));
    if (!next || next->direction.z <= 0) break;
    beta *= next->weight;
    const double survival = std::min(most_survival, beta / weight);
    if (to_unit(random[3]) >= survival) break;
    beta /= survival;
    direction = frame.to_world(next->direction);
    hit = world.rays.intersect(hit->position, hit->normal, direction);
    ++rays;
  }
  return rays;
}

}  // namespace shelfbeam
