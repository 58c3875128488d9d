#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

inline constexpr auto no_triangle = std::numeric_limits<std::uint32_t>::max();

/// A point that touches a surface, or may touch one. Rays leave it on the side of the surface to which they
/// lead.
struct SurfacePoint {
  Vec3 position;
  Vec3 normal;                           ///< unit length, of either side
  std::uint32_t triangle = no_triangle;  ///< of the mesh, on which the point lies
};

/// The end of a connection.
struct RayEnd {
  RayEnd(const Vec3& p) : position(p) {}
  RayEnd(const SurfacePoint& p) : position(p.position), triangle(p.triangle) {}

  Vec3 position;
  std::uint32_t triangle = no_triangle;
};

/// The intersection of a ray with a surface.
struct Hit {
  SurfacePoint point;  ///< with the normal by the triangle's winding, on whichever side the ray came from
  MaterialId material;

  /// Distance at which a ray meets the plane of the triangle, exactly equal for everything in this plane.
  double distance(const Vec3& origin, const Vec3& direction) const {
    return dot(point.position - origin, point.normal) / dot(direction, point.normal);
  }
};

/// The attenuation of a straight connection by panes.
struct Transmittance {
  double share = 1;        ///< of the light that passes; 0 if something opaque stands between
  double probability = 1;  ///< that a walk, which samples the panes, goes straight through all of them

  void pass(const PaneShares& pane) {
    share *= pane.transmitted;
    probability *= pane.transmitted > 0 ? pane.transmitted / (pane.reflected + pane.transmitted) : 0;
  }
};

/// The triangles of a scene, ready for ray queries. Queries are thread-safe.
///
/// Rays start slightly off the surface that they leave and end slightly before their target. Both offsets are
/// multiples of the single-precision rounding error of the largest coordinate in the scene: 0.02 and 0.08 mm
/// in a store of 20 m, 0.2 and 0.8 mm in a store of 200 m. (An offset by the point's own coordinates, as in
/// Wächter and Binder, Ray Tracing Gems, 2019, is too small near the origin for triangles that extend far
/// from it.) Coordinates count from the middle of a scene that lies far from its origin.
///
/// Glass and the surfaces in contact with it are met in the order of Contacts, however near they are.
class RayScene {
 public:
  /// `enlargement`: of the scene, in relation to the shop.
  explicit RayScene(const Scene& scene, double enlargement = 1);
  ~RayScene();

  /// First surface along a unit-length direction, panes included.
  std::optional<Hit> intersect(const SurfacePoint& from, const Vec3& direction) const;

  /// Transmittance of the straight connection to a point, which may touch a surface. Panes attenuate;
  /// everything else blocks, solid glass included.
  Transmittance transmittance(const SurfacePoint& from, const RayEnd& to) const;

  /// The transmittances from one point to many, in packets of sixteen rays; `shares` gives only
  /// Transmittance::share.
  void transmittances(const SurfacePoint& from, std::span<const RayEnd> to,
                      std::span<Transmittance> result) const;
  void shares(const SurfacePoint& from, std::span<const RayEnd> to, std::span<float> result) const;

  /// Whether other surfaces are in contact (Contacts) with the surface of this point, there.
  bool has_contact(const SurfacePoint& point) const;

  /// Whether a ray meets a point at `distance` between surfaces at `nearest` and `farthest`. Rays to a point
  /// ignore obstacles near their end, so a point that touches a surface from behind is met before this
  /// surface, and only once.
  bool is_between(double distance, double nearest, double farthest) const {
    return distance - end_ > nearest && distance - end_ <= farthest;
  }

 private:
  template <class Use>
  void each_transmittance(const SurfacePoint& from, std::span<const RayEnd> to, const Use& use) const;
  Transmittance through_panes(const SurfacePoint& from, const RayEnd& to) const;
  Transmittance in_order(const SurfacePoint& from, const RayEnd& to) const;

  struct Impl;
  std::unique_ptr<const Impl> impl_;
  double end_ = 0;  ///< distance before a point at which rays end, m
};

}  // namespace shelfbeam
