#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/mesh/solid_shells.hpp"

namespace shelfbeam {

/// Finds the triangles that a ray from a point crosses. All rays have one direction, which is not special in
/// any way, so that they hardly ever meet an edge or run along a triangle.
class ShellCrossings {
 public:
  /// A point within `contact` of a triangle lies on it.
  ShellCrossings(const std::vector<SolidTriangle>& triangles, double contact);

  /// Calls `use(triangle, is_on)` for the triangles that the ray from `p` crosses, and for those on which `p`
  /// lies. False if the limit of comparisons of all calls is reached.
  template <class Use>
  [[nodiscard]] bool from(const Vec3& p, Use use) const {
    const Vec3 start = turned(p);
    const Bounds ray{{start.x, start.y, start.z - contact_}, {start.x, start.y, HUGE_VAL}};
    index_.any(ray, [&](std::uint32_t triangle) {
      if (++comparisons_ > max_comparisons) return true;
      const Meeting meeting = meeting_of(triangle, start);
      if (meeting != Meeting::none) use(triangle, meeting == Meeting::on);
      return false;
    });
    return comparisons_ <= max_comparisons;
  }

  /// Whether the normal of a triangle points along the rays.
  bool faces_along(std::uint32_t triangle) const;

 private:
  enum class Meeting { none, on, ahead };
  static constexpr std::size_t max_comparisons = 20'000'000;

  /// The coordinates in which rays run along z.
  static Vec3 turned(const Vec3& p);
  Meeting meeting_of(std::uint32_t triangle, const Vec3& start) const;

  double contact_;
  std::vector<std::array<Vec3, 3>> corners_;  ///< turned
  BoxIndex index_;
  mutable std::size_t comparisons_ = 0;
};

}  // namespace shelfbeam
