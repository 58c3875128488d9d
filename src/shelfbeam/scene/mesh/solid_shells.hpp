#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// A triangle of the surface of a solid.
struct SolidTriangle {
  std::array<Vec3, 3> corners;
  bool has_area = true;
};

/// The result of `facings` for a triangle.
enum class Facing : std::uint8_t {
  outwards,  ///< its normal points out of the solid
  inwards,   ///< its corners must be exchanged
  open,      ///< its shell is not closed, so it has no inside
  repeated   ///< its shell is listed twice, and this is the second copy
};

/// How the triangles of a surface face, which bounds solids of one medium. Each closed shell is examined on
/// its own: it faces outwards, but into the cavity if it lies within an odd number of others. A shell is
/// closed if every edge belongs to an even number of triangles, whose corners are compared by position, to
/// the rounding of single precision. Shells may touch at corners, edges and faces, and triangles of a shell
/// may be wound differently. Triangles without area close a shell only if it is not closed without them.
/// Returns nothing if nested shells require more than 20 million comparisons.
std::optional<std::vector<Facing>> facings(const std::vector<SolidTriangle>& triangles);

}  // namespace shelfbeam
