#pragma once

#include <vector>

#include "shelfbeam/scene/room_shape.hpp"

namespace shelfbeam {

/// The zone that contains a point of the plan, or nothing.
const CeilingZone* zone_over(const RoomShape& shape, const Vec2& p);

/// A part of a plan that is outside the room, or under one ceiling.
struct PlanPart {
  std::vector<Vec2> points;                ///< among them all corners
  const CeilingHeight* ceiling = nullptr;  ///< of the room or of the zone; nothing outside the room
};

/// Divides a polygon along the borders of the room and of its zones. Parts no wider than rounding errors are
/// omitted, therefore a polygon without an area has no parts. The shape must outlive the result.
std::vector<PlanPart> plan_parts(const RoomShape& shape, const Polygon& polygon);

/// The lowest ceiling over parts, m; infinite if all are outside the room.
double lowest_ceiling(const std::vector<PlanPart>& parts);

}  // namespace shelfbeam
