#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shelfbeam/transport/tally/estimator.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam::bench {

struct Rate {
  double per_second() const { return rays / seconds; }

  double rays = 0, seconds = 0;  ///< of CPU time
};

/// What the ray library does with rays like those of the estimators and nothing else to do: rays from surface
/// points of walks, on one thread.
class BareRays {
 public:
  /// For walks alone.
  explicit BareRays(const World& world);

  /// For path reuse, too: packets of so many shadow rays, and of visibility rays to the labels of clusters.
  BareRays(const World& world, std::size_t shadow_rays, std::span<const std::vector<std::uint32_t>> clusters);

  /// Traces all of them once more.
  void measure();

  Rate walks;       ///< a ray to the next surface, a connection, and so on
  Rate single;      ///< to the next surface
  Rate shadow;      ///< RayScene::shares
  Rate visibility;  ///< RayScene::passages
  double hits = 0;  ///< of `walks`: which reach a surface or see the unit

 private:
  struct Ray {
    SurfacePoint from;  ///< its normal on the side that the ray came from
    Vec3 direction, target;
  };
  struct Packet {
    SurfacePoint from;
    std::vector<Vec3> targets;
  };

  const World& world_;
  std::vector<Ray> rays_;
  std::vector<Packet> shadow_packets_, visibility_packets_;
  double sink_ = 0;  ///< so that nothing is left out
};

}  // namespace shelfbeam::bench
