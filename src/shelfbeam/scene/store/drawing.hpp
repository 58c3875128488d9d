#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/fields/fields.hpp"

namespace shelfbeam {

/// A line in a picture, in pixels, whose real length is known, m.
struct ScaleLine {
  std::array<double, 2> from{}, to{};
  double length = 0;

  void fields(Fields& f);
};

/// The picture of a floor plan that the planner shows beneath the shop. Nothing else reads it: it is neither
/// in the scene nor in the resolved store, so no simulation and no hash depends on it.
struct Drawing {
  std::string file;
  std::int64_t page = 1;                        ///< of a PDF file
  std::vector<std::string_view> unit;           ///< of length in a DXF file, if it is known
  std::optional<std::array<double, 2>> origin;  ///< its lower left corner in the coordinates of a DXF file
  std::array<double, 2>
      size{};  ///< pixels, points of a PDF page or units of a DXF file; x to the right, y downwards
  std::array<double, 2> at{};  ///< place of its lower left corner, m
  double rotation_deg = 0;     ///< counterclockwise, about the lower left corner
  std::optional<ScaleLine> scale, check;
  std::optional<std::array<double, 4>> crop;  ///< left, top, right, bottom; pixels
};

void describe(Drawing& drawing, Fields& f);

}  // namespace shelfbeam
