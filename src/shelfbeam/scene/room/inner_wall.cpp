#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/plan_parts.hpp"
#include "shelfbeam/scene/room/room.hpp"
#include "shelfbeam/scene/wall_section.hpp"

namespace shelfbeam {

void expect_pane(const NamedMaterial& material, const std::string& where) {
  if (is_solid(material.material))
    throw InputError(
        where,
        fmt::format("{} is a solid 'dielectric', but a pane has no thickness", in_quotes(material.name)),
        "use a 'thin_dielectric', which models a whole pane");
}

void expect_outer_panes(const Room& room, std::span<const NamedMaterial> materials, const std::string& file) {
  for (std::size_t o = 0; o < room.openings.size(); ++o)
    if (const auto& material = room.openings[o])
      expect_pane(materials[material->value], fmt::format("{}: room.openings[{}].material", file, o));
}

namespace {

// The corners of a convex polygon, counter-clockwise.
Polygon around_middle(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Vec2 middle{};
  for (const auto& [x, y] : points) {
    middle[0] += x / static_cast<double>(points.size());
    middle[1] += y / static_cast<double>(points.size());
  }
  const auto angle = [&](const Vec2& p) { return std::atan2(p[1] - middle[1], p[0] - middle[0]); };
  std::sort(points.begin(), points.end(), [&](const Vec2& a, const Vec2& b) { return angle(a) < angle(b); });
  return points;
}

Polygon::iterator nearest_corner(Polygon& polygon, const Vec2& p) {
  const auto distance = [&](const Vec2& q) { return std::hypot(q[0] - p[0], q[1] - p[1]); };
  return std::min_element(polygon.begin(), polygon.end(),
                          [&](const Vec2& a, const Vec2& b) { return distance(a) < distance(b); });
}

// The parts of a wall's footprint within the room, convex: whole if possible, otherwise triangles.
std::vector<Polygon> within_room(const RoomShape& shape, const Polygon& footprint) {
  const RoomShape walls = walls_of(shape);
  std::vector<Polygon> polygons;
  for (const PlanPart& part : plan_parts(walls, footprint)) {
    if (part.ceiling == nullptr) continue;
    Polygon whole = part.points == footprint ? footprint : around_middle(part.points);
    std::rotate(whole.begin(), nearest_corner(whole, footprint.front()), whole.end());
    if (is_convex(whole))
      polygons.push_back(std::move(whole));
    else
      for (std::size_t k = 0; k + 3 <= part.points.size(); k += 3)
        polygons.push_back({part.points[k], part.points[k + 1], part.points[k + 2]});
  }
  return polygons;
}

}  // namespace

void add_wall_parts(const Room& room, std::size_t wall, const TriangleRange& surface, Scene& scene) {
  const InnerWall& shape = room.shape.inner_walls[wall];
  const auto [begin, end] = ends_of(room.shape, wall);
  const Polygon footprint = shape.footprint(begin, end);
  double height = shape.height.value_or(0);
  if (!shape.height)
    for (const PlanPart& part : plan_parts(room.shape, footprint))
      for (const Vec2& p : part.points)
        if (part.ceiling != nullptr) height = std::max(height, part.ceiling->at(p));
  const auto index = static_cast<std::uint32_t>(scene.fixtures.size());
  const double turn = std::atan2(shape.to[1] - shape.from[1], shape.to[0] - shape.from[0]);
  const std::vector<Polygon> outlines = within_room(room.shape, footprint);
  scene.fixtures.push_back({shape.id, "wall", outlines.size() == 1 ? outlines.front() : footprint, height,
                            turn * 180 / pi, surface.first, surface.count, FixtureForm::wall});

  // Between two ends of openings, the same openings are above one another everywhere.
  std::set<double> ends{begin, end};
  for (const WallOpening& opening : shape.openings) ends.insert({opening.at, opening.at + opening.width});
  std::vector<WallOpening> upwards = shape.openings;
  std::sort(upwards.begin(), upwards.end(),
            [](const WallOpening& a, const WallOpening& b) { return a.bottom < b.bottom; });
  for (auto from = ends.begin(), to = std::next(from); to != ends.end(); ++from, ++to) {
    const double middle = (*from + *to) / 2;
    const std::vector<Polygon> polygons = within_room(room.shape, shape.footprint(*from, *to));
    const auto add = [&](double bottom, double top) {
      if (top > bottom)
        for (const Polygon& polygon : polygons)
          scene.parts.push_back({PartKind::solid, index, room.inner_walls[wall].wall, polygon, bottom, top});
    };
    double bottom = 0;
    for (const WallOpening& opening : upwards) {
      if (middle < opening.at || middle > opening.at + opening.width) continue;
      add(bottom, opening.bottom);
      bottom = opening.top;
    }
    add(bottom, height);
  }
}

}  // namespace shelfbeam
