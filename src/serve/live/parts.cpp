#include "serve/live/parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>

#include "shelfbeam/math/compass.hpp"
#include "shelfbeam/scene/fixture/fixture.hpp"
#include "shelfbeam/scene/fixture/turn.hpp"

#include "serve/live/place.hpp"

namespace shelfbeam::serve {

namespace {

using Json = nlohmann::ordered_json;

Json points(const std::vector<Vec2>& polygon) {
  Json all = Json::array();
  for (const auto& [x, y] : polygon) all.push_back({x, y});
  return all;
}

std::vector<Vec2> rectangle(const Vec2& low, const Vec2& high) {
  return {low, {high[0], low[1]}, high, {low[0], high[1]}};
}

std::string_view name_of(FixtureForm form) {
  switch (form) {
    case FixtureForm::block:
      return "block";
    case FixtureForm::prism:
      return "prism";
    case FixtureForm::rack:
      return "rack";
    case FixtureForm::chest:
      return "chest";
    case FixtureForm::sheet:
      return "sheet";
    case FixtureForm::mesh:
      return "mesh";
    case FixtureForm::wall:
      return "wall";
  }
  return "";
}

class PartList {
 public:
  PartList(const Draft& draft, const Json& store) : draft_(draft), store_(store) {}

  std::vector<Part> parts() {
    if (draft_.scene.room) add_room(*draft_.scene.room);
    for (const auto* list : {&draft_.store.fixtures, &draft_.store.unfinished})
      for (const auto& listed : *list) entries_.push_back(&listed);
    for (std::size_t f = 0; f < draft_.scene.fixtures.size(); ++f) add_fixture(f);
    add_mounts();
    return std::move(parts_);
  }

 private:
  void add(std::string_view kind, const std::string& pointer, const Json& json) {
    Json part{{"key", pointer.substr(1)}, {"path", pointer}, {"kind", kind}, {"locked", nullptr}};
    part.update(json);
    parts_.push_back({part["key"].get<std::string>(), std::move(part)});
  }

  void add_room(const RoomShape& room) {
    Json holes = Json::array();
    for (const Polygon& hole : room.holes) holes.push_back(points(hole));
    add("room", "/room",
        {{"id", ""},
         {"outline", points(room.outline)},
         {"holes", std::move(holes)},
         {"height", room.upper().z},
         {"is_box", room.is_box}});
    for (std::size_t z = 0; z < room.zones.size(); ++z) {
      const CeilingZone& zone = room.zones[z];
      add("zone", "/room/zones/" + std::to_string(z),
          {{"id", zone.id},
           {"outline", points(zone.polygon)},
           {"height", zone.height.at(zone.polygon.front())}});
    }
    add_openings(room);
  }

  // The first opening of a row is the outline, the others follow.
  void add_openings(const RoomShape& room) {
    for (std::size_t r = 0; r < room.openings.size(); ++r) {
      const OpeningRow& row = room.openings[r];
      Json lines = Json::array();
      for (std::size_t k = 0; k < row.count; ++k) {
        const WallOpening opening = row.opening(k);
        const auto [from, to] = room.along_wall(row.wall, opening.at, opening.at + opening.width);
        lines.push_back(points({from, to}));
      }
      Json json{{"id", ""}, {"outline", lines.front()}, {"height", row.first.top}};
      lines.erase(lines.begin());
      if (!lines.empty()) json["holes"] = std::move(lines);
      add("opening", "/room/openings/" + std::to_string(r), json);
    }
  }

  Json openings_of_wall(const std::string& id) const {
    Json outlines = Json::array();
    if (!draft_.scene.room) return outlines;
    for (const InnerWall& wall : draft_.scene.room->inner_walls)
      if (wall.id == id)
        for (const WallOpening& opening : wall.openings)
          outlines.push_back(points(wall.footprint(opening.at, opening.at + opening.width)));
    return outlines;
  }

  void add_fixture(std::size_t f) {
    const FixtureOutline& fixture = draft_.scene.fixtures[f];
    const std::string& where = draft_.sources.fixtures[f];
    const std::string place = pointer(where);
    Json json{{"id", fixture.id},
              {"type", fixture.type},
              {"form", name_of(fixture.form)},
              {"outline", points(fixture.footprint)},
              {"height", fixture.height},
              {"rotation", fixture.rotation_deg}};
    if (fixture.is_wall()) {
      if (Json holes = openings_of_wall(fixture.id); !holes.empty()) json["holes"] = std::move(holes);
      return add("wall", place, json);
    }
    // The scene has the fixtures of the store in their order, but not those that could not be built.
    while (entry_ < entries_.size() && entries_[entry_]->where != where) ++entry_;
    if (entry_ == entries_.size()) return;
    if (where.ends_with(copy_note(fixture.id))) {
      json["key"] = place.substr(1) + "#" + std::to_string(++copies_[place]);
      json["locked"] = "repeat";
    }
    if (entry_ >= draft_.store.fixtures.size()) json["unfinished"] = true;
    if (const auto footing = footing_of(entries_[entry_++]->value)) {
      json["footing"] = {{"at", {footing->at[0], footing->at[1]}},
                         {"rotation", footing->rotation_deg},
                         {"length", footing->length},
                         {"depth", footing->depth}};
      if (const auto along = against(place, *footing))
        json["against"] = {{"along", {(*along)[0], (*along)[1]}}};
    }
    add("fixture", place, json);
  }

