#include "shelfbeam/scene/room/plan_lines.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/scene/wall_section.hpp"

namespace shelfbeam {

namespace {

constexpr double slope_rounding = 1e-9;

using Line = std::array<Vec2, 2>;

class PlanReader {
 public:
  explicit PlanReader(const RoomShape& shape) : shape_(shape) {}

  PlanLines read() const {
    PlanLines lines;
    for (std::size_t w = 0; w < shape_.inner_walls.size(); ++w) lines.inner_walls.push_back(footprints_of(w));
    lines.polygons = shape_.holes;
    lines.polygons.push_back(outline());
    for (const CeilingZone& zone : shape_.zones) lines.polygons.push_back(zone.polygon);
    for (const auto& [wall, openings] : lines.inner_walls) {
      lines.polygons.push_back(wall);
      lines.polygons.insert(lines.polygons.end(), openings.begin(), openings.end());
    }
    if (lines.count() <= PlanLines::max_count) add_creases(lines);
    return lines;
  }

 private:
  // The outline with corners where openings begin and end.
  Polygon outline() const {
    if (shape_.openings.empty()) return shape_.outline;
    Polygon with_ends;
    for (std::size_t k = 0; k < shape_.outline.size(); ++k) {
      const OuterWall wall = shape_.wall(k);
      const double length = wall.length();
      std::set<double> ends;
      for (const WallOpening& opening : shape_.openings_in(k))
        ends.insert({opening.at, opening.at + opening.width});
      constexpr double same = 1e-6;  // m
      double last = 0;
      with_ends.push_back(wall.from);
      for (const double end : ends)
        if (end > last + same && end < length - same) {
          with_ends.push_back(shape_.along_wall(k, end, end).front());
          last = end;
        }
    }
    return with_ends;
  }

  PlanLines::Footprints footprints_of(std::size_t w) const {
    const InnerWall& wall = shape_.inner_walls[w];
    const auto [begin, end] = ends_of(shape_, w);
    PlanLines::Footprints result;
    result.wall = wall.footprint(begin, end);
    for (const WallOpening& opening : wall.openings)
      result.openings.push_back(wall.footprint(opening.at, opening.at + opening.width));
    return result;
  }

  // A surface over a part of the plan.
  struct Surface {
    CeilingHeight height;
    PlanBounds bounds;
  };

  std::vector<Surface> surfaces(const PlanLines& lines) const {
    std::vector<Surface> all{{shape_.height, bounds_of(shape_.outline)}};
    for (const CeilingZone& zone : shape_.zones) all.push_back({zone.height, bounds_of(zone.polygon)});
    for (std::size_t w = 0; w < shape_.inner_walls.size(); ++w) {
      const InnerWall& wall = shape_.inner_walls[w];
      const auto& [whole, openings] = lines.inner_walls[w];
      if (wall.height) all.push_back({{*wall.height, {}}, bounds_of(whole)});
      for (std::size_t o = 0; o < openings.size(); ++o)
        for (const double level : {wall.openings[o].bottom, wall.openings[o].top})
          all.push_back({{level, {}}, bounds_of(openings[o])});
    }
    return all;
  }

  void add_creases(PlanLines& lines) const {
    const std::vector<Surface> all = surfaces(lines);
    if (std::none_of(all.begin(), all.end(),
                     [](const Surface& one) { return one.height.points.has_value(); }))
      return;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        if (all[i].height.points || all[j].height.points) add_crease(all[i], all[j], lines.creases);
        if (lines.count() > PlanLines::max_count) return;
      }
  }

  // The line on which two surfaces have the same height, over the bounds that they share.
  static void add_crease(const Surface& a, const Surface& b, std::vector<Line>& lines) {
    if (!a.bounds.meets(b.bounds)) return;
    constexpr double margin = 0.01;  // m
    Vec2 low{}, high{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      low[axis] = std::max(a.bounds.low[axis], b.bounds.low[axis]) - margin;
      high[axis] = std::min(a.bounds.high[axis], b.bounds.high[axis]) + margin;
    }
    const Vec2 middle{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2};
    const auto difference = [&](const Vec2& p) { return a.height.at(p) - b.height.at(p); };
    const double c = difference(middle), dx = difference({middle[0] + 1, middle[1]}) - c,
                 dy = difference({middle[0], middle[1] + 1}) - c;
    const double slope = std::hypot(dx, dy);
    if (slope < slope_rounding) return;
    const double off = c / slope, half = std::hypot(high[0] - low[0], high[1] - low[1]) / 2;
    if (std::abs(off) > half) return;
    const Vec2 across{dx / slope, dy / slope};
    const Vec2 foot{middle[0] - off * across[0], middle[1] - off * across[1]};
    lines.push_back({Vec2{foot[0] - half * across[1], foot[1] + half * across[0]},
                     Vec2{foot[0] + half * across[1], foot[1] - half * across[0]}});
  }

  const RoomShape& shape_;
};

double side_of(const Line& line, const Vec2& p) {
  const auto& [a, b] = line;
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

bool cross(const Line& a, const Line& b) {
  return side_of(a, b[0]) * side_of(a, b[1]) <= 0 && side_of(b, a[0]) * side_of(b, a[1]) <= 0;
}

}  // namespace

PlanLines PlanLines::of(const RoomShape& shape) {
  return PlanReader(shape).read();
}

std::size_t PlanLines::count() const {
  std::size_t count = creases.size();
  for (const Polygon& polygon : polygons) count += polygon.size();
  return count;
}

std::size_t PlanLines::crossings(std::size_t most) const {
  struct Edge {
    Line line;
    PlanBounds bounds;
    std::size_t polygon;
    std::size_t wall;  // which its footprints share; 0: none
    bool is_opening;
  };
  std::vector<Edge> edges;
  std::size_t number = 0, footprints = 0;
  const auto add = [&](const Line& line, std::size_t wall, bool is_opening) {
    edges.push_back({line, bounds_of(line), number, wall, is_opening});
  };
  const auto add_polygon = [&](const Polygon& polygon, std::size_t wall, bool is_opening) {
    ++number;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      add({polygon[k], polygon[(k + 1) % polygon.size()]}, wall, is_opening);
  };
  for (std::size_t w = 0; w < inner_walls.size(); ++w) {
    const auto& [whole, openings] = inner_walls[w];
    footprints += 1 + openings.size();
    add_polygon(whole, w + 1, false);
    for (const Polygon& opening : openings) add_polygon(opening, w + 1, true);
  }
  for (std::size_t p = 0; p + footprints < polygons.size(); ++p) add_polygon(polygons[p], 0, false);
  for (const Line& crease : creases) {
    ++number;
    add(crease, 0, false);
  }
  const auto counts = [](const Edge& a, const Edge& b) {
    return a.bounds.meets(b.bounds) && a.polygon != b.polygon &&
           (a.wall == 0 || a.wall != b.wall || a.is_opening == b.is_opening) && cross(a.line, b.line);
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < edges.size() && count <= most; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (counts(edges[i], edges[j])) ++count;
  return count;
}

}  // namespace shelfbeam
