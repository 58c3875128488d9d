#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/scene/room/plan_lines.hpp"
#include "shelfbeam/scene/room/room.hpp"

namespace shelfbeam {

namespace {

// In m: heights at points of the plan, which lie on a grid, are less exact than the points.
constexpr double height_rounding = 1e-6;
constexpr double plan_rounding = 2e-6;  // of points on walls, where ends of openings are merged

/// The material of triangles and the inner wall to which they belong.
struct Surface {
  MaterialId material;
  std::optional<std::size_t> wall = {};
};

/// A stretch of air on a vertical line. Its ends are surfaces: heights over the plan.
struct Gap {
  CeilingHeight low, high;
  Surface below, above;
};

/// The part of the plan with the same surfaces below and above everywhere.
struct Column {
  std::vector<Gap> gaps;  ///< upwards; none outside the room and within a wall of full height
  bool is_room = false;   ///< within the outline, outside the holes
  CeilingHeight ceiling;  ///< also where a wall reaches it
  std::optional<std::size_t> wall;
  const Room::ZoneMaterials* zone = nullptr;
};

/// Walls between columns and floors and ceilings on them share their vertices: where a level of one ends on
/// the vertical line over a point of the plan, the surfaces of the others have a vertex, too.
class RoomShell {
 public:
  RoomShell(const Room& room, TriangleMesh& mesh)
      : room_(room), shape_(room.shape), mesh_(mesh), outer_walls_(shape_.walls()) {
    const PlanLines lines = PlanLines::of(shape_);
    footprints_ = lines.inner_walls;
    map_ = planar_map(lines.polygons, lines.creases);
    of_walls_.resize(shape_.inner_walls.size());
    for (const Vec2& inside : map_.inside) columns_.push_back(column_at(inside));
    levels_.resize(map_.points.size());
    for (std::size_t t = 0; t < map_.triangles.size(); ++t)
      for (const std::uint32_t point : map_.triangles[t]) {
        if (column_of(t).is_room) add_level(point, column_of(t).ceiling);
        for (const Gap& gap : column_of(t).gaps)
          for (const CeilingHeight* end : {&gap.low, &gap.high}) add_level(point, *end);
      }
    add_openings();
  }

  std::vector<TriangleRange> build() {
    for (std::size_t t = 0; t < map_.triangles.size(); ++t)
      for (const Gap& gap : column_of(t).gaps) {
        add_level_triangle(map_.triangles[t], gap.low, gap.below);
        add_level_triangle(map_.triangles[t], gap.high, gap.above);
      }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> beyond;  // triangle by its directed edge
    for (std::size_t t = 0; t < map_.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) beyond[{map_.triangles[t][k], map_.triangles[t][(k + 1) % 3]}] = t;
    const Column outside;
    for (const auto& [edge, triangle] : beyond) {
      const auto other = beyond.find({edge.second, edge.first});
      add_wall(edge.first, edge.second, column_of(triangle),
               other == beyond.end() ? outside : column_of(other->second));
    }
    for (std::size_t w = 0; w < shape_.inner_walls.size(); ++w) add_panes(w);
    std::vector<TriangleRange> ranges;
    for (const Triangles& wall : of_walls_) {
      ranges.push_back({static_cast<std::uint32_t>(mesh_.triangles.size()),
                        static_cast<std::uint32_t>(wall.corners.size())});
      mesh_.triangles.insert(mesh_.triangles.end(), wall.corners.begin(), wall.corners.end());
      mesh_.materials.insert(mesh_.materials.end(), wall.materials.begin(), wall.materials.end());
    }
    return ranges;
  }

 private:
  const Column& column_of(std::size_t triangle) const { return columns_[map_.face_of[triangle]]; }

  Column column_at(const Vec2& p) const {
    Column column;
    column.is_room = shape_.covers(p);
    if (!column.is_room) return column;
    column.gaps = {{{}, shape_.height, {room_.floor}, {room_.ceiling}}};
    for (std::size_t z = 0; z < shape_.zones.size(); ++z)
      if (contains(shape_.zones[z].polygon, p)) {
        column.zone = &room_.zones[z];
        column.gaps.front().high = shape_.zones[z].height;
        column.gaps.front().above = {room_.zones[z].ceiling};
      }
    column.ceiling = column.gaps.front().high;
    for (std::size_t w = 0; w < footprints_.size(); ++w)
      if (contains(footprints_[w].wall, p)) stand(w, p, column);
    return column;
  }

