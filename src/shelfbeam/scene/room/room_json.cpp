#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/scene/plan_parts.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/room/plan_effort.hpp"
#include "shelfbeam/scene/room/plan_lines.hpp"
#include "shelfbeam/scene/room/room.hpp"
#include "shelfbeam/scene/store_names.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

constexpr double negligible = 1e-6;  // m^2

CeilingHeight read_height(const JsonCursor& json) {
  if (!json.is_array()) return {read_length(json), {}};
  const auto corners = json.elements();
  if (corners.size() != 3)
    json.fail(fmt::format("has {} points", corners.size()), "a plane requires three points [x, y, z]");
  const std::array<Vec3, 3> points{read_point(corners[0]), read_point(corners[1]), read_point(corners[2])};
  const Vec3 normal = cross(points[1] - points[0], points[2] - points[0]);
  if (!(std::abs(normal.z) > negligible))
    json.fail("is not the plane of a ceiling, because its three points lie on a line in plan",
              "move one of them");
  return {0, points};
}

// A ceiling must be above the floor everywhere.
void expect_headroom(const JsonCursor& json, const CeilingHeight& height, const Polygon& polygon) {
  constexpr double least = 0.1, most = 1000;
  for (const Vec2& corner : polygon)
    if (const double z = height.at(corner); !(z >= least && z <= most))
      json.fail(fmt::format("is {} at {}", length_text(z, json.unit()), point_text(corner, json.unit())),
                fmt::format("a ceiling is {} to {} m above the floor", least, most));
}

// The distance from the outline to the farthest point of a polygon outside it. Corners of a part outside may
// all lie on the outline, therefore points between them count, too.
double distance_outside(const Polygon& polygon, const RoomShape& room) {
  RoomShape outer;
  outer.outline = room.outline;
  double farthest = 0;
  const auto include = [&](const Vec2& p) {
    if (!contains(room.outline, p)) farthest = std::max(farthest, distance_to_border(room.outline, p));
  };
  for (const PlanPart& part : plan_parts(outer, polygon)) {
    if (part.ceiling != nullptr) continue;
    for (std::size_t k = 0; k < part.points.size(); ++k) {
      const Vec2 &a = part.points[k], &b = part.points[(k + 1) % part.points.size()];
      include(a);
      include({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2});
    }
  }
  return farthest;
}

// A part beyond the outline is cut off. It may result from rounded corners.
void expect_within_outline(const JsonCursor& json, const Polygon& polygon, const RoomShape& room,
                           PlanEffort& effort) {
  constexpr double rounded = 0.01;
  RoomShape outer;
  outer.outline = room.outline;
  effort.divide(outer, polygon, json);
  if (const double far = distance_outside(polygon, room); far > rounded)
    json.fail(fmt::format("extends {} outside the room", length_text(far, json.unit())),
              room.is_box ? "keep it within the walls" : "keep it within 'outline'");
}

void expect_few_parts(const JsonCursor& list) {
  constexpr std::size_t max_parts = 1000;
  if (list.size() > max_parts)
    list.fail(fmt::format("has {} members", list.size()), fmt::format("at most {} are allowed", max_parts));
}

// Reading compares polygons pair by pair.
void expect_few_corners(const JsonCursor& polygon, const RoomShape& shape) {
  std::size_t corners = shape.outline.size();
  for (const Polygon& hole : shape.holes) corners += hole.size();
  for (const CeilingZone& zone : shape.zones) corners += zone.polygon.size();
  if (corners > PlanLines::max_count)
    polygon.fail(
        fmt::format("is one of too many: outline, holes and zones together have {} corners", corners),
        fmt::format("at most {} are allowed", PlanLines::max_count));
}

// Building the room divides the plan where lines cross.
void expect_few_lines(const JsonCursor& json, const RoomShape& shape) {
  const PlanLines lines = PlanLines::of(shape);
  constexpr auto remedy = "use fewer zones, inner walls and openings, or fewer heights with a sloped ceiling";
  if (lines.count() > PlanLines::max_count)
    json.fail(fmt::format("has more than {} edges in its plan", grouped(PlanLines::max_count)), remedy);
  if (lines.crossings(PlanLines::max_crossings) > PlanLines::max_crossings)
    json.fail(fmt::format("has edges that meet in more than {} points of its plan",
                          grouped(PlanLines::max_crossings)),
              remedy);
}

