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
  MaterialId material;
  std::uint32_t triangle = 0;

  /// Where a ray meets the plane of the triangle: exactly as far as anything else in this plane.
  double distance(const Vec3& origin, const Vec3& direction) const {
    return dot(point.position - origin, point.normal) / dot(direction, point.normal);
  }
};

/// What a straight connection keeps on its way through panes.
struct Passage {
  double share = 1;        ///< of the light; 0: something opaque stands between
  double probability = 1;  ///< with which a walk that samples the panes goes straight through all of them
};

/// The triangles of a scene, ready for ray queries. Queries may run in any number of threads.
///
/// Rays start a little off the surface that they leave and end a little before the point that they lead to,
/// by what single precision loses of the largest coordinate in the scene, times a factor: 0.02 and 0.08 mm in
/// a store of 20 m, 0.2 and 0.8 mm in one of 200 m. (A length by the point's own coordinates, as Wächter and
/// Binder have it in Ray Tracing Gems, 2019, is too small near the origin for triangles that reach far from
/// it.)
class RayScene {
 public:
  explicit RayScene(const Scene& scene);
  ~RayScene();

  /// First surface along a unit direction, panes included.
  std::optional<Hit> intersect(const SurfacePoint& from, const Vec3& direction) const;

  /// What reaches a point, which may touch a surface, in a straight line. Panes attenuate, everything else,
  /// solid glass included, blocks.
  Passage passage(const SurfacePoint& from, const Vec3& to) const;

  /// The passages from one point to many, sixteen rays at a time; `shares` has their shares alone.
  void passages(const SurfacePoint& from, std::span<const Vec3> to, std::span<Passage> result) const;
  void shares(const SurfacePoint& from, std::span<const Vec3> to, std::span<float> result) const;

  /// Whether a ray meets a point at `distance` between surfaces at these distances. Rays to a point do not
  /// look for obstacles near their end, so a point that touches a surface from behind is met before it, and
  /// once.
  bool is_met(double distance, double nearest, double farthest) const {
    return distance - end_ > nearest && distance - end_ <= farthest;
  }

 private:
  template <class Use>
  void each_passage(const SurfacePoint& from, std::span<const Vec3> to, const Use& use) const;
  Passage through_panes(const SurfacePoint& from, const Vec3& to) const;

  struct Impl;
  std::unique_ptr<const Impl> impl_;
  double end_ = 0;  ///< m, how far before a point rays end
};

}  // namespace shelfbeam
