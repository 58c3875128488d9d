#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

MountedType read_unit(const JsonCursor& json, const StoreNames& names) {
  MountedType unit;
  unit.type = names.transceiver_type(json["type"]);
  if (const auto axes = json.find("axes")) {
    unit.axes.clear();
    for (const JsonCursor& axis : axes->elements()) unit.axes.push_back(read_direction(axis));
    if (unit.axes.empty()) axes->fail("is empty", "give at least one direction, or remove the key");
  }
  if (const auto roll = json.find("roll_deg")) unit.roll_deg = read_angle_deg(*roll);
  return unit;
}

MountArea read_area(const JsonCursor& json, const StoreNames& names, const Store& store) {
  json.expect_keys({"type", "area", "spacing", "z", "below_ceiling", "axes", "roll_deg"});
  MountArea mount;
  mount.unit = read_unit(json, names);
  const JsonCursor area = json["area"];
  if (!store.room) json.fail("requires a room", "add a room, or use 'grids'");
  if (area.is_string()) {
    const std::string name = area.text();
    const auto& zones = store.room->shape.zones;
    if (name != "room" &&
        std::none_of(zones.begin(), zones.end(), [&](const CeilingZone& zone) { return zone.id == name; }))
      area.fail("is neither 'room' nor the id of a zone", "correct it, or give a polygon");
    mount.area = name;
  } else {
    mount.area = read_polygon(area);
  }
  mount.spacing = read_length(json["spacing"]);
  const auto z = json.find("z"), below = json.find("below_ceiling");
  if (z && below) below->fail("has no effect beside 'z'", "remove one of the two");
  if (z)
    mount.z = read_coordinate(*z);
  else
    mount.below_ceiling = json["below_ceiling"].metres(0, 1e3);
  return mount;
}

MountRail read_rail(const JsonCursor& json, const StoreNames& names) {
  json.expect_keys({"type", "id", "points", "spacing", "axes", "roll_deg"});
  MountRail rail;
  rail.unit = read_unit(json, names);
  rail.id = read_name(json["id"]);
  for (const JsonCursor& point : json["points"].elements()) {
    rail.points.push_back(read_point(point));
    const std::size_t count = rail.points.size();
    if (count > 1 && !(length(rail.points[count - 1] - rail.points[count - 2]) > 0))
      point.fail("is the point before", "remove it");
  }
  if (rail.points.size() < 2) json["points"].fail("has fewer than two points", "give the line of the rail");
  rail.spacing = read_length(json["spacing"]);
  return rail;
}

using Ids = std::set<std::string_view>;

MountFaces read_faces_mount(const JsonCursor& json, const StoreNames& names, const Ids& fixtures,
                            const Store& store) {
  json.expect_keys(
      {"type", "fixture", "wall", "inner_wall", "z", "spacing", "tilt_deg", "offset", "roll_deg"});
  MountFaces mount;
  mount.type = names.transceiver_type(json["type"]);
  const auto fixture = json.find("fixture"), wall = json.find("wall"), inner = json.find("inner_wall");
  if ((fixture ? 1 : 0) + (wall ? 1 : 0) + (inner ? 1 : 0) != 1)
    json.fail("must have one of 'fixture', 'wall' and 'inner_wall'",
              "name the surface that carries the units");
  if (wall) {
    if (!store.room) wall->fail("names a wall, but the store has no room", "add a room");
    const auto last = static_cast<std::int64_t>(store.room->shape.outline.size()) - 1;
    mount.on = static_cast<std::size_t>(wall->integer(0, last));
  } else {
    const JsonCursor& name = fixture ? *fixture : *inner;
    const std::string id = name.text();
    const bool is_known = fixture
                              ? fixtures.count(id) != 0
                              : store.room && std::any_of(store.room->shape.inner_walls.begin(),
                                                          store.room->shape.inner_walls.end(),
                                                          [&](const InnerWall& one) { return one.id == id; });
    if (!is_known)
      name.fail(fmt::format("names an unknown {}", fixture ? "fixture" : "inner wall"), "correct the id");
    mount.on = id;
  }
  mount.z = read_coordinate(json["z"]);
  mount.spacing = read_length(json["spacing"]);
  if (const auto tilt = json.find("tilt_deg")) mount.tilt_deg = tilt->number(-90, 90);
  if (const auto offset = json.find("offset")) mount.offset = offset->metres(0, 1e3);
  if (const auto roll = json.find("roll_deg")) mount.roll_deg = read_angle_deg(*roll);
  return mount;
}

}  // namespace

KeepOut read_keep_out(const JsonCursor& json) {
  const bool is_polygon = json.find("polygon").has_value();
  json.expect_keys(is_polygon ? std::initializer_list<std::string_view>{"polygon", "z"}
                              : std::initializer_list<std::string_view>{"min", "max", "z"});
  KeepOut area;
  if (is_polygon) {
    area.polygon = read_polygon(json["polygon"]);
    const auto [low, high] = bounds_of(area.polygon);
    area.min = low;
    area.max = high;
  } else {
    area.min = read_plan_point(json["min"]);
    area.max = read_plan_point(json["max"]);
    if (area.max[0] < area.min[0] || area.max[1] < area.min[1])
      json["max"].fail("is below 'min'", "swap them");
  }
  if (const auto z = json.find("z")) {
    const auto heights = z->elements();
    if (heights.size() != 2) z->fail("is not two heights", "give [low, high]");
    area.low = read_coordinate(heights[0]);
    area.high = read_coordinate(heights[1]);
    if (area.high < area.low) z->fail("has its second height below its first", "swap them");
  }
  return area;
}

const Polygon& polygon_of(const MountArea& mount, const RoomShape& room) {
  if (const auto* polygon = std::get_if<Polygon>(&mount.area)) return *polygon;
  const std::string& name = std::get<std::string>(mount.area);
  const auto zone = std::find_if(room.zones.begin(), room.zones.end(),
                                 [&](const CeilingZone& one) { return one.id == name; });
  return zone == room.zones.end() ? room.outline : zone->polygon;
}

void read_mounts(const JsonCursor& section, const StoreNames& names, Store& store) {
  const auto each = [&](const char* key, const auto& read, auto& list) {
    if (const auto found = section.find(key))
      for (const JsonCursor& json : found->elements()) list.push_back({read(json), json.where()});
  };
  Ids ids;
  for (const auto& [fixture, where] : store.fixtures) ids.insert(id_of(fixture));
  each(
      "areas", [&](const JsonCursor& json) { return read_area(json, names, store); }, store.areas);
  each(
      "rails", [&](const JsonCursor& json) { return read_rail(json, names); }, store.rails);
  each(
      "on", [&](const JsonCursor& json) { return read_faces_mount(json, names, ids, store); }, store.faces);
}

}  // namespace shelfbeam
