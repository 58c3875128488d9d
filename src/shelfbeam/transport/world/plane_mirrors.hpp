#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"

namespace shelfbeam {

/// Whether a surface reflects a share as a mirror does.
bool mirrors_a_share(const Material& material);

/// The way from one point to another, straight or over one mirror.
struct Connection {
  Vec3 from_first;   ///< unit, from the first point to the second or to the mirror
  Vec3 from_second;  ///< unit, from the second point likewise
  double length_squared = 0;
};

/// The flat mirrors of a scene: groups of coplanar triangles that reflect a share as a mirror does (smooth
/// metal, glass, panes, smooth coats). No walk can join a point to a point, or to one drawn on a disc, over a
/// mirror; the mirror image of the one can be seen from the other, and its light is computed exactly.
///
/// Only the largest groups count, at most `most_mirrors` of at least `least_area`: every connection tries
/// each of them.
class PlaneMirrors {
 public:
  static constexpr std::size_t most_mirrors = 64;
  static constexpr double least_area = 0.01;  ///< m^2

  explicit PlaneMirrors(const Scene& scene);

  std::size_t size() const { return mirrors_.size(); }

  /// Whether a triangle belongs to one of them.
  bool contains(std::uint32_t triangle) const { return mirror_of_[triangle] < mirrors_.size(); }

  /// Triangles that mirror a share but belong to no group that counts, by material.
  const std::vector<std::size_t>& left_out() const { return left_out_; }

  /// The way over the plane of mirror g, if both points lie on one side of it and the way meets the mirror's
  /// bounding box.
  std::optional<Connection> bend(std::size_t g, const Vec3& first, const Vec3& second) const;

  /// The share of the light that takes this way: reflectance of the mirror where it is met, panes, obstacles.
  double share(std::size_t g, const Connection& way, const SurfacePoint& first, const Vec3& second,
               const RayScene& rays) const;

 private:
  struct Mirror {
    Vec3 normal;
    double offset = 0;  ///< normal . p of its points
    Vec3 low, high;
    double area = 0;
  };
  const Scene& scene_;
  std::vector<Mirror> mirrors_;
  std::vector<std::uint32_t> mirror_of_;  ///< by triangle; size() where there is none
  std::vector<std::size_t> left_out_;
};

}  // namespace shelfbeam
