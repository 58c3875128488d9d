#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/emitters.hpp"
#include "shelfbeam/transport/world/plane_mirrors.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"
#include "shelfbeam/transport/world/receivers.hpp"

namespace shelfbeam {

/// A scene smaller than 1 m, enlarged to 4 to 8 m by a power of two, with all intensities multiplied by its
/// square: signals stay the same, because (2.14) is a sum of I cos cos / d^2 over surfaces whose areas scale
/// as d^2. Lengths that estimators choose for stores, such as the half-metre cells of the radiance cache,
/// then also suit a box of some millimetres.
///
/// Labels and units are off glass (devices_off_glass), and coats that no plane mirror shows are slightly
/// rough (with_rough_coats). No value for a scene that remains as it is.
std::optional<Scene> ready_for_light(const Scene& scene);

/// This factor, 1 for a scene of 1 m or more.
double enlargement(const Scene& scene);

/// A sequence of uniform random numbers that depends on the key and (a, b, c) alone.
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
  double uniform() { return to_uniform(bits()); }

 private:
  std::uint64_t key_;
  std::uint32_t a_, b_, c_, counter_ = 0;
  std::array<std::uint32_t, 4> words_{};
  std::size_t used_ = 4;
};

/// The surfaces of a scene, for any labels and units between them.
struct Surfaces {
  explicit Surfaces(const Scene& scene, double e) : enlargement(e), rays(scene, e), mirrors(scene) {}

  double enlargement;
  RayScene rays;
  PlaneMirrors mirrors;
};

struct World;

/// The room, materials and types of a world with other units, which are given as in the shop, and its labels.
Scene with_other_units(const World& like, std::vector<Transceiver> units, bool with_labels);

/// A scene prepared for light transport (ready_for_light).
struct World {
  explicit World(const Scene& s)
      : own(ready_for_light(s)),
        scene(own ? *own : s),
        surfaces(std::make_shared<const Surfaces>(scene, enlargement(s))),
        rays(surfaces->rays),
        mirrors(surfaces->mirrors),
        emitters(scene),
        receivers(scene) {}
  /// The surfaces and labels of a world with other units. Its scene has no mesh, and labels only on request:
  /// there may be very many. `like` must outlive this world.
  World(const World& like, std::vector<Transceiver> units, bool with_labels)
      : own(with_other_units(like, std::move(units), with_labels)),
        scene(*own),
        surfaces(like.surfaces),
        rays(surfaces->rays),
        mirrors(surfaces->mirrors),
        emitters(scene),
        receivers(like.receivers) {}
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const Material& material(const Hit& hit) const { return scene.materials[hit.material.value].material; }

  const std::optional<Scene> own;
  const Scene& scene;
  std::shared_ptr<const Surfaces> surfaces;
  const RayScene& rays;
  const PlaneMirrors& mirrors;
  Emitters emitters;
  Receivers receivers;
};

/// Identifies one path; its random numbers depend on this key alone.
struct PathKey {
  std::uint64_t stream = 0;  ///< from the seed and the label or source
  std::uint32_t batch = 0;
  std::uint32_t sample = 0;  ///< within the batch

  /// Four random words for a vertex; each purpose has a block of its own.
  std::array<std::uint32_t, 4> draw(std::uint32_t vertex, std::uint32_t block = 0) const {
    return philox({vertex, sample, batch, block}, stream);
  }
};

/// Russian roulette on the throughput (2.18). The maximum ends paths even between lossless surfaces.
inline double survival_probability(double throughput) {
  return std::min(0.98, throughput);
}

}  // namespace shelfbeam
