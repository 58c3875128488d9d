#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"

namespace shelfbeam {

/// Whether a surface reflects a share of the light specularly.
bool is_partly_specular(const Material& material);

/// A connection between two points, straight or over one mirror.
struct Connection {
  Vec3 from_first;   ///< unit length, from the first point to the second or to the mirror
  Vec3 from_second;  ///< unit length, from the second point to the first or to the mirror
  double length_squared = 0;
};

/// The plane mirrors of a scene: groups of coplanar triangles that reflect a share of the light specularly
/// (smooth metal, glass, panes, smooth coats). No walk can join two given points over a mirror, but one point
/// sees the mirror image of the other, so the light of this mirror path is computed exactly.
///
/// Only the `max_mirrors` largest groups of at least `min_area` count, because every connection tries each of
/// them.
class PlaneMirrors {
 public:
  static constexpr std::size_t max_mirrors = 64;
  static constexpr double min_area = 0.01;  ///< m^2

  explicit PlaneMirrors(const Scene& scene);

  std::size_t size() const { return mirrors_.size(); }

  /// Whether a triangle belongs to one of these mirrors.
  bool contains(std::uint32_t triangle) const { return mirror_of_[triangle] < mirrors_.size(); }

  /// Number of specular triangles of each material that belong to none of these mirrors.
  const std::vector<std::size_t>& omitted() const { return left_out_; }

  /// The images of a point and of a direction in mirror g.
  Vec3 image(std::size_t g, const Vec3& point) const {
    const Mirror& mirror = mirrors_[g];
    return point - mirror.normal * (2 * (dot(mirror.normal, point) - mirror.offset));
  }
  Vec3 image_direction(std::size_t g, const Vec3& direction) const {
    const Vec3& normal = mirrors_[g].normal;
    return direction - normal * (2 * dot(normal, direction));
  }

  /// The mirror path over the plane of mirror g, if both points are on the same side of the plane and the
  /// path meets the mirror's bounding box.
  std::optional<Connection> mirror_path(std::size_t g, const Vec3& first, const Vec3& second) const;

  /// Transmittance of a mirror path: reflectance at the mirror, panes and obstacles.
  double share(std::size_t g, const Connection& way, const SurfacePoint& first, const Vec3& second,
               const RayScene& rays) const;

 private:
  struct Mirror {
    Vec3 normal;
    double offset = 0;  ///< dot(normal, p) for its points p
    Vec3 low, high;
    double area = 0;
  };
  const Scene& scene_;
  std::vector<Mirror> mirrors_;
  std::vector<std::uint32_t> mirror_of_;  ///< by triangle; size() for none
  std::vector<std::size_t> left_out_;
};

}  // namespace shelfbeam
