#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/field_values.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/room/room.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

// The walls of a box, in the order of their numbers.
constexpr std::array<std::string_view, 4> box_wall_names{"y0", "x1", "y1", "x0"};

// Reading compares the parts of a room with one another.
constexpr std::size_t max_parts = 1000;

CeilingHeight read_height(const JsonCursor& json) {
  if (!json.is_array()) return {read_length(json), {}};
  const auto corners = json.elements();
  if (corners.size() != 3)
    json.fail(fmt::format("has {} points", corners.size()), "a plane requires three points [x, y, z]");
  const std::array<Vec3, 3> points{read_point(corners[0]), read_point(corners[1]), read_point(corners[2])};
  const Vec3 normal = cross(points[1] - points[0], points[2] - points[0]);
  if (!(std::abs(normal.z) > 1e-6))
    json.fail("is not the plane of a ceiling, because its three points lie on a line in plan",
              "move one of them");
  return {0, points};
}

Json height_json(const CeilingHeight& height) {
  if (!height.points) return height.level;
  Json points = Json::array();
  for (const Vec3& p : *height.points) points.push_back({p.x, p.y, p.z});
  return points;
}

void describe_outer_wall(Fields& f, std::size_t& wall) {
  const CustomValue value{
      [&](const JsonCursor& json) {
        if (json.is_string())
          wall = static_cast<std::size_t>(
              std::find(box_wall_names.begin(), box_wall_names.end(), json.choice(box_wall_names)) -
              box_wall_names.begin());
        else
          wall = static_cast<std::size_t>(json.integer(0, max_parts - 1));
      },
      [&] { return Json(wall); },
      R"({"oneOf": [{"type": "integer", "minimum": 0, "maximum": 999}, {"enum": ["y0", "x1", "y1", "x0"]}]})"};
  f.custom("wall", value,
           {.says = "number of a wall as for `wall_materials`, or the name of a wall of a box: `\"y0\"`, "
                    "`\"x1\"`, `\"y1\"` and `\"x0\"` have the numbers 0 to 3"});
}

// The key of a list of parts of the room.
Field parts_field(std::string_view says, std::size_t count) {
  Field field{.says = says, .longest = max_parts, .is_optional = true, .otherwise = "none"};
  field.is_written = count > 0;
  return field;
}

