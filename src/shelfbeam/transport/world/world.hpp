#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/emitters.hpp"
#include "shelfbeam/transport/world/plane_mirrors.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"
#include "shelfbeam/transport/world/receivers.hpp"

namespace shelfbeam {

/// A scene smaller than a metre, so many times as large that it has some, with all intensities times the
/// square of that: every signal is the same, (2.14) being a sum of I cos cos / d^2 over surfaces in units of
/// d^2. The factor is a power of two, so nothing is rounded. Nothing where the scene is a metre large.
///
/// What estimators choose for stores, the half-metre cells of the radiance cache among it, then serves a box
/// of millimetres as well.
std::optional<Scene> enlarged(const Scene& scene);

/// Uniform numbers in the order in which they are asked for; which ones follows from what they are for alone.
class RandomStream {
 public:
  RandomStream(std::uint64_t key, std::uint32_t a, std::uint32_t b, std::uint32_t c)
      : key_(key), a_(a), b_(b), c_(c) {}

  std::uint32_t bits() {
    if (used_ == words_.size()) {
      words_ = philox({counter_++, a_, b_, c_}, key_);
      used_ = 0;
    }
    return words_[used_++];
  }
  double unit() { return to_unit(bits()); }

 private:
  std::uint64_t key_;
  std::uint32_t a_, b_, c_, counter_ = 0;
  std::array<std::uint32_t, 4> words_{};
  std::size_t used_ = 4;
};

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
