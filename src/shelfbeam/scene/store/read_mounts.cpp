#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

class MountReader {
 public:
  MountReader(const StoreNames& names, const Store& store) : names_(names), store_(store) {
    for (const auto& [fixture, where] : store.fixtures) fixtures_.insert(id_of(fixture));
    if (!store.room) return;
    for (const InnerWall& wall : store.room->shape.inner_walls) inner_walls_.insert(wall.id);
  }

  MountArea read_area(const JsonCursor& json) const {
    json.expect_keys({"type", "area", "spacing", "z", "below_ceiling", "axes", "roll_deg"});
    MountArea mount;
    mount.unit = read_unit(json);
    if (!store_.room) json.fail("requires a room", "add a room, or use 'grids'");
    mount.area = read_plan_area(json["area"], store_);
    mount.spacing = read_length(json["spacing"]);
    const auto z = json.find("z"), below = json.find("below_ceiling");
    if (z && below) below->fail("has no effect beside 'z'", "remove one of the two");
    if (z)
      mount.z = read_coordinate(*z);
    else
      mount.below_ceiling = json["below_ceiling"].metres(0, 1e3);
    return mount;
  }

  MountRail read_rail(const JsonCursor& json) {
    json.expect_keys({"type", "id", "points", "spacing", "axes", "roll_deg"});
    MountRail rail;
    rail.unit = read_unit(json);
    rail.id = read_name(json["id"]);
    expect_new_id(rail.id, json["id"], "is", "rename one of the two");
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

  MountFaces read_faces_mount(const JsonCursor& json) {
    json.expect_keys(
        {"type", "id", "fixture", "wall", "inner_wall", "z", "spacing", "tilt_deg", "offset", "roll_deg"});
    MountFaces mount;
    mount.type = names_.transceiver_type(json["type"]);
    read_surface(json, mount);
    if (const auto id = json.find("id")) {
      mount.id = read_name(*id);
      expect_new_id(mount.id, *id, "is", "rename one of the two");
    } else {
      expect_new_id(mount.id, json, "has candidates named after", "give it an 'id'");
    }
    mount.z = read_coordinate(json["z"]);
    mount.spacing = read_length(json["spacing"]);
    if (const auto tilt = json.find("tilt_deg")) mount.tilts_deg = read_tilts(*tilt);
    if (const auto offset = json.find("offset")) mount.offset = offset->metres(0, 1e3);
    if (const auto roll = json.find("roll_deg")) mount.roll_deg = read_angle_deg(*roll);
    return mount;
  }

 private:
  MountedType read_unit(const JsonCursor& json) const {
    MountedType unit;
    unit.type = names_.transceiver_type(json["type"]);
    if (const auto axes = json.find("axes")) {
      unit.axes.clear();
      for (const JsonCursor& axis : axes->elements()) unit.axes.push_back(read_direction(axis));
      if (unit.axes.empty()) axes->fail("is empty", "give at least one direction, or remove the key");
    }
    if (const auto roll = json.find("roll_deg")) unit.roll_deg = read_angle_deg(*roll);
    return unit;
  }

  static std::vector<double> read_tilts(const JsonCursor& json) {
    constexpr double upright = 90;
    if (!json.is_array()) return {json.number(-upright, upright)};
    std::vector<double> tilts;
    for (const JsonCursor& tilt : json.elements()) tilts.push_back(tilt.number(-upright, upright));
    if (tilts.empty()) json.fail("is empty", "give at least one tilt, or remove the key");
    return tilts;
  }

  void read_surface(const JsonCursor& json, MountFaces& mount) const {
    const auto fixture = json.find("fixture"), wall = json.find("wall"), inner = json.find("inner_wall");
    if ((fixture ? 1 : 0) + (wall ? 1 : 0) + (inner ? 1 : 0) != 1)
      json.fail("must have one of 'fixture', 'wall' and 'inner_wall'",
                "name the surface that carries the units");
    if (wall) {
      if (!store_.room) wall->fail("names a wall, but the store has no room", "add a room");
      const auto last = static_cast<std::int64_t>(store_.room->shape.outline.size()) - 1;
      const auto number = static_cast<std::size_t>(wall->integer(0, last));
      mount.on = number;
      mount.id = fmt::format("wall-{}", number);
    } else {
      const JsonCursor& name = fixture ? *fixture : *inner;
      mount.id = name.text();
      mount.on = mount.id;
      if (!(fixture ? fixtures_ : inner_walls_).contains(mount.id))
        name.fail(fmt::format("names an unknown {}", fixture ? "fixture" : "inner wall"), "correct the id");
    }
  }

  // Two rails or members of "on" with one id would have candidates with the same ids.
  void expect_new_id(const std::string& id, const JsonCursor& json, std::string_view relation,
                     const std::string& remedy) {
    const auto [first, is_new] = ids_.emplace(id, json.where());
    if (!is_new)
      json.fail(fmt::format("{} {}, like the candidates of {}", relation, in_quotes(id), first->second),
                remedy);
  }

  const StoreNames& names_;
  const Store& store_;
  std::set<std::string_view> fixtures_, inner_walls_;
  std::map<std::string, std::string> ids_;  // of rails and members of "on", with their locations
};

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

PlanArea read_plan_area(const JsonCursor& json, const Store& store) {
  if (!json.is_string()) return read_polygon(json);
  if (!store.room) json.fail("requires a room", "add a room, or give a polygon");
  std::string name = json.text();
  const auto& zones = store.room->shape.zones;
  if (name != "room" &&
      std::none_of(zones.begin(), zones.end(), [&](const CeilingZone& zone) { return zone.id == name; }))
    json.fail("is neither 'room' nor the id of a zone", "correct it, or give a polygon");
  return name;
}

void read_mounts(const JsonCursor& section, const StoreNames& names, Store& store) {
  const auto each = [&](const char* key, const auto& read, auto& list) {
    if (const auto found = section.find(key))
      for (const JsonCursor& json : found->elements()) list.push_back({read(json), json.where()});
  };
  MountReader reader(names, store);
  each("areas", [&](const JsonCursor& json) { return reader.read_area(json); }, store.areas);
  each("rails", [&](const JsonCursor& json) { return reader.read_rail(json); }, store.rails);
  each("on", [&](const JsonCursor& json) { return reader.read_faces_mount(json); }, store.faces);
}

}  // namespace shelfbeam
