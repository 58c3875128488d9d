#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Receivers on a grid over a rectangle, at the middle of each cell: labels without a fixture.
struct MeasuringPlane {
  std::string id;  ///< the labels are `<id>-<row>-<column>`
  LabelTypeId type;
  Vec3 origin;                                       ///< a corner of the rectangle
  std::array<Vec3, 2> axes{{{1, 0, 0}, {0, 1, 0}}};  ///< of its columns and of its rows; perpendicular
  Vec2 size{1, 1};                                   ///< m, along the axes
  std::optional<Vec3> normal;  ///< that the receivers face; perpendicular to the plane without it
  double spacing = 1;          ///< m, without `counts`
  std::optional<std::array<std::size_t, 2>> counts;

  /// The numbers of columns and of rows.
  std::array<std::size_t, 2> cells() const;
  std::array<Vec3, 4> corners() const;
  /// Calls `use(label)` row by row.
  void each_label(const std::function<void(Label)>& use) const;
};

}  // namespace shelfbeam
