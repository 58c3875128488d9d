#include "shelfbeam/scene/room_shape.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

std::string beyond_box(const Vec3& size, const Vec3& p, double slack) {
  constexpr std::array<const char*, 6> sides{"behind the wall x0", "behind the wall x1", "behind the wall y0",
                                             "behind the wall y1", "below the floor",    "above the ceiling"};
  for (const int axis : {2, 0, 1}) {
    const auto side = 2 * static_cast<std::size_t>(axis);
    if (p[axis] < -slack) return fmt::format("{} ({:.6g} m < 0 m)", sides[side], p[axis]);
    if (p[axis] > size[axis] + slack)
      return fmt::format("{} ({:.6g} m > {:.6g} m)", sides[side + 1], p[axis], size[axis]);
  }
  return {};
}

std::string beyond_outline(const RoomShape& shape, const Vec2& plan, double slack) {
  if (!contains(shape.outline, plan))
    if (const double far = distance_to_border(shape.outline, plan); far > slack)
      return fmt::format("{:.3g} m behind wall {}", far, nearest_edge(shape.outline, plan));
  for (std::size_t k = 0; k < shape.holes.size(); ++k)
    if (contains(shape.holes[k], plan) && distance_to_border(shape.holes[k], plan) > slack)
      return fmt::format("in hole {}", k);
  return {};
}

// Whether a part of the room outside all zones touches a point of the plan.
bool touches_no_zone(const RoomShape& shape, const Vec2& plan) {
  constexpr double radius = 1e-5;  // m, less than the length of any edge
  constexpr int directions = 32;
  for (int k = 0; k < directions; ++k) {
    const double phi = 0.1 + 2 * pi * k / directions;  // not along the axes, as most edges are
    const Vec2 beside{plan[0] + radius * std::cos(phi), plan[1] + radius * std::sin(phi)};
    if (shape.covers(beside) && shape.zone_over(beside) == nullptr) return true;
  }
  return false;
}

// Inside is to the left of a counter-clockwise outline.
double inner_side(const Polygon& outline) {
  return signed_area(outline) > 0 ? 1 : -1;
}

OuterWall wall_of(const Polygon& outline, double side, std::size_t k) {
  const Vec2 &from = outline[k], &to = outline[(k + 1) % outline.size()];
  const double x = to[0] - from[0], y = to[1] - from[1], length = std::hypot(x, y);
  return {from, to, {-side * y / length, side * x / length}};
}

}  // namespace

double CeilingHeight::at(const Vec2& p) const {
  if (!points) return level;
  const auto& [a, b, c] = *points;
  const Vec3 normal = cross(b - a, c - a);
  return a.z - (normal.x * (p[0] - a.x) + normal.y * (p[1] - a.y)) / normal.z;
}

double InnerWall::length() const {
  return std::hypot(to[0] - from[0], to[1] - from[1]);
}

Polygon InnerWall::footprint(double begin, double end) const {
  const double x = (to[0] - from[0]) / length(), y = (to[1] - from[1]) / length(), half = thickness / 2;
  const auto corner = [&](double along, double left) {
    return Vec2{from[0] + along * x - left * y, from[1] + along * y + left * x};
  };
  return {corner(begin, -half), corner(end, -half), corner(end, half), corner(begin, half)};
}

RoomShape RoomShape::box(const Vec3& size) {
  RoomShape shape;
  shape.outline = {{0, 0}, {size.x, 0}, {size.x, size.y}, {0, size.y}};
  shape.height.level = size.z;
  shape.is_box = true;
  return shape;
}

Vec3 RoomShape::lower() const {
  const Vec2 low = bounds_of(outline).low;
  return {low[0], low[1], 0};
}

Vec3 RoomShape::upper() const {
  const Vec2 high = bounds_of(outline).high;
  double top = 0;
  for (const Vec2& p : outline) top = std::max(top, height.at(p));
  for (const CeilingZone& zone : zones)
    for (const Vec2& p : zone.polygon) top = std::max(top, zone.height.at(p));
  return {high[0], high[1], top};
}

