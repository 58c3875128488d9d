#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shelfbeam/scene/mesh/solid_shells.hpp"

namespace shelfbeam {

/// Corners of triangles by position.
struct WeldedCorners {
  /// For each triangle the numbers of its corners. Corners have the same number if they are equal to the
  /// rounding of single precision, which never applies to corners of one triangle.
  std::vector<std::array<std::uint32_t, 3>> numbers;
  double rounding = 0;  ///< of single precision at the largest coordinate
};

WeldedCorners welded(const std::vector<SolidTriangle>& triangles);

}  // namespace shelfbeam
