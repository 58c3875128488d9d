#include "shelfbeam/scene/wall_section.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "shelfbeam/math/polygon.hpp"

namespace shelfbeam {

namespace {

constexpr double cut_rounding = 1e-9;  // m

enum class Cover { none, below, cut };

Cover cover_of(const InnerWall& wall, const Vec2& p, double height) {
  if (wall.height && *wall.height <= height) return Cover::below;
  for (const WallOpening& opening : wall.openings)
    if (is_open_at(opening, height) && contains(wall.footprint(opening.at, opening.at + opening.width), p))
      return opening.bottom > 0 ? Cover::below : Cover::none;
  return Cover::cut;
}

bool is_straight(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double x = c[0] - a[0], y = c[1] - a[1];
  return std::abs(x * (b[1] - a[1]) - y * (b[0] - a[0])) <= cut_rounding * std::hypot(x, y);
}

Polygon without_straight_corners(const Polygon& loop) {
  Polygon result;
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (!is_straight(loop[(k + loop.size() - 1) % loop.size()], loop[k], loop[(k + 1) % loop.size()]))
      result.push_back(loop[k]);
  return result;
}

// The outlines of the area that triangles cover: their edges without those between two of them.
std::vector<Polygon> outlines_of(const PlanarMap& map, const std::vector<std::size_t>& triangles) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::set<Edge> edges;
  for (const std::size_t t : triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.emplace(map.triangles[t][k], map.triangles[t][(k + 1) % 3]);
  std::multimap<std::uint32_t, std::uint32_t> ways;
  for (const Edge& edge : edges)
    if (!edges.contains({edge.second, edge.first})) ways.insert(edge);
  std::vector<Polygon> loops;
  while (!ways.empty()) {
    Polygon loop;
    for (auto way = ways.begin(); way != ways.end();) {
      const std::uint32_t next = way->second;
      loop.push_back(map.points[way->first]);
      ways.erase(way);
      way = ways.find(next);
    }
    loops.push_back(without_straight_corners(loop));
  }
  return loops;
}

}  // namespace

std::array<double, 2> ends_of(const RoomShape& shape, std::size_t wall_index) {
  const InnerWall& wall = shape.inner_walls[wall_index];
  const Vec2 along{(wall.to[0] - wall.from[0]) / wall.length(), (wall.to[1] - wall.from[1]) / wall.length()};
  // Whether an end meets a wall of the room, instead of running along it.
  const auto meets = [&](const Polygon& border, const Vec2& end) {
    constexpr double parallel = 1e-3;
    for (std::size_t k = 0; k < border.size(); ++k) {
      const std::array edge{border[k], border[(k + 1) % border.size()]};
      const double x = edge[1][0] - edge[0][0], y = edge[1][1] - edge[0][1];
      if (distance_to_border(edge, end) < wall.thickness / 2 + cut_rounding &&
          std::abs(along[0] * y - along[1] * x) > parallel * std::hypot(x, y))
        return true;
    }
    return false;
  };
  // The same wall, longer by its thickness at both ends.
  const Polygon longer = wall.footprint(-wall.thickness, wall.length() + wall.thickness);
  const auto extension = [&](const Vec2& end, const Vec2& right, const Vec2& left) {
    const Vec2 middle{(right[0] + left[0]) / 2, (right[1] + left[1]) / 2};
    const bool leaves = !shape.covers(right) || !shape.covers(left) || !shape.covers(middle);
    double by = 0;
    if (leaves &&
        (meets(shape.outline, end) || std::any_of(shape.holes.begin(), shape.holes.end(),
                                                  [&](const Polygon& hole) { return meets(hole, end); })))
      by = wall.thickness;
    for (std::size_t o = 0; o < shape.inner_walls.size(); ++o) {
      const InnerWall& other = shape.inner_walls[o];
      for (const Vec2& corner : {other.from, other.to})
        if (o != wall_index && std::hypot(corner[0] - end[0], corner[1] - end[1]) < cut_rounding)
          by = std::max(by, other.thickness / 2);
    }
    return by;
  };
  return {-extension(wall.from, longer[0], longer[3]),
          wall.length() + extension(wall.to, longer[1], longer[2])};
}

std::vector<std::array<Vec2, 2>> outer_wall_lines(const RoomShape& room, std::size_t wall, double height) {
  std::vector<WallOpening> openings = room.openings_in(wall);
  std::erase_if(openings, [&](const WallOpening& one) { return !is_open_at(one, height); });
  std::sort(openings.begin(), openings.end(),
            [](const WallOpening& a, const WallOpening& b) { return a.at < b.at; });
  const auto& [first, last, inward] = room.wall(wall);
  const double length = room.wall(wall).length();
  std::vector<std::array<Vec2, 2>> lines;
  Vec2 from = first;
  double done = 0;
  for (const WallOpening& one : openings) {
    const auto [begin, end] = room.along_wall(wall, one.at, one.at + one.width);
    if (one.at > done + cut_rounding) lines.push_back({from, begin});
    from = end;
    done = one.at + one.width;
  }
  if (length > done + cut_rounding) lines.push_back({from, last});
  return lines;
}

std::vector<WallSection> wall_sections(const RoomShape& room, double height) {
  std::vector<WallSection> sections(room.inner_walls.size());
  if (sections.empty()) return sections;
  std::vector<Polygon> footprints, polygons = room.holes;
  polygons.push_back(room.outline);
  for (std::size_t w = 0; w < room.inner_walls.size(); ++w) {
    const InnerWall& wall = room.inner_walls[w];
    const auto [begin, end] = ends_of(room, w);
    footprints.push_back(wall.footprint(begin, end));
    polygons.push_back(footprints.back());
    for (const WallOpening& opening : wall.openings)
      polygons.push_back(wall.footprint(opening.at, opening.at + opening.width));
  }
  const PlanarMap map = planar_map(polygons);
  // By face: how it is covered, and by which wall.
  std::vector<std::pair<Cover, std::size_t>> covers;
  for (const Vec2& inside : map.inside) {
    std::pair<Cover, std::size_t> most{Cover::none, 0};
    for (std::size_t w = 0; room.covers(inside) && w < footprints.size(); ++w)
      if (contains(footprints[w], inside))
        if (const Cover cover = cover_of(room.inner_walls[w], inside, height); cover > most.first)
          most = {cover, w};
    covers.push_back(most);
  }
  std::map<std::pair<Cover, std::size_t>, std::vector<std::size_t>> triangles;
  for (std::size_t t = 0; t < map.triangles.size(); ++t) triangles[covers[map.face_of[t]]].push_back(t);
  for (const auto& [cover, members] : triangles)
    if (cover.first != Cover::none) {
      WallSection& section = sections[cover.second];
      (cover.first == Cover::cut ? section.cut : section.below) = outlines_of(map, members);
    }
  return sections;
}

}  // namespace shelfbeam