OuterWall RoomShape::wall(std::size_t k) const {
  return wall_of(outline, inner_side(outline), k);
}

std::vector<OuterWall> RoomShape::walls() const {
  const double side = inner_side(outline);
  std::vector<OuterWall> all;
  for (std::size_t k = 0; k < outline.size(); ++k) all.push_back(wall_of(outline, side, k));
  return all;
}

double OuterWall::length() const {
  return std::hypot(to[0] - from[0], to[1] - from[1]);
}

double OuterWall::along(const Vec2& p) const {
  const double x = to[0] - from[0], y = to[1] - from[1];
  return (x * (p[0] - from[0]) + y * (p[1] - from[1])) / std::hypot(x, y);
}

std::vector<WallOpening> RoomShape::openings_in(std::size_t k) const {
  std::vector<WallOpening> found;
  for (const OpeningRow& row : openings)
    for (std::size_t n = 0; row.wall == k && n < row.count; ++n) found.push_back(row.opening(n));
  return found;
}

std::array<Vec2, 2> RoomShape::along_wall(std::size_t k, double begin, double end) const {
  const auto [from, to, inward] = wall(k);
  const double x = to[0] - from[0], y = to[1] - from[1], length = std::hypot(x, y);
  const auto point = [&, &start = from](double along) {
    return Vec2{start[0] + along * x / length, start[1] + along * y / length};
  };
  return {point(begin), point(end)};
}

bool RoomShape::is_open(std::size_t k, const Vec3& p) const {
  const double along = wall(k).along({p.x, p.y});
  const std::vector<WallOpening> all = openings_in(k);
  return std::any_of(all.begin(), all.end(), [&](const WallOpening& opening) {
    return opening.at < along && along < opening.at + opening.width && opening.bottom < p.z &&
           p.z < opening.top;
  });
}

bool RoomShape::covers(const Vec2& p) const {
  return contains(outline, p) &&
         std::none_of(holes.begin(), holes.end(), [&](const Polygon& hole) { return contains(hole, p); });
}

const CeilingZone* RoomShape::zone_over(const Vec2& p) const {
  const auto found = std::find_if(zones.begin(), zones.end(),
                                  [&](const CeilingZone& zone) { return contains(zone.polygon, p); });
  return found == zones.end() ? nullptr : &*found;
}

const CeilingHeight& RoomShape::ceiling_over(const Vec2& p) const {
  const CeilingZone* zone = zone_over(p);
  return zone == nullptr ? height : zone->height;
}

std::string RoomShape::beyond(const Vec3& p, double slack) const {
  const Vec2 plan{p.x, p.y};
  if (is_box) {
    // Zones are judged below.
    const double height_here = zones.empty() ? height.level : HUGE_VAL;
    const Vec2 size = bounds_of(outline).high;
    std::string side = beyond_box({size[0], size[1], height_here}, p, slack);
    if (!side.empty() || zones.empty()) return side;
  } else {
    if (p.z < -slack) return fmt::format("below the floor ({:.6g} m < 0 m)", p.z);
    std::string side = beyond_outline(*this, plan, slack);
    if (!side.empty()) return side;
  }
  // On the border of a zone, the highest ceiling that touches the point counts.
  const CeilingZone* highest = zone_over(plan);
  double top = (highest == nullptr ? height : highest->height).at(plan);
  bool is_on_border = false;
  const PlanBounds nearby{{p.x - slack, p.y - slack}, {p.x + slack, p.y + slack}};
  for (const CeilingZone& zone : zones) {
    if (!bounds_of(zone.polygon).meets(nearby) || distance_to_border(zone.polygon, plan) > slack) continue;
    is_on_border = true;
    if (highest != nullptr && zone.height.at(plan) <= top) continue;
    highest = &zone;
    top = zone.height.at(plan);
  }
  if (is_on_border && touches_no_zone(*this, plan) && (highest == nullptr || height.at(plan) > top)) {
    highest = nullptr;
    top = height.at(plan);
  }
  if (p.z <= top + slack) return {};
  return fmt::format("above the ceiling{} ({:.6g} m > {:.6g} m)",
                     highest != nullptr ? " of zone " + in_quotes(highest->id) : "", p.z, top);
}

