#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// A point that touches a surface, or may touch one; rays leave it on the side of `normal` to which they go.
struct SurfacePoint {
  Vec3 position;
  Vec3 normal;  ///< unit, of either side
};

/// Where a ray met a surface.
struct Hit {
  SurfacePoint point;  ///< with the triangle's own normal, by its winding, whichever side the ray came from
  double distance = 0;
  MaterialId material;
  std::uint32_t triangle = 0;
};

/// What a straight connection keeps on its way through panes.
struct Passage {
  double share = 1;        ///< of the light; 0: something opaque stands between
  double probability = 1;  ///< with which a walk that samples the panes goes straight through all of them
};

/// The triangles of a scene, ready for ray queries. Queries may run in any number of threads.
///
/// Rays that start at a surface start a few units in the last place off it (Wächter and Binder, "A fast and
/// robust method for avoiding self-intersection", Ray Tracing Gems, 2019), so there is no epsilon that would
/// depend on the size of the scene.
class RayScene {
 public:
  explicit RayScene(const Scene& scene);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// First surface along a unit direction, panes included.
  std::optional<Hit> intersect(const SurfacePoint& from, const Vec3& direction) const;

  /// What reaches a point, which may touch a surface, in a straight line. Panes attenuate, everything else,
  /// solid glass included, blocks.
  Passage passage(const SurfacePoint& from, const Vec3& to) const;

  /// A point this far along a ray does not lie behind a hit at that distance: so near the end, rays to a
  /// point do not look for obstacles.
  static bool reaches(double distance, double hit_distance) { return distance * shadow_end <= hit_distance; }

 private:
  static constexpr float shadow_end = 1 - 1.0F / 65536;
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace shelfbeam
