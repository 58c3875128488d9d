#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/math/compass.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/room_shape.hpp"

namespace shelfbeam {

/// Candidates of one type at each of several points: one candidate per axis.
struct MountedType {
  TransceiverTypeId type;
  std::vector<Vec3> axes{{0, 0, -1}};  ///< unit length
  double roll_deg = 0;
};

/// Candidates on a grid over a part of the plan, at a height or below the ceiling.
struct MountArea {
  MountedType unit;
  PlanArea area;
  double spacing = 1;
  std::optional<double> z;   ///< m
  double below_ceiling = 0;  ///< m, without `z`
};

/// Candidates along a line of straight pieces, with one at each end.
struct MountRail {
  MountedType unit;
  std::string id;
  std::vector<Vec3> points;
  double spacing = 1;
};

/// Candidates around a fixture or an inner wall, or along a wall of the room. They face away from it, one at
/// each point for each tilt.
struct MountFaces {
  TransceiverTypeId type;
  std::string id;                             ///< the candidates are named after it
  std::variant<std::string, std::size_t> on;  ///< id of the fixture or inner wall, or number of the wall
  std::optional<Compass> face;                ///< of a fixture or inner wall; all around without it
  double z = 0, spacing = 1, offset = 0.02;   ///< m; `offset` from the surface
  std::vector<double> tilts_deg{0};           ///< downwards from horizontal
  double roll_deg = 0;
};

/// A part of the plan, and of the heights, without candidates.
struct KeepOut {
  Vec2 min{}, max{};  ///< the rectangle, or the bounds of the polygon
  Polygon polygon;    ///< empty for a rectangle
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();

  bool contains(const Vec3& p) const {
    const Vec2 plan{p.x, p.y};
    const bool is_within = min[0] <= p.x && p.x <= max[0] && min[1] <= p.y && p.y <= max[1];
    return low <= p.z && p.z <= high && (polygon.empty() ? is_within : shelfbeam::contains(polygon, plan));
  }
};

}  // namespace shelfbeam