std::optional<std::pair<std::string, double>> RoomShape::surface_before(const Vec3& p,
                                                                        const Vec3& direction) const {
  constexpr double flat = 1e-9, behind = 1e-6;
  constexpr std::array<const char*, 4> box_walls{"the wall y0", "the wall x1", "the wall y1", "the wall x0"};
  std::optional<std::pair<std::string, double>> first;
  const auto offer = [&](double distance, const auto& name) {
    if (!first || distance < first->second) first = std::pair{std::string(name()), std::max(0.0, distance)};
  };
  const auto meet_edges = [&](const Polygon& polygon, const auto& name) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      const double x = b[0] - a[0], y = b[1] - a[1];
      const double slope = direction.x * y - direction.y * x;
      if (std::abs(slope) < flat * std::hypot(x, y)) continue;
      const double to_x = a[0] - p.x, to_y = a[1] - p.y;
      const double distance = (to_x * y - to_y * x) / slope;
      const double along = (to_x * direction.y - to_y * direction.x) / slope;
      if (distance < -flat || along < 0 || along > 1) continue;
      const double beyond = distance + behind;
      if (!covers({p.x + beyond * direction.x, p.y + beyond * direction.y}))
        offer(distance, [&] { return name(k); });
    }
  };
  meet_edges(outline,
             [&](std::size_t k) { return is_box ? std::string(box_walls[k]) : fmt::format("wall {}", k); });
  for (std::size_t h = 0; h < holes.size(); ++h)
    meet_edges(holes[h], [&](std::size_t) { return fmt::format("hole {}", h); });
  if (direction.z < -flat) offer(-p.z / direction.z, [] { return "the floor"; });
  // The ceiling above the point, as a plane.
  const CeilingHeight& above = ceiling_over({p.x, p.y});
  const double rise = direction.z - (above.at({p.x + direction.x, p.y + direction.y}) - above.at({p.x, p.y}));
  if (rise > flat) offer((above.at({p.x, p.y}) - p.z) / rise, [] { return "the ceiling"; });
  return first;
}

RoomShape RoomShape::scaled(double factor) const {
  RoomShape large = *this;
  const auto scale = [&](Polygon& polygon) {
    for (auto& [x, y] : polygon) {
      x *= factor;
      y *= factor;
    }
  };
  const auto raise = [&](CeilingHeight& ceiling) {
    ceiling.level *= factor;
    if (ceiling.points)
      for (Vec3& p : *ceiling.points) p = p * factor;
  };
  scale(large.outline);
  for (Polygon& hole : large.holes) scale(hole);
  raise(large.height);
  for (CeilingZone& zone : large.zones) {
    scale(zone.polygon);
    raise(zone.height);
  }
  large.inner_walls.clear();  // for drawings only
  large.openings.clear();
  return large;
}

const Polygon& polygon_of(const PlanArea& area, const RoomShape* room) {
  if (const auto* polygon = std::get_if<Polygon>(&area)) return *polygon;
  const std::string& name = std::get<std::string>(area);
  if (name == whole_room || name == room_without_zones) return room->outline;
  return std::find_if(room->zones.begin(), room->zones.end(),
                      [&](const CeilingZone& zone) { return zone.id == name; })
      ->polygon;
}

bool leaves_out_zones(const PlanArea& area) {
  const auto* name = std::get_if<std::string>(&area);
  return name != nullptr && *name == room_without_zones;
}

}  // namespace shelfbeam