  // Takes the solid parts of a wall out of a column.
  void stand(std::size_t w, const Vec2& p, Column& column) const {
    const InnerWall& wall = shape_.inner_walls[w];
    if (!column.wall) column.wall = w;
    const Surface surface{room_.inner_walls[w].wall, w};
    std::vector<std::pair<double, double>> holes;
    for (std::size_t o = 0; o < wall.openings.size(); ++o)
      if (contains(footprints_[w].openings[o], p))
        holes.emplace_back(wall.openings[o].bottom, wall.openings[o].top);
    std::sort(holes.begin(), holes.end());
    double from = -1;
    for (const auto& [bottom, top] : holes) {
      remove(from, bottom, p, surface, column.gaps);
      from = top;
    }
    remove(from, wall.height.value_or(HUGE_VAL), p, surface, column.gaps);
  }

  static void remove(double low, double high, const Vec2& p, const Surface& surface, std::vector<Gap>& gaps) {
    if (high - low < height_rounding) return;
    std::vector<Gap> left;
    for (const Gap& gap : gaps) {
      const double bottom = gap.low.at(p), top = gap.high.at(p);
      if (high <= bottom + height_rounding || low >= top - height_rounding) {
        left.push_back(gap);
        continue;
      }
      if (low > bottom + height_rounding) left.push_back({gap.low, {low, {}}, gap.below, surface});
      if (high < top - height_rounding) left.push_back({{high, {}}, gap.high, surface, gap.above});
    }
    gaps = std::move(left);
  }

  // The openings of the outer walls, and their levels at all points of the plan on them.
  void add_openings() {
    openings_.resize(shape_.outline.size());
    for (std::size_t r = 0; r < shape_.openings.size(); ++r) {
      const OpeningRow& row = shape_.openings[r];
      for (std::size_t n = 0; n < row.count; ++n)
        openings_[row.wall].push_back({row.opening(n), room_.openings[r]});
    }
    for (std::size_t k = 0; k < openings_.size(); ++k) {
      auto& on_wall = openings_[k];
      if (on_wall.empty()) continue;
      std::sort(on_wall.begin(), on_wall.end(), [](const OuterOpening& a, const OuterOpening& b) {
        return a.opening.bottom < b.opening.bottom;
      });
      for (std::uint32_t point = 0; point < map_.points.size(); ++point)
        if (const auto along = distance_along(k, map_.points[point]))
          for (const auto& [opening, material] : on_wall)
            if (opening.at - plan_rounding < *along && *along < opening.at + opening.width + plan_rounding) {
              add_level(point, {opening.bottom, {}});
              add_level(point, {opening.top, {}});
            }
    }
  }

  // From the first corner of a wall to a point on it.
  std::optional<double> distance_along(std::size_t k, const Vec2& p) const {
    const OuterWall& wall = outer_walls_[k];
    const double x = p[0] - wall.from[0], y = p[1] - wall.from[1];
    if (std::abs(x * wall.inward[0] + y * wall.inward[1]) > plan_rounding) return {};
    return wall.along(p);
  }

  void add_level(std::uint32_t point, const CeilingHeight& height) {
    const double z = height.at(map_.points[point]);
    std::vector<double>& levels = levels_[point];
    const auto at = std::lower_bound(levels.begin(), levels.end(), z - height_rounding);
    if (at == levels.end() || *at > z + height_rounding) levels.insert(at, z);
  }

  std::size_t level_index(std::uint32_t point, double z) const {
    const std::vector<double>& levels = levels_[point];
    return static_cast<std::size_t>(std::lower_bound(levels.begin(), levels.end(), z - height_rounding) -
                                    levels.begin());
  }