void read_holes(const JsonCursor& json, RoomShape& shape, PlanEffort& effort) {
  expect_few_parts(json);
  double free = std::abs(signed_area(shape.outline));
  for (const JsonCursor& cursor : json.elements()) {
    Polygon hole = read_polygon(cursor);
    expect_within_outline(cursor, hole, shape, effort);
    for (std::size_t k = 0; k < shape.holes.size(); ++k)
      if (effort.shared_area(hole, shape.holes[k], cursor) > negligible)
        cursor.fail(fmt::format("overlaps hole {}", k), "join the two, or move one");
    free -= effort.shared_area(hole, shape.outline, cursor);
    shape.holes.push_back(std::move(hole));
    expect_few_corners(cursor, shape);
  }
  if (free <= negligible) json.fail("cover the whole room", "remove or correct one of them");
}

std::string read_new_id(const JsonCursor& json, std::set<std::string>& ids) {
  std::string id = read_name(json);
  if (!ids.insert(id).second)
    json.fail(fmt::format("is the duplicate id {}", in_quotes(id)), "make ids unique");
  return id;
}

void read_zones(const JsonCursor& json, const StoreNames& names, Room& room, PlanEffort& effort) {
  expect_few_parts(json);
  std::set<std::string> ids;
  for (const JsonCursor& cursor : json.elements()) {
    cursor.expect_keys({"id", "polygon", "height", "ceiling", "fascia"});
    CeilingZone zone;
    zone.id = read_new_id(cursor["id"], ids);
    if (zone.id == "room") cursor["id"].fail("is the name of the whole room", "use another name");
    zone.polygon = read_polygon(cursor["polygon"]);
    expect_within_outline(cursor["polygon"], zone.polygon, room.shape, effort);
    for (const CeilingZone& other : room.shape.zones)
      if (effort.shared_area(zone.polygon, other.polygon, cursor["polygon"]) > negligible)
        cursor["polygon"].fail(fmt::format("overlaps zone {}", in_quotes(other.id)),
                               "zones must not overlap");
    zone.height = read_height(cursor["height"]);
    expect_headroom(cursor["height"], zone.height, zone.polygon);
    const auto ceiling = cursor.find("ceiling"), fascia = cursor.find("fascia");
    Room::ZoneMaterials materials{room.ceiling, {}};
    if (ceiling) materials.ceiling = names.material(*ceiling);
    materials.fascia = fascia ? names.material(*fascia) : materials.ceiling;
    room.shape.zones.push_back(std::move(zone));
    expect_few_corners(cursor["polygon"], room.shape);
    room.zones.push_back(materials);
  }
}

// Whether an opening extends beyond the outline or into a hole. A wall may end obliquely at a wall of the
// room, so the middle of the wall decides, where panes are.
bool is_cut_off(const RoomShape& shape, InnerWall wall, const WallOpening& opening) {
  wall.thickness = 1e-3;
  RoomShape walls;
  walls.outline = shape.outline;
  walls.holes = shape.holes;
  return leave_room(plan_parts(walls, wall.footprint(opening.at, opening.at + opening.width)));
}

