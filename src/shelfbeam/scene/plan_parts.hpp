#pragma once

#include <vector>

#include "shelfbeam/scene/room_shape.hpp"

namespace shelfbeam {

/// A part of a plan that is outside the room, or under one ceiling.
struct PlanPart {
  std::vector<Vec2> points;                ///< among them all corners
  const CeilingHeight* ceiling = nullptr;  ///< of the room or of the zone; nothing outside the room
};

/// Divides a polygon along the borders of the room and of its zones. Parts no wider than rounding errors are
/// omitted, therefore a polygon without an area has no parts. The shape must outlive the result.
std::vector<PlanPart> plan_parts(const RoomShape& shape, const Polygon& polygon);

/// The outline and the holes of a room alone, under one ceiling.
RoomShape walls_of(const RoomShape& shape);

/// Whether one of the parts is outside the room.
bool leave_room(const std::vector<PlanPart>& parts);

/// Whether a block up to `top`, m, over a polygon is within the walls of the room and below its ceilings.
bool is_within_room(const RoomShape& shape, const Polygon& polygon, double top);

/// The lowest ceiling over parts, m; infinite if all are outside the room.
double lowest_ceiling(const std::vector<PlanPart>& parts);

}  // namespace shelfbeam
