#pragma once

#include <vector>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/build/blocks.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The positions at which a fitter mounts units instead of those of the plan. He misses them in both
/// horizontal directions, but passes no wall, fixture or lower ceiling.
///
/// Towards the nearest surface and along it, a deviation is folded into the free distance, which is the
/// smaller one of both sides. It is then as likely as its opposite, so its mean is the planned position.
class MountingError {
 public:
  /// The scene must outlive the object.
  explicit MountingError(const Scene& scene);

  /// The position of a unit that misses `planned` by `deviation`, m, in open space.
  Vec3 moved(const Vec3& planned, const Vec2& deviation) const;

 private:
  /// A vertical surface, in plan.
  struct Edge {
    Vec2 a{}, b{};
  };
  static std::vector<Edge> edges_of(const Scene& scene);

  std::vector<Edge> edges_within(const Vec3& p, double distance) const;
  bool is_surface_at(const Edge& edge, const Vec3& p) const;
  bool is_free(const Vec3& from, const Vec3& to) const;

  const Scene& scene_;
  Blocks blocks_;
  std::vector<Edge> room_edges_;
  BoxIndex room_index_;
};

}  // namespace shelfbeam
