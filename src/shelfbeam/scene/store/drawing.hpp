#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

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
  std::int64_t page = 1;         ///< of a PDF file
  std::array<double, 2> size{};  ///< pixels, or points of a PDF page; x to the right, y downwards
  std::array<double, 2> at{};    ///< place of its lower left corner, m
  double rotation_deg = 0;       ///< counterclockwise, about the lower left corner
  std::optional<ScaleLine> scale, check;
  std::optional<std::array<double, 4>> crop;  ///< left, top, right, bottom; pixels
};

void describe(Drawing& drawing, Fields& f);

}  // namespace shelfbeam
