#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

struct PolygonFault {
  std::string problem;  ///< "crosses or touches itself"
  Vec2 at;
  std::string remedy;
};

/// Nothing if the polygon has at least three corners and an area, its edges are at least 0.1 mm long, and no
/// two of them cross or touch.
std::optional<PolygonFault> fault_of(const Polygon& polygon);

/// Positive if the corners are counter-clockwise.
double signed_area(std::span<const Vec2> polygon);

/// The distance by which one of two convex polygons must move until they no longer overlap (separating axes);
/// not positive if they do not. They may be degenerate to a line.
double overlap_depth(std::span<const Vec2> one, std::span<const Vec2> other);
/// Whether two convex polygons share more than a border.
bool overlap(std::span<const Vec2> one, std::span<const Vec2> other);

/// Whether a counter-clockwise polygon without fault turns nowhere to the right, except by rounding.
bool is_convex(const Polygon& polygon);

/// Points on the border may count as inside or outside.
bool contains(std::span<const Vec2> polygon, const Vec2& point);

/// The distance from a point to the nearest edge.
double distance_to_border(std::span<const Vec2> polygon, const Vec2& point);

/// The edge nearest to a point: edge k runs from corner k to corner k + 1.
std::size_t nearest_edge(std::span<const Vec2> polygon, const Vec2& point);

/// A rectangle with sides along x and y.
struct PlanBounds {
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};

  double area() const { return (high[0] - low[0]) * (high[1] - low[1]); }
  bool meets(const PlanBounds& other) const {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
           other.low[1] <= high[1];
  }
};
PlanBounds bounds_of(std::span<const Vec2> polygon);

/// The area that two polygons share, m^2. Precondition: neither has a fault.
double shared_area(const Polygon& a, const Polygon& b);

/// The plane divided by lines. Triangles of neighbouring faces meet vertex to vertex.
struct PlanarMap {
  std::vector<Vec2> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of points, counter-clockwise
  std::vector<std::uint32_t> face_of;                   ///< by triangle
  std::vector<Vec2> inside;                             ///< by face: a point within it
};

/// The triangles of a polygon without fault, between its own corners.
PlanarMap triangulated(const Polygon& polygon);

/// The bounded faces between the edges of polygons, which may cross and overlap, and further lines. Points
/// are rounded to a grid of 0.1 um.
PlanarMap planar_map(std::span<const Polygon> polygons, std::span<const std::array<Vec2, 2>> lines = {});

}  // namespace shelfbeam
