#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/room_shape.hpp"

namespace shelfbeam {

/// The distances from the start of an inner wall between which it is built. It is extended into a wall of the
/// room that it meets, and by half of an inner wall at its end, so that no wedge stays open at a corner.
std::array<double, 2> ends_of(const RoomShape& shape, std::size_t wall);

/// An inner wall in plan, cut at a height. Outlines of areas are counter-clockwise, their holes clockwise.
struct WallSection {
  std::vector<Polygon> cut;    ///< where the wall is solid at the height
  std::vector<Polygon> below;  ///< where it is solid only farther down: sills, walls of less height
};

/// The inner walls within the room. Where several meet, the area belongs to the first.
std::vector<WallSection> wall_sections(const RoomShape& room, double height);

/// Whether a wall is open at a height within the width of an opening.
inline bool is_open_at(const WallOpening& opening, double height) {
  return opening.bottom <= height && height < opening.top;
}

/// The lines of a wall of the outline, from its first corner on, where it is solid at a height.
std::vector<std::array<Vec2, 2>> outer_wall_lines(const RoomShape& room, std::size_t wall, double height);

}  // namespace shelfbeam