void describe_height(Fields& f, CeilingHeight& height, std::string_view otherwise) {
  f.custom(
      "height",
      {[&](const JsonCursor& json) { height = read_height(json); }, [&] { return height_json(height); },
       R"({"$ref": "#/$defs/ceiling_height"})"},
      {.says = "height of the ceiling, or [three points](#ceilings)", .unit = "m", .otherwise = otherwise});
}

void describe_holes(Fields& f, std::vector<Polygon>& holes) {
  const CustomValue value{[&](const JsonCursor& json) {
                            if (json.size() > max_parts)
                              json.fail(fmt::format("has {} members", json.size()),
                                        fmt::format("at most {} are allowed", max_parts));
                            for (const JsonCursor& hole : json.elements())
                              holes.push_back(read_polygon(hole));
                          },
                          [&] { return Json(holes); },
                          R"({"type": "array", "items": {"$ref": "#/$defs/polygon"}, "maxItems": 1000})"};
  f.custom(
      "holes", value,
      {.says = "with `outline`: list of polygons that are not part of the room (shafts, courtyards), with "
               "walls all around",
       .unit = "m",
       .is_optional = true,
       .otherwise = "none",
       .is_written = !holes.empty()});
}

void describe_opening(Fields& f, WallOpening& opening, std::string_view at_says) {
  f.scalar("at", Scalar::distance, opening.at, {.says = at_says});
  f.length("width", opening.width, {.says = "width of the opening"});
  f.scalar("bottom", Scalar::distance, opening.bottom,
           {.says = "height of the lower edge", .is_optional = true});
  f.length("top", opening.top, {.says = "height of the upper edge"});
}

void describe_pane(Fields& f, std::string_view key, std::string_view says, std::string_view otherwise,
                   WallOpening& opening, std::optional<MaterialId>& pane) {
  MaterialId material = pane.value_or(MaterialId{});
  if (f.material(
          key, material,
          {.says = says, .is_optional = true, .otherwise = otherwise, .is_written = pane.has_value()})) {
    pane = material;
    opening.has_pane = true;
  }
}

}  // namespace

void describe_repeat(OpeningRow& row, Fields& f) {
  auto count = static_cast<std::int64_t>(row.count);
  if (f.integer("count", count, {.says = "number of openings", .least = 1, .most = max_parts}))
    row.count = static_cast<std::size_t>(count);
  f.length("pier", row.pier, {.says = "width of the wall between two of them"});
}

void Room::fields(Fields& f) {
  f.either(
      {"size"}, shape.is_box,
      [this](Fields& box) {
        Vec3 size = shape.is_box ? shape.upper() : Vec3{};
        if (shape.is_box) size.z = shape.height.level;
        if (describe_triple(box, "size", Scalar::length, size,
                            {.says = "`[x, y, z]`", .otherwise = "*required*, or `outline`"}))
          shape = RoomShape::box(size);
      },
      [this](Fields& plan) {
        plan.polygon("outline", shape.outline,
                     {.says = "corners `[x, y]` in order, in either direction; concave outlines are allowed; "
                              "edges must not cross or touch; wall k runs from corner k to corner k + 1, "
                              "counted from 0",
                      .unit = "m",
                      .otherwise = "*required*, or `size`"});
        describe_holes(plan, shape.holes);
        describe_height(plan, shape.height, "*required* with `outline`");
      });
  f.material("floor", floor, {.says = "material of the floor"});
  f.material("ceiling", ceiling, {.says = "material of the ceiling"});
  f.either(
      {"size"}, shape.is_box, [this](Fields& box) { box_walls(box); },
      [this](Fields& plan) { outline_walls(plan); });
  f.objects(
      "zones", shape.zones.size(), [this](Fields& zone, std::size_t k) { zone_fields(zone, k); },
      parts_field("[parts with another ceiling](#ceilings)", shape.zones.size()));
  f.objects(
      "inner_walls", shape.inner_walls.size(),
      [this](Fields& wall, std::size_t k) { inner_wall_fields(wall, k); },
      parts_field("[walls in the room](#inner-walls)", shape.inner_walls.size()));
  f.objects(
      "openings", shape.openings.size(),
      [this](Fields& opening, std::size_t k) { outer_opening_fields(opening, k); },
      parts_field("[doors and windows in the outer walls](#openings-in-outer-walls)", shape.openings.size()));
}

void Room::box_walls(Fields& f) {
  std::vector<std::pair<std::string, std::uint32_t>> sides{{"x0", 0}, {"x1", 0}, {"y0", 0}, {"y1", 0}};
  const std::array<std::size_t, 4> numbers{3, 1, 0, 2};  // of the walls
  for (std::size_t k = 0; walls.size() == 4 && k < 4; ++k) sides[k].second = walls[numbers[k]].value;
  if (!f.references("walls", NameList::material, sides,
                    {.says = "material; with `size` also one [for each wall](#room)", .one_for_all = true}))
    return;
  walls.resize(4);
  for (std::size_t k = 0; k < 4; ++k) walls[numbers[k]] = {sides[k].second};
  usual_wall = walls.back();
}

void Room::outline_walls(Fields& f) {
  if (f.material("walls", usual_wall, {.says = "material of the walls"}))
    walls.assign(shape.outline.size(), usual_wall);
  std::vector<std::pair<std::string, std::uint32_t>> others;
  for (std::size_t k = 0; k < walls.size(); ++k)
    if (walls[k] != usual_wall) others.emplace_back(fmt::format("{}", k), walls[k].value);
  if (f.references("wall_materials", NameList::material, others,
                   {.says = "with `outline`: number of a wall -> material, if it is not `walls`",
                    .pattern = "^(0|[1-9][0-9]{0,2})$",
                    .is_optional = true,
                    .otherwise = "none",
                    .is_written = !others.empty()}))
    for (const auto& [number, material] : others)
      if (const auto wall = to_whole_number(number, max_parts); wall && *wall < walls.size())
        walls[*wall] = {material};
}

void Room::zone_fields(Fields& f, std::size_t k) {
  if (k == shape.zones.size()) {
    shape.zones.emplace_back();
    zones.push_back({ceiling, ceiling});
  }
  CeilingZone& zone = shape.zones[k];
  auto& materials = zones[k];
  f.text("id", zone.id, {.says = "a name that no other zone has", .is_name = true});
  f.polygon("polygon", zone.polygon, {.says = "corners `[x, y]` in order", .unit = "m"});
  describe_height(f, zone.height, {});
  if (f.material("ceiling", materials.ceiling,
                 {.says = "material of this ceiling", .is_optional = true, .otherwise = "that of the room"}))
    materials.fascia = materials.ceiling;
  f.material(
      "fascia", materials.fascia,
      {.says = "material of the vertical faces at its border; between two zones, that of the lower one",
       .is_optional = true,
       .otherwise = "`ceiling` of the zone"});
}

void Room::inner_wall_fields(Fields& f, std::size_t k) {
  if (k == shape.inner_walls.size()) {
    shape.inner_walls.emplace_back();
    inner_walls.push_back({usual_wall, {}});
  }
  InnerWall& wall = shape.inner_walls[k];
  f.text("id", wall.id, {.says = "a name that no fixture and no other inner wall has", .is_name = true});
  f.plan_point("from", wall.from, {.says = "`[x, y]` of one end of the wall's middle line"});
  f.plan_point("to", wall.to, {.says = "`[x, y]` of the other end"});
  f.length("thickness", wall.thickness, {.says = "thickness of the wall", .is_optional = true});
  f.custom("height",
           {[&](const JsonCursor& json) {
              if (json.is_string())
                json.choice({"ceiling"});
              else
                wall.height = read_length(json);
            },
            [&] { return Json(*wall.height); },
            R"({"oneOf": [{"const": "ceiling"}, {"$ref": "#/$defs/length"}]})"},
           {.says = "height above the floor, or `\"ceiling\"`",
            .unit = "m",
            .is_optional = true,
            .otherwise = "`\"ceiling\"`",
            .is_written = wall.height.has_value()});
  f.material("material", inner_walls[k].wall,
             {.says = "material, also of the faces in openings",
              .is_optional = true,
              .otherwise = "`walls`, or `x0` of it"});
  f.objects(
      "openings", wall.openings.size(),
      [this, k](Fields& opening, std::size_t o) { opening_fields(opening, k, o); },
      parts_field("[doors and windows](#openings)", wall.openings.size()));
}

void Room::opening_fields(Fields& f, std::size_t wall, std::size_t k) {
  auto& of_wall = shape.inner_walls[wall].openings;
  auto& panes = inner_walls[wall].panes;
  if (k == of_wall.size()) {
    of_wall.emplace_back();
    panes.emplace_back();
  }
  describe_opening(f, of_wall[k], "distance along the wall from `from` to the opening");
  describe_pane(f, "pane",
                "material of a pane in the middle of the wall, usually a `thin_dielectric`; not a solid "
                "`dielectric`",
                "none", of_wall[k], panes[k]);
}

void Room::outer_opening_fields(Fields& f, std::size_t k) {
  if (k == shape.openings.size()) {
    shape.openings.emplace_back();
    openings.emplace_back();
  }
  OpeningRow& row = shape.openings[k];
  describe_outer_wall(f, row.wall);
  describe_opening(f, row.first, "distance along the wall from its first corner to the opening");
  describe_pane(f, "material",
                "material of the pane or the door leaf, usually a `thin_dielectric`; not a solid "
                "`dielectric`; light that leaves a convex room does not return",
                "none: the opening is open to the outside", row.first, openings[k]);
  f.object("repeat", [&](Fields& repeat) { describe_repeat(row, repeat); },
           {.says = "several equal openings with [piers](#rows-with-piers) between them",
            .is_optional = true,
            .otherwise = "one opening",
            .is_written = row.count > 1});
}

}  // namespace shelfbeam