  std::uint32_t vertex(std::uint32_t point, std::size_t level) {
    const auto [found, is_new] =
        vertices_.emplace(std::pair(point, level), static_cast<std::uint32_t>(mesh_.vertices.size()));
    const auto& [x, y] = map_.points[point];
    if (is_new) mesh_.vertices.push_back({x, y, levels_[point][level]});
    return found->second;
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Surface& surface) {
    if (surface.wall) {
      of_walls_[*surface.wall].corners.push_back({a, b, c});
      of_walls_[*surface.wall].materials.push_back(surface.material);
    } else {
      mesh_.triangles.push_back({a, b, c});
      mesh_.materials.push_back(surface.material);
    }
  }

  void add_level_triangle(const std::array<std::uint32_t, 3>& points, const CeilingHeight& height,
                          const Surface& surface) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = vertex(points[k], level_index(points[k], height.at(map_.points[points[k]])));
    add_triangle(corners[0], corners[1], corners[2], surface);
  }

  // The surfaces over an edge where air of `near` meets no air of `far`.
  void add_wall(std::uint32_t u, std::uint32_t v, const Column& near, const Column& far) {
    if (near.gaps.empty()) return;
    const Vec2 &a = map_.points[u], &b = map_.points[v];
    const Vec2 middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    for (const Gap& gap : near.gaps) {
      CeilingHeight from = gap.low;
      for (const Gap& other : far.gaps) {
        if (other.high.at(middle) <= from.at(middle) + height_rounding) continue;
        if (other.low.at(middle) >= gap.high.at(middle) - height_rounding) break;
        add_side(u, v, from, other.low, near, far);
        from = other.high;
      }
      add_side(u, v, from, gap.high, near, far);
    }
  }

  // A surface between two heights: of a wall up to the ceiling of `far`, and a fascia above it.
  void add_side(std::uint32_t u, std::uint32_t v, const CeilingHeight& from, const CeilingHeight& to,
                const Column& near, const Column& far) {
    const Vec2 &a = map_.points[u], &b = map_.points[v];
    const Vec2 middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    const double low = from.at(middle), high = to.at(middle);
    if (low >= high - height_rounding) return;
    if (!far.is_room) return add_outer_side(u, v, from, to);
    const double ceiling = far.wall ? far.ceiling.at(middle) : low;
    const Surface fascia{far.zone != nullptr    ? far.zone->fascia
                         : near.zone != nullptr ? near.zone->fascia
                                                : room_.ceiling};
    if (ceiling <= low + height_rounding) return add_strip(u, v, from, to, fascia);
    const Surface side{room_.inner_walls[*far.wall].wall, far.wall};
    if (ceiling >= high - height_rounding) return add_strip(u, v, from, to, side);
    add_strip(u, v, from, far.ceiling, side);
    add_strip(u, v, far.ceiling, to, fascia);
  }

  // A surface of a wall of the outline or of a hole, with openings in the former.
  void add_outer_side(std::uint32_t u, std::uint32_t v, const CeilingHeight& from, const CeilingHeight& to) {
    const Vec2 &a = map_.points[u], &b = map_.points[v];
    const Vec2 middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    const std::optional<std::size_t> wall = outer_wall(middle);
    if (!wall) return add_strip(u, v, from, to, {room_.usual_wall});
    const Surface surface{room_.walls[*wall]};
    const double high = to.at(middle);
    const auto along = distance_along(*wall, middle);
    CeilingHeight done = from;
    for (const auto& [opening, material] : openings_[*wall]) {
      if (!along || *along < opening.at || *along > opening.at + opening.width) continue;
      const double low = done.at(middle);
      if (opening.top < low + height_rounding || opening.bottom > high - height_rounding) continue;
      const CeilingHeight bottom = opening.bottom > low ? CeilingHeight{opening.bottom, {}} : done,
                          top = opening.top < high - height_rounding ? CeilingHeight{opening.top, {}} : to;
      add_strip(u, v, done, bottom, surface);
      if (material) add_strip(u, v, bottom, top, {*material});
      done = top;
    }
    add_strip(u, v, done, to, surface);
  }