WallOpening read_opening(const JsonCursor& json, const InnerWall& wall, const RoomShape& shape,
                         PlanEffort& effort) {
  json.expect_keys({"at", "width", "bottom", "top", "pane"});
  WallOpening opening;
  opening.at = json["at"].metres(0, 1e3);
  opening.width = read_length(json["width"]);
  if (const auto bottom = json.find("bottom")) opening.bottom = bottom->metres(0, 1e3);
  opening.top = read_length(json["top"]);
  if (opening.top <= opening.bottom) json["top"].fail("is not above 'bottom'", "swap or correct them");
  constexpr double slack = 1e-9;
  const auto text = [&](double metres) { return length_text(metres, json.unit()); };
  if (opening.at + opening.width > wall.length() + slack)
    json.fail(fmt::format("extends from {} to {}, but the wall is {} long", text(opening.at),
                          text(opening.at + opening.width), text(wall.length())),
              "keep the opening within its wall");
  if (wall.height && opening.top > *wall.height + slack)
    json["top"].fail(fmt::format("is above the wall of {}", text(*wall.height)),
                     "lower it, or raise the wall");
  const Polygon footprint = wall.footprint(opening.at, opening.at + opening.width);
  effort.divide(shape, footprint, json);
  if (is_cut_off(shape, wall, opening))
    json.fail("is in a part of its wall that is outside the room and cut off", "keep it within the room");
  const double ceiling = lowest_ceiling(plan_parts(shape, footprint));
  if (opening.top > ceiling + slack)
    json["top"].fail(fmt::format("is above the ceiling of {}", text(ceiling)), "lower it");
  for (const WallOpening& other : wall.openings)
    if (opening.at < other.at + other.width && other.at < opening.at + opening.width &&
        opening.bottom < other.top && other.bottom < opening.top)
      json.fail("overlaps another opening of the wall", "move one of the two");
  return opening;
}

// Whether some of a wall stands in the room; the rest is cut off.
bool stands_in(const RoomShape& shape, const InnerWall& wall, const JsonCursor& json, PlanEffort& effort) {
  const Polygon footprint = wall.footprint(0, wall.length());
  double area = effort.shared_area(footprint, shape.outline, json);
  for (const Polygon& hole : shape.holes) area -= effort.shared_area(footprint, hole, json);
  return area > negligible;
}

void read_inner_walls(const JsonCursor& json, const StoreNames& names, MaterialId usual, Room& room,
                      PlanEffort& effort) {
  expect_few_parts(json);
  std::set<std::string> ids;
  for (const JsonCursor& cursor : json.elements()) {
    cursor.expect_keys({"id", "from", "to", "thickness", "height", "material", "openings"});
    InnerWall wall;
    wall.id = read_new_id(cursor["id"], ids);
    wall.from = read_plan_point(cursor["from"]);
    wall.to = read_plan_point(cursor["to"]);
    constexpr double shortest = 1e-3;
    if (wall.length() < shortest) cursor["to"].fail("is at 'from': the wall has no length", "move it");
    if (const auto thickness = cursor.find("thickness")) wall.thickness = read_length(*thickness);
    if (const auto height = cursor.find("height")) {
      if (height->is_string())
        height->choice({"ceiling"});
      else
        wall.height = read_length(*height);
    }
    if (!stands_in(room.shape, wall, cursor, effort)) cursor.fail("is outside the room", "move it inside");
    Room::WallMaterials materials{usual, {}};
    if (const auto material = cursor.find("material")) materials.wall = names.material(*material);
    if (const auto openings = cursor.find("openings")) {
      expect_few_parts(*openings);
      for (const JsonCursor& opening : openings->elements()) {
        wall.openings.push_back(read_opening(opening, wall, room.shape, effort));
        const auto pane = opening.find("pane");
        materials.panes.push_back(pane ? std::optional(names.material(*pane)) : std::nullopt);
        wall.openings.back().has_pane = pane.has_value();
      }
    }
    room.shape.inner_walls.push_back(std::move(wall));
    room.inner_walls.push_back(std::move(materials));
  }
}

void read_box(const JsonCursor& json, const StoreNames& names, Room& room) {
  json["size"].numbers(3);
  const auto size = json["size"].elements();
  room.shape = RoomShape::box({read_length(size[0]), read_length(size[1]), read_length(size[2])});
  const JsonCursor walls = json["walls"];
  if (walls.is_object()) {
    walls.expect_keys({"x0", "x1", "y0", "y1"});
    for (const char* side : {"y0", "x1", "y1", "x0"}) room.walls.push_back(names.material(walls[side]));
  } else {
    room.walls.assign(4, names.material(walls));
  }
  room.usual_wall = room.walls.back();
}

