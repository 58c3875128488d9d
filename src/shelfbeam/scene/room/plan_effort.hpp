#pragma once

#include <cstddef>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/room_shape.hpp"

namespace shelfbeam {

/// The effort of reading a plan. Each part of a room is compared with all others, so without a limit the
/// effort would grow with the square of the file.
class PlanEffort {
 public:
  /// Before a polygon is divided along the borders of the room and of its zones. Throws InputError at `json`
  /// if too many edges were near the polygons so far, and then Consequence.
  void divide(const RoomShape& shape, const Polygon& polygon, const JsonCursor& json);

  /// The area that two polygons share, m^2. Throws InputError at `json` after too many
  /// comparisons, and then Consequence.
  double shared_area(const Polygon& a, const Polygon& b, const JsonCursor& json);

  /// Counts the corners of an outline, a hole or a zone. Throws InputError at `json` if there are too many,
  /// and then Consequence.
  void add_corners(const Polygon& polygon, const JsonCursor& json);

 private:
  std::size_t divided_ = 0, compared_ = 0;  ///< edges
  std::size_t corners_ = 0;
};

}  // namespace shelfbeam