  // The direction in which "from" or "shift" moves a fixture that stands against a wall or another fixture.
  std::optional<Vec2> against(const std::string& pointer, const Footing& footing) const {
    const Json& entry = store_[Json::json_pointer(pointer)];
    const auto found = entry.find("against");
    if (found == entry.end() || !found->is_object()) return {};
    const Vec2 right = turned({1, 0}, footing.rotation_deg);
    const auto wall = found->find("wall");
    if (wall == found->end()) return right;
    // It may be wrong: unfinished fixtures have outlines, too.
    const auto& room = draft_.scene.room;
    if (!room || !wall->is_number_unsigned() || wall->get<std::size_t>() >= room->outline.size()) return {};
    const auto [from, to, inward] = room->wall(wall->get<std::size_t>());
    const bool is_right = (to[0] - from[0]) * right[0] + (to[1] - from[1]) * right[1] > 0;
    return is_right ? right : Vec2{-right[0], -right[1]};
  }

  void add_mounts() {
    const Store& store = draft_.store;
    const RoomShape* const room = draft_.scene.room ? &*draft_.scene.room : nullptr;
    for (const auto& [plane, where] : store.measuring_planes) {
      std::vector<Vec2> outline;
      double top = plane.origin.z;
      for (const Vec3& corner : plane.corners()) {
        outline.push_back({corner.x, corner.y});
        top = std::max(top, corner.z);
      }
      add("plane", pointer(where), {{"id", plane.id}, {"outline", points(outline)}, {"height", top}});
    }
    for (const auto& [area, where] : store.keep_out)
      add("keep_out", pointer(where),
          {{"id", ""},
           {"outline", points(area.polygon.empty() ? rectangle(area.min, area.max) : area.polygon)}});
    for (const auto& [grid, where] : store.grids)
      add("grid", pointer(where),
          {{"id", ""}, {"outline", points(rectangle(grid.min, grid.max))}, {"height", grid.z}});
    for (const auto& [mount, where] : store.areas)
      if (room != nullptr || std::holds_alternative<Polygon>(mount.area))
        add("area", pointer(where), {{"id", ""}, {"outline", points(polygon_of(mount.area, room))}});
    for (const auto& [mount, where] : store.faces)
      if (const auto line = line_of(mount); !line.empty())
        add("faces", pointer(where), {{"id", mount.id}, {"outline", points(line)}, {"height", mount.z}});
    for (const auto& [rail, where] : store.rails) {
      std::vector<Vec2> line;
      for (const Vec3& p : rail.points) line.push_back({p.x, p.y});
      add("rail", pointer(where),
          {{"id", rail.id}, {"outline", points(line)}, {"height", rail.points.front().z}});
    }
  }

  // The faces of a fixture or a wall; empty if it could not be built or has no such face. Of separate faces
  // that look to the same side, the first.
  std::vector<Vec2> line_of(const MountFaces& mount) const {
    const auto& room = draft_.scene.room;
    if (const auto* k = std::get_if<std::size_t>(&mount.on)) {
      if (!room || *k >= room->outline.size()) return {};
      const auto [from, to, inward] = room->wall(*k);
      return {from, to};
    }
    const auto& fixtures = draft_.scene.fixtures;
    const auto fixture = std::ranges::find(fixtures, std::get<std::string>(mount.on), &FixtureOutline::id);
    if (fixture == fixtures.end() || fixture->footprint.empty()) return {};
    const Polygon& footprint = fixture->footprint;
    std::vector<Vec2> line = footprint;
    if (mount.face) {
      const auto runs = edges_towards(footprint, *mount.face);
      if (runs.empty()) return {};
      line.clear();
      for (const std::size_t edge : runs.front()) line.push_back(footprint[edge]);
      line.push_back(footprint[(runs.front().back() + 1) % footprint.size()]);
    } else {
      line.push_back(line.front());
    }
    return line;
  }

  std::string pointer(const std::string& where) const { return entry_of(where, draft_.store.file); }

  const Draft& draft_;
  const Json& store_;
  std::vector<Part> parts_;
  std::unordered_map<std::string, std::size_t> copies_;
  std::vector<const Listed<Fixture>*> entries_;  // of the store
  std::size_t entry_ = 0;                        // behind that of the last fixture
};

}  // namespace

std::vector<Part> parts_of(const Draft& draft, const Json& store) {
  return PartList(draft, store).parts();
}

}  // namespace shelfbeam::serve