  // The wall of the outline at a point; nothing if the wall is that of a hole.
  std::optional<std::size_t> outer_wall(const Vec2& at) const {
    const double least = distance_to_border(shape_.outline, at);
    for (const Polygon& hole : shape_.holes)
      if (distance_to_border(hole, at) < least) return {};
    return nearest_edge(shape_.outline, at);
  }

  // A strip between two vertical lines, with a vertex at each level on them.
  void add_strip(std::uint32_t u, std::uint32_t v, const CeilingHeight& low, const CeilingHeight& high,
                 const Surface& surface) {
    const auto level = [&](std::uint32_t point, const CeilingHeight& height) {
      return level_index(point, height.at(map_.points[point]));
    };
    std::size_t left = level(u, low), right = level(v, low);
    const std::size_t left_end = level(u, high), right_end = level(v, high);
    while (left < left_end || right < right_end) {
      const bool goes_left =
          right == right_end || (left < left_end && levels_[u][left + 1] <= levels_[v][right + 1]);
      const std::uint32_t a = vertex(u, left), b = vertex(v, right);
      add_triangle(a, b, goes_left ? vertex(u, ++left) : vertex(v, ++right), surface);
    }
  }

  void add_panes(std::size_t w) {
    const InnerWall& wall = shape_.inner_walls[w];
    for (std::size_t o = 0; o < wall.openings.size(); ++o) {
      const auto& pane = room_.inner_walls[w].panes[o];
      if (!pane) continue;
      const WallOpening& opening = wall.openings[o];
      const double x = (wall.to[0] - wall.from[0]) / wall.length(),
                   y = (wall.to[1] - wall.from[1]) / wall.length();
      const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
      for (const double z : {opening.bottom, opening.top})
        for (const double along : {opening.at, opening.at + opening.width})
          mesh_.vertices.push_back({wall.from[0] + along * x, wall.from[1] + along * y, z});
      add_triangle(first, first + 1, first + 3, {*pane, w});
      add_triangle(first, first + 3, first + 2, {*pane, w});
    }
  }

  struct OuterOpening {
    WallOpening opening;
    std::optional<MaterialId> material;
  };

  struct Triangles {
    std::vector<std::array<std::uint32_t, 3>> corners;
    std::vector<MaterialId> materials;
  };

  const Room& room_;
  const RoomShape& shape_;
  TriangleMesh& mesh_;
  std::vector<OuterWall> outer_walls_;
  std::vector<Triangles> of_walls_;                // by inner wall; they follow those of the room
  std::vector<PlanLines::Footprints> footprints_;  // by inner wall
  PlanarMap map_;
  std::vector<Column> columns_;                      // by face of the map
  std::vector<std::vector<OuterOpening>> openings_;  // by wall, upwards
  std::vector<std::vector<double>> levels_;          // by point of the map, ascending
  std::map<std::pair<std::uint32_t, std::size_t>, std::uint32_t> vertices_;
};

// Eight corners, two triangles per side: x0, x1, y0, y1, floor, ceiling.
void add_box(const Room& room, TriangleMesh& mesh) {
  const Vec3 s = room.shape.upper();
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back(
        {(corner & 1) != 0 ? s.x : 0, (corner & 2) != 0 ? s.y : 0, (corner & 4) != 0 ? s.z : 0});
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
      {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};
  const std::array<MaterialId, 6> materials{room.walls[3], room.walls[1], room.walls[0],
                                            room.walls[2], room.floor,    room.ceiling};
  for (std::size_t side = 0; side < sides.size(); ++side) {
    const auto& [a, b, c, d] = sides[side];
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
    mesh.materials.insert(mesh.materials.end(), 2, materials[side]);
  }
}

}  // namespace

Room Room::box(const Vec3& size, MaterialId material) {
  Room room;
  room.shape = RoomShape::box(size);
  room.floor = room.ceiling = room.usual_wall = material;
  room.walls.assign(4, material);
  return room;
}

std::vector<TriangleRange> add_shell(const Room& room, TriangleMesh& mesh) {
  if (!room.shape.is_plain_box()) return RoomShell(room, mesh).build();
  add_box(room, mesh);
  return {};
}

}  // namespace shelfbeam
