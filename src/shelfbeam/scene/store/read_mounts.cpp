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
#include "shelfbeam/scene/field_reader.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

// Checks the mounts of one store, whose rails and members of "on" must have different ids.
class MountReader {
 public:
  MountReader(const StoreNames& names, Store& store, Problems& problems)
      : names_(names), store_(store), problems_(problems) {
    for (const auto& [fixture, where] : store.fixtures) fixtures_.insert(id_of(fixture));
    if (!store.room) return;
    for (const InnerWall& wall : store.room->shape.inner_walls) inner_walls_.insert(wall.id);
  }

  template <class Mount>
  void read(const JsonCursor& json, std::vector<Listed<Mount>>& list) {
    read_list(json, names_, problems_, list,
              [&](FieldReader& reader, Mount& mount) { complete(reader, mount); });
  }

 private:
  void complete(FieldReader& reader, const MountArea& mount) {
    reader.rule({}, [&] {
      problems_.expect_complete("room");
      if (!store_.room) reader.json().fail("requires a room", "add a room, or use 'grids'");
    });
    reader.rule({"area"}, [&] { complete_plan_area(reader.json()["area"], mount.area, store_, problems_); });
  }

  void complete(FieldReader& reader, const MountRail& rail) {
    reader.rule({"id"}, [&] { expect_new_id(rail.id, reader.json()["id"], "is", "rename one of the two"); });
  }

  void complete(FieldReader& reader, MountFaces& mount) {
    const JsonCursor& json = reader.json();
    const bool has_id = reader.is_given("id");
    reader.rule({"fixture", "wall", "inner_wall"}, [&] { complete_surface(reader, mount, has_id); });
    reader.rule({"face"}, [&] {
      if (mount.face && reader.is_given("wall"))
        json["face"].fail("has no effect beside 'wall', which has one face", "remove it");
      if (mount.face && !has_id && !mount.id.empty()) mount.id += fmt::format("-{}", to_text(*mount.face));
    });
    reader.rule({"id"}, [&] {
      if (has_id)
        expect_new_id(mount.id, json["id"], "is", "rename one of the two");
      else if (!mount.id.empty())
        expect_new_id(mount.id, json, "has candidates named after", "give it an 'id'");
    });
  }

  void complete_surface(const FieldReader& reader, MountFaces& mount, bool has_id) const {
    const JsonCursor& json = reader.json();
    if (const auto wall = json.find("wall")) {
      problems_.expect_complete("room");
      if (!store_.room) wall->fail("names a wall, but the store has no room", "add a room");
      const auto last = static_cast<std::int64_t>(store_.room->shape.outline.size()) - 1;
      const auto number = wall->integer(0, last);
      if (!has_id) mount.id = fmt::format("wall-{}", number);
      return;
    }
    const bool is_fixture = reader.is_given("fixture");
    const auto name = json.find(is_fixture ? "fixture" : "inner_wall");
    if (!name) return;
    const std::string id = name->text();
    if (!has_id) mount.id = id;
    if ((is_fixture ? fixtures_ : inner_walls_).contains(id)) return;
    if (is_fixture)
      expect_fixtures(problems_, id);
    else
      problems_.expect_complete("room");
    name->fail(fmt::format("names an unknown {}", is_fixture ? "fixture" : "inner wall"), "correct the id");
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
  Problems& problems_;
  std::set<std::string_view> fixtures_, inner_walls_;
  std::map<std::string, std::string> ids_;  // of rails and members of "on", with their locations
};

}  // namespace

void complete_plan_area(const JsonCursor& json, const PlanArea& area, const Store& store,
                        const Problems& problems) {
  const auto* name = std::get_if<std::string>(&area);
  if (name == nullptr) return;
  problems.expect_complete("room");
  if (!store.room) json.fail("requires a room", "add a room, or give a polygon");
  const auto& zones = store.room->shape.zones;
  if (*name != whole_room && *name != room_without_zones &&
      std::none_of(zones.begin(), zones.end(), [&](const CeilingZone& zone) { return zone.id == *name; }))
    json.fail("is neither 'room' nor 'room without zones' nor the id of a zone",
              "correct it, or give a polygon");
}

void read_mounts(const JsonCursor& section, const StoreNames& names, Store& store, Problems& problems) {
  MountReader reader(names, store, problems);
  const auto each = [&](const char* key, auto& list) {
    problems.collect([&] {
      if (const auto found = section.find(key)) reader.read(*found, list);
    });
  };
  each("areas", store.areas);
  each("rails", store.rails);
  each("on", store.faces);
}

}  // namespace shelfbeam
