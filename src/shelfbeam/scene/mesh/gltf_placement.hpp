#pragma once

#include <array>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// An affine map: the images of the three axes and of the origin.
struct GltfPlacement {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{0, 0, 0};

  Vec3 direction(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3 point(const Vec3& p) const { return direction(p) + origin; }
  /// First `inner`, then this.
  GltfPlacement of(const GltfPlacement& inner) const {
    return {direction(inner.x), direction(inner.y), direction(inner.z), point(inner.origin)};
  }
  /// Whether it turns a surface inside out.
  bool mirrors() const { return dot(x, cross(y, z)) < 0; }

  /// From a translation, a quaternion (x, y, z, w) and a scale. A quaternion that is not of length 1, such as
  /// one of whole numbers, is normalized; a zero quaternion gives NaN.
  static GltfPlacement from(const Vec3& translation, const std::array<double, 4>& rotation,
                            const Vec3& scale);
  /// From 16 numbers, column by column. Throws InputError at `place` unless they are an affine map.
  static GltfPlacement from_matrix(const double* numbers, const JsonCursor& place);
  /// The placement of a node in its parent. Throws InputError.
  static GltfPlacement of_node(const JsonCursor& node);
};

}  // namespace shelfbeam
