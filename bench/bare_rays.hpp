#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shelfbeam/transport/tally/estimator.hpp"
#include "shelfbeam/transport/world/label_clusters.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam::bench {

struct Rate {
  double per_second() const { return rays / seconds; }

  double rays = 0, seconds = 0;  ///< of CPU time
};

/// The speed of the ray library alone, with rays like those of the estimators: from surface points of walks,
/// on one thread.
class BareRays {
 public:
  /// Only walks.
  explicit BareRays(const World& world);

  /// Also the rays of path reuse: packets of `shadow_rays` shadow rays, and of visibility rays to the labels
  /// of clusters.
  BareRays(const World& world, std::size_t shadow_rays, std::span<const LabelCluster> clusters);

  /// Traces all rays once more.
  void measure();

  Rate walks;       ///< alternately a ray to the next surface and a connection
  Rate single;      ///< rays to the next surface
  Rate shadow;      ///< RayScene::shares
  Rate visibility;  ///< RayScene::passages
  double hits = 0;  ///< rays of `walks` that reach a surface or see the unit

 private:
  struct Ray {
    SurfacePoint from;  ///< its normal is on the side from which the walk came
    Vec3 direction, target;
  };
  struct Packet {
    SurfacePoint from;
    std::vector<RayEnd> targets;
  };

  const World& world_;
  std::vector<Ray> rays_;
  std::vector<Packet> shadow_packets_, visibility_packets_;
  double sink_ = 0;  ///< keeps the compiler from removing the work
};

}  // namespace shelfbeam::bench
