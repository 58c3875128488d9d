#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/world/emitters.hpp"
#include "shelfbeam/transport/world/enlarged.hpp"
#include "shelfbeam/transport/world/plane_mirrors.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"
#include "shelfbeam/transport/world/receivers.hpp"

namespace shelfbeam {

/// A scene as paths see it; a very small one enlarged.
struct World {
  explicit World(const Scene& s)
      : own(enlarged(s)),
        scene(own ? *own : s),
        rays(scene),
        emitters(scene),
        receivers(scene),
        mirrors(scene) {}
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const Material& material(const Hit& hit) const { return scene.materials[hit.material.value].material; }

  const std::optional<Scene> own;
  const Scene& scene;
  RayScene rays;
  Emitters emitters;
  Receivers receivers;
  PlaneMirrors mirrors;
};

/// Identifies one path: its random numbers follow from this alone.
struct PathKey {
  std::uint64_t stream = 0;  ///< of seed and label or transceiver
  std::uint32_t batch = 0;
  std::uint32_t sample = 0;  ///< within the batch

  /// Four random words for a vertex; a block for each purpose.
  std::array<std::uint32_t, 4> draw(std::uint32_t vertex, std::uint32_t block = 0) const {
    return philox({vertex, sample, batch, block}, stream);
  }
};

/// Russian roulette on the throughput (2.18): however bright the surfaces, a path ends at last.
inline double survival_probability(double throughput) {
  return std::min(0.98, throughput);
}

}  // namespace shelfbeam
