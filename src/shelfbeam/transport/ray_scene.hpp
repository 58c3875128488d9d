#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Where a ray met a surface.
struct Hit {
  Vec3 position;
  Vec3 normal;  ///< unit, of the triangle, on the side that the ray came from
  MaterialId material;
};

/// The triangles of a scene, ready for ray queries. Queries may run in any number of threads.
///
/// Rays that start at a surface start a few units in the last place off it, on the side of `normal` (Wächter
/// and Binder, "A fast and robust method for avoiding self-intersection", Ray Tracing Gems, 2019), so there
/// is no epsilon that would depend on the size of the scene.
class RayScene {
 public:
  explicit RayScene(const TriangleMesh& mesh);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// First surface along a unit direction from a point on a surface with this normal.
  std::optional<Hit> intersect(const Vec3& origin, const Vec3& normal, const Vec3& direction) const;

  /// True when something stands between a point on a surface with this normal and a free point. Both ends may
  /// touch a surface.
  bool occluded(const Vec3& origin, const Vec3& normal, const Vec3& target) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace shelfbeam
