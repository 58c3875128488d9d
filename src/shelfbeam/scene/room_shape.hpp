#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// The height of a ceiling above the floor at z = 0: level, or a plane through three points.
struct CeilingHeight {
  double level = 0;  ///< m; unless there are `points`
  std::optional<std::array<Vec3, 3>> points;

  double at(const Vec2& p) const;
};

/// A part of the room with another ceiling.
struct CeilingZone {
  std::string id;
  Polygon polygon;
  CeilingHeight height;
};

/// A part of the plan: "room" for all of it, "room without zones", the id of a zone, or a polygon.
using PlanArea = std::variant<std::string, Polygon>;

/// A wall of the outline, in plan.
struct OuterWall {
  Vec2 from{}, to{};
  Vec2 inward{};  ///< unit length

  double length() const;
  /// The distance from `from` to the foot of the perpendicular from a point.
  double along(const Vec2& p) const;
};

/// A hole through a wall.
struct WallOpening {
  double at = 0, width = 0, bottom = 0, top = 0;  ///< m; `at` from the wall's start
  bool has_pane = false;
};

/// A wall that stands in the room, with its middle on the line between two points.
struct InnerWall {
  std::string id;
  Vec2 from{}, to{};
  double thickness = 0.1;
  std::optional<double> height;  ///< m; up to the ceiling if omitted
  std::vector<WallOpening> openings;

  double length() const;
  /// The part between two distances from the start, counter-clockwise in plan.
  Polygon footprint(double begin, double end) const;
};

/// Equal openings in a wall of the outline, with piers between them.
struct OpeningRow {
  std::size_t wall = 0;   ///< number of the wall
  WallOpening first;      ///< `at` from the wall's first corner
  std::size_t count = 1;  ///< at least 1
  double pier = 0.5;      ///< m, width

  /// m, from the first opening to the end of the last.
  double length() const { return static_cast<double>(count) * (first.width + pier) - pier; }
  /// Precondition: k < count.
  WallOpening opening(std::size_t k) const {
    WallOpening one = first;
    one.at += static_cast<double>(k) * (first.width + pier);
    return one;
  }
};

/// The space between the floor at z = 0 and the ceiling.
struct RoomShape {
  Polygon outline;             ///< wall k runs from corner k to corner k + 1
  std::vector<Polygon> holes;  ///< shafts and courtyards, which are not part of the room
  CeilingHeight height;
  std::vector<CeilingZone> zones;
  std::vector<InnerWall> inner_walls;
  std::vector<OpeningRow> openings;
  /// A box from the origin, with walls named x0, x1, y0, y1; otherwise walls are numbered by corners.
  bool is_box = false;

  static RoomShape box(const Vec3& size);

  /// A box with one level ceiling, without inner walls and openings.
  bool is_plain_box() const { return is_box && zones.empty() && inner_walls.empty() && openings.empty(); }
  /// Whether the ceiling is the same height above the floor everywhere.
  bool has_one_height() const { return zones.empty() && !height.points; }
  /// Corners of the bounding box, m. That of a box is its size.
  Vec3 lower() const;
  Vec3 upper() const;
  /// Precondition: k is the number of a wall.
  OuterWall wall(std::size_t k) const;
  /// All walls; faster than one by one, each of which computes the direction of the outline again.
  std::vector<OuterWall> walls() const;
  /// The openings in a wall, in the order of their rows.
  std::vector<WallOpening> openings_in(std::size_t k) const;
  /// The points in plan at two distances from the first corner of a wall.
  std::array<Vec2, 2> along_wall(std::size_t k, double begin, double end) const;
  /// Whether a point of a wall is in one of its openings. Precondition: k is the number of a wall.
  bool is_open(std::size_t k, const Vec3& p) const;
  /// Within the outline and outside the holes.
  bool covers(const Vec2& p) const;
  /// The zone that contains a point of the plan, or nothing.
  const CeilingZone* zone_over(const Vec2& p) const;
  /// The ceiling above a point of the plan.
  const CeilingHeight& ceiling_over(const Vec2& p) const;
  /// The side beyond which a point lies ("above the ceiling (4.2 m > 4 m)"); empty within the room and within
  /// `slack` of its surfaces. Inner walls do not count.
  std::string beyond(const Vec3& p, double slack) const;
  /// The name of the first surface in a direction from a point within the room ("the floor"), and its
  /// distance in units of the direction. Inner walls do not count.
  std::optional<std::pair<std::string, double>> surface_before(const Vec3& p, const Vec3& direction) const;
  RoomShape scaled(double factor) const;
};

inline constexpr const char *whole_room = "room", *room_without_zones = "room without zones";

/// The polygon of an area, with all zones. A name requires a room and is that of one of its zones or of the
/// room.
const Polygon& polygon_of(const PlanArea& area, const RoomShape* room);

/// Whether the zones in the polygon of an area do not belong to it.
bool leaves_out_zones(const PlanArea& area);

}  // namespace shelfbeam