void read_outline(const JsonCursor& json, const StoreNames& names, Room& room, PlanEffort& effort) {
  room.shape.outline = read_polygon(json["outline"]);
  const std::size_t walls = room.shape.outline.size();
  room.walls.assign(walls, names.material(json["walls"]));
  room.usual_wall = room.walls.front();
  if (const auto others = json.find("wall_materials"))
    for (const auto& [number, name] : others->members()) {
      const auto wall = to_whole_number(number, walls - 1);
      if (!wall)
        name.fail("is not the number of a wall", fmt::format("the outline has the walls 0 to {}", walls - 1));
      room.walls[*wall] = names.material(name);
    }
  if (const auto holes = json.find("holes")) read_holes(*holes, room.shape, effort);
  room.shape.height = read_height(json["height"]);
  expect_headroom(json["height"], room.shape.height, room.shape.outline);
}

Json height_json(const CeilingHeight& height) {
  if (!height.points) return height.level;
  Json points = Json::array();
  for (const Vec3& p : *height.points) points.push_back({p.x, p.y, p.z});
  return points;
}

}  // namespace

Room read_room(const JsonCursor& json, const StoreNames& names) {
  const bool is_box = json.find("size").has_value();
  if (is_box && json.find("outline")) json.fail("has both 'size' and 'outline'", "keep one of them");
  if (is_box)
    json.expect_keys({"size", "floor", "ceiling", "walls", "zones", "inner_walls"});
  else
    json.expect_keys({"outline", "holes", "height", "floor", "ceiling", "walls", "wall_materials", "zones",
                      "inner_walls"});
  Room room;
  PlanEffort effort;
  room.floor = names.material(json["floor"]);
  room.ceiling = names.material(json["ceiling"]);
  if (is_box)
    read_box(json, names, room);
  else
    read_outline(json, names, room, effort);
  if (const auto zones = json.find("zones")) read_zones(*zones, names, room, effort);
  if (const auto walls = json.find("inner_walls"))
    read_inner_walls(*walls, names, room.usual_wall, room, effort);
  expect_few_lines(json, room.shape);
  return room;
}

Json resolved(const Room& room, const std::vector<NamedMaterial>& materials) {
  const auto name = [&](MaterialId id) { return materials[id.value].name; };
  const RoomShape& shape = room.shape;
  Json json;
  if (shape.is_box) {
    const Vec3 size = shape.upper();
    json["size"] = {size.x, size.y, shape.height.level};
  } else {
    json["outline"] = shape.outline;
    if (!shape.holes.empty()) json["holes"] = shape.holes;
    json["height"] = height_json(shape.height);
  }
  json["floor"] = name(room.floor);
  json["ceiling"] = name(room.ceiling);
  if (shape.is_box) {
    json["walls"] = {{"x0", name(room.walls[3])},
                     {"x1", name(room.walls[1])},
                     {"y0", name(room.walls[0])},
                     {"y1", name(room.walls[2])}};
  } else {
    json["walls"] = name(room.usual_wall);
    for (std::size_t k = 0; k < room.walls.size(); ++k)
      if (room.walls[k] != room.usual_wall)
        json["wall_materials"][fmt::format("{}", k)] = name(room.walls[k]);
  }
  for (std::size_t k = 0; k < shape.zones.size(); ++k)
    json["zones"].push_back({{"id", shape.zones[k].id},
                             {"polygon", shape.zones[k].polygon},
                             {"height", height_json(shape.zones[k].height)},
                             {"ceiling", name(room.zones[k].ceiling)},
                             {"fascia", name(room.zones[k].fascia)}});
  for (std::size_t k = 0; k < shape.inner_walls.size(); ++k) {
    const InnerWall& wall = shape.inner_walls[k];
    Json one{{"id", wall.id}, {"from", wall.from}, {"to", wall.to}, {"thickness", wall.thickness}};
    if (wall.height) one["height"] = *wall.height;
    one["material"] = name(room.inner_walls[k].wall);
    for (std::size_t o = 0; o < wall.openings.size(); ++o) {
      const WallOpening& opening = wall.openings[o];
      Json hole{
          {"at", opening.at}, {"width", opening.width}, {"bottom", opening.bottom}, {"top", opening.top}};
      if (const auto& pane = room.inner_walls[k].panes[o]) hole["pane"] = name(*pane);
      one["openings"].push_back(std::move(hole));
    }
    json["inner_walls"].push_back(std::move(one));
  }
  return json;
}

}  // namespace shelfbeam
