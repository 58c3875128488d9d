#pragma once

#include <cmath>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// A right-handed orthonormal basis; `z` is the surface normal or the device axis.
struct Frame {
  Vec3 x, y, z;

  /// A frame about a unit-length normal (Duff et al. 2017, "Building an orthonormal basis, revisited").
  static Frame about(const Vec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1 / (sign + n.z);
    const double b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }

  /// The frame of a surface: x is horizontal, y points up the surface. On a horizontal surface x is world +x.
  static Frame of_surface(const Vec3& n) {
    const double across = n.x * n.x + n.y * n.y;
    if (across < 1e-12) return {{1, 0, 0}, {0, n.z, 0}, n};
    const double s = 1 / std::sqrt(across);
    const Vec3 x{-n.y * s, n.x * s, 0};
    return {x, cross(n, x), n};
  }

  /// The frame of a device; `axis` has unit length. At roll 0, x is the component of world +x perpendicular
  /// to the axis (of world +y if the axis is parallel to x). Positive roll is right-handed about the axis.
  static Frame of_device(const Vec3& axis, double roll_rad) {
    const Vec3 reference = std::abs(axis.x) < 0.999999 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 u = normalized(reference - axis * dot(reference, axis));
    const Vec3 v = cross(axis, u);
    const double c = std::cos(roll_rad), s = std::sin(roll_rad);
    return {u * c + v * s, v * c - u * s, axis};
  }

  Vec3 to_world(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3 to_local(const Vec3& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};

}  // namespace shelfbeam
