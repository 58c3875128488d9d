#pragma once

#include <cstddef>
#include <string>

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

 private:
  void expect(bool is_within, const JsonCursor& json, const std::string& problem, const std::string& remedy);

  std::size_t divided_ = 0, compared_ = 0;  ///< edges
  bool is_exceeded_ = false;
};

}  // namespace shelfbeam
