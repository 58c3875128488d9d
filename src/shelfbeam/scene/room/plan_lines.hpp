#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "shelfbeam/scene/room_shape.hpp"

namespace shelfbeam {

/// The lines that divide the plan of a room into parts with the same surfaces everywhere.
struct PlanLines {
  struct Footprints {
    Polygon wall;
    std::vector<Polygon> openings;
  };
  std::vector<Footprints> inner_walls;  ///< by inner wall; also in `polygons`

  std::vector<Polygon> polygons;
  std::vector<std::array<Vec2, 2>> creases;  ///< where a sloped ceiling meets another level

  static PlanLines of(const RoomShape& shape);

  /// Edges and creases.
  std::size_t count() const;
  /// The points in which lines of different polygons meet, except those of an opening with its own wall;
  /// counting ends above `most`.
  std::size_t crossings(std::size_t most) const;

  // Limits for which a room is built within two seconds. With more lines than that, `of` omits creases.
  static constexpr std::size_t max_count = 20'000, max_crossings = 20'000;
};

}  // namespace shelfbeam
