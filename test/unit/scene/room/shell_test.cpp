#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/scene/room/plan_lines.hpp"
#include "shelfbeam/scene/scene.hpp"

#include "support/expect_input_error.hpp"
#include "support/l_shaped_room.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

using test::Json;

const std::string l_shape = test::l_shaped_room("tile", "door");

std::array<std::uint32_t, 2> sorted(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

// The edges that do not belong to an even number of triangles: a closed surface has none.
std::size_t open_edges(const Scene& scene, MaterialId pane) {
  std::map<std::array<std::uint32_t, 2>, int> count;
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t)
    if (scene.mesh.materials[t] != pane) {
      const auto& [a, b, c] = scene.mesh.triangles[t];
      ++count[sorted(a, b)], ++count[sorted(b, c)], ++count[sorted(c, a)];
    }
  return static_cast<std::size_t>(
      std::count_if(count.begin(), count.end(), [](const auto& edge) { return edge.second % 2 != 0; }));
}

// By the theorem of Gauss, with normals away from the air; their direction follows from a point beside each
// triangle.
double enclosed_volume(const Scene& scene, MaterialId pane) {
  const auto is_air = [&](const Vec3& p) {
    const Vec2 plan{p.x, p.y};
    const RoomShape& room = *scene.room;
    if (!room.covers(plan) || p.z < 0 || p.z > room.ceiling_over(plan).at(plan)) return false;
    return std::none_of(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
      return part.bottom <= p.z && p.z <= part.top && contains(part.footprint, plan);
    });
  };
  double volume = 0;
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    if (scene.mesh.materials[t] == pane) continue;
    const auto& [a, b, c] = scene.mesh.triangles[t];
    const auto& v = scene.mesh.vertices;
    const Vec3 normal = cross(v[b] - v[a], v[c] - v[a]), centre = (v[a] + v[b] + v[c]) / 3;
    const double side = is_air(centre + normal * (1e-6 / length(normal))) ? -1 : 1;
    volume += side * dot(centre, normal) / 6;
  }
  return volume;
}

TEST(Shell, IsClosedAndEnclosesTheAir) {
  const Scene scene = make_scene(test::read_text(test::store_of_room(l_shape).dump()));
  const auto pane = static_cast<std::uint32_t>(std::find_if(scene.materials.begin(), scene.materials.end(),
                                                            [](const auto& m) { return m.name == "door"; }) -
                                               scene.materials.begin());
  EXPECT_EQ(open_edges(scene, {pane}), 0U);
  Scene torn = scene;
  torn.mesh.triangles.erase(torn.mesh.triangles.begin());
  torn.mesh.materials.erase(torn.mesh.materials.begin());
  EXPECT_EQ(open_edges(torn, {pane}), 3U) << "the control: a triangle is missing";

  // The same volume by midpoints of a grid in plan, exact in height.
  const RoomShape& room = *scene.room;
  double air = 0;
  constexpr std::uint32_t steps = 400;
  const Vec3 high = room.upper();
  for (std::uint32_t ix = 0; ix < steps; ++ix)
    for (std::uint32_t iy = 0; iy < steps; ++iy) {
      const Vec2 p{high.x * (ix + 0.5) / steps, high.y * (iy + 0.5) / steps};
      if (!room.covers(p)) continue;
      const double height = room.ceiling_over(p).at(p);
      air += height;
      for (const Part& part : scene.parts)
        if (contains(part.footprint, p)) air -= std::max(0.0, std::min(part.top, height) - part.bottom);
    }
  air *= high.x * high.y / steps / steps;
  EXPECT_NEAR(enclosed_volume(scene, {pane}), air, 0.005 * air);
}

// Random rooms with corners at whole decimetres: lines meet at any angle, and rounded corners lie beside
// them.
class RandomRooms {
 public:
  explicit RandomRooms(unsigned seed) : random_(seed) {}

  Json next() {
    const std::vector<std::vector<Vec2>> outlines{{{0, 0}, {20, 0}, {20, 20}, {0, 20}},
                                                  {{0, 0}, {20, 6}, {17, 20}, {0, 20}},
                                                  {{0, 20}, {0, 0}, {13, 0}, {20, 7}, {20, 12}, {11, 20}}};
    outline_ = outlines[random_() % outlines.size()];
    Json room{
        {"outline", outline_}, {"height", 4}, {"floor", "tile"}, {"ceiling", "white"}, {"walls", "white"}};
    room["zones"] = Json::array();
    for (int z = 0; z < 3; ++z) {
      Polygon polygon;
      for (int k = 0; k < 3; ++k) polygon.push_back(point());
      Json zone{{"id", fmt::format("Z{}", z)}, {"polygon", polygon}, {"height", 2.5 + 0.1 * z}};
      if (z == 2) zone["height"] = {{0, 0, 3}, {1, 0.1, 3.05}, {0, 1, 3}};
      room["zones"].push_back(zone);
    }
    room["inner_walls"] = Json::array();
    for (int w = 0; w < 2; ++w)
      room["inner_walls"].push_back({{"id", fmt::format("W{}", w)},
                                     {"from", point()},
                                     {"to", point()},
                                     {"openings", {{{"at", 1}, {"width", 0.5}, {"top", 2.1}}}}});
    room["openings"] = Json::array();
    for (int wall = 0; wall < 2; ++wall)
      room["openings"].push_back({{"wall", wall},
                                  {"at", tenth(upto(4))},
                                  {"width", 0.1 + tenth(upto(3))},
                                  {"bottom", tenth(upto(1))},
                                  {"top", 2.4},
                                  {"material", "tile"}});
    return room;
  }

  double upto(double high) { return high * std::uniform_real_distribution()(random_); }

 private:
  // Within the outline's bounds; every third point on the outline.
  Vec2 point() {
    if (random_() % 3 != 0) return {tenth(upto(20)), tenth(upto(20))};
    const std::size_t k = random_() % outline_.size();
    const Vec2 &a = outline_[k], &b = outline_[(k + 1) % outline_.size()];
    const double t = tenth(upto(1));
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
  }
  static double tenth(double value) { return std::round(10 * value) / 10; }

  std::mt19937 random_;
  std::vector<Vec2> outline_;
};

bool is_in_wall(const RoomShape& room, const Vec3& p) {
  const std::vector<PlanLines::Footprints> walls = PlanLines::of(room).inner_walls;
  const Vec2 plan{p.x, p.y};
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (!contains(walls[w].wall, plan)) continue;
    bool is_open = false;
    for (std::size_t o = 0; o < walls[w].openings.size(); ++o)
      is_open |= contains(walls[w].openings[o], plan) && p.z < room.inner_walls[w].openings[o].top;
    if (!is_open) return true;
  }
  return false;
}

// Triangles above a point. A point within a closed surface has an odd number.
std::size_t surfaces_above(const Scene& scene, const Vec3& p) {
  std::size_t count = 0;
  for (const auto& [a, b, c] : scene.mesh.triangles) {
    const auto& v = scene.mesh.vertices;
    const std::array<Vec2, 3> plan{{{v[a].x, v[a].y}, {v[b].x, v[b].y}, {v[c].x, v[c].y}}};
    if (!contains(plan, {p.x, p.y})) continue;
    const Vec3 normal = cross(v[b] - v[a], v[c] - v[a]);
    if (v[a].z - (normal.x * (p.x - v[a].x) + normal.y * (p.y - v[a].y)) / normal.z > p.z) ++count;
  }
  return count;
}

TEST(Shell, IsClosedForRandomRooms) {
  RandomRooms rooms(1);
  int built = 0, shared = 0;
  for (int trial = 0; trial < 6000 && built < 30; ++trial) {
    const Json room = rooms.next();
    Scene scene;
    try {
      scene = make_scene(test::read_text(test::store_of_room(room.dump()).dump()));
    } catch (const InputError&) {
      continue;  // overlapping zones, a wall shorter than its opening
    }
    ++built;
    ASSERT_EQ(open_edges(scene, {UINT32_MAX}), 0u) << room.dump();
    for (int k = 0; k < 100; ++k) {
      const Vec3 p{rooms.upto(20), rooms.upto(20), rooms.upto(4.5)};
      const Vec2 plan{p.x, p.y};
      const bool is_air = scene.room->covers(plan) && p.z < scene.room->ceiling_over(plan).at(plan) &&
                          !is_in_wall(*scene.room, p);
      ASSERT_EQ(surfaces_above(scene, p) % 2 == 1, is_air) << room.dump() << p.x << ' ' << p.y << ' ' << p.z;
      shared += is_air;
    }
  }
  EXPECT_EQ(built, 30);
  EXPECT_GT(shared, 2'000);
}

Json changed(const std::string& pointer, const std::string& value) {
  Json store = test::store_of_room(l_shape);
  store[Json::json_pointer(pointer)] = Json::parse(value);
  return store;
}

// One error, with the place in the file and the place in plan.
TEST(RoomReader, RefusesFaultsWithTheirPlace) {
  struct Fault {
    const char *pointer, *value, *message;
  };
  for (const auto& [pointer, value, message] : std::vector<Fault>{
           {"/room/outline", "[[0, 0], [12, 8], [12, 0], [0, 8]]",
            "room.outline: crosses or touches itself at (6, 4) m"},
           {"/room/outline", "[[0, 0], [0, 0], [12, 0], [12, 8]]",
            "room.outline: has two equal consecutive corners at (0, 0) m"},
           {"/room/outline", "[[0, 0], [12, 0]]", "room.outline: has fewer than three corners; give"},
           {"/room/outline", "[]", "room.outline: has fewer than three corners; give"},
           {"/room/outline", "[[0, 0], [12, 0], [12, 8], [0, 0]]",
            "room.outline: repeats its first corner at the end; remove the last corner"},
           {"/room/holes/0", "[[19, 13], [21, 13], [21, 15]]", "room.holes[0]: extends "},
           {"/room/holes", "[[[0, 0], [12, 0], [12, 5], [20, 6], [20, 14], [0, 14]]]",
            "room.holes: cover the whole room"},
           {"/room/holes", "[[[8, 8], [9, 8], [9, 9]], [[8, 8], [9, 8], [9, 8.5]]]",
            "room.holes[1]: overlaps hole 0"},
           {"/room/height", "[[0, 0, 3], [1, 1, 3], [2, 2, 3]]",
            "room.height: is not the plane of a ceiling"},
           {"/room/height", "[[0, 0, 3], [20, 0, 3], [0, 14, 0]]", "room.height: is 0 m at (20, 14)"},
           {"/room/wall_materials", R"({"6": "white"})",
            "room.wall_materials.6: is not the number of a wall"},
           {"/room/zones/1/polygon", "[[5, 9], [10, 9], [10, 10]]",
            "room.zones[1].polygon: overlaps zone 'low'"},
           {"/room/zones/1/polygon", "[[15, 1], [19, 1], [19, 3]]",
            "room.zones[1].polygon: extends 4.83735 m outside the room; keep it within 'outline'"},
           {"/room/zones/1/polygon", "[[13, 5], [20, 6], [20, 10], [12, 10]]",
            "room.zones[1].polygon: extends 0.124"},
           {"/room/outline", "[[0, 0], [0, 5e-5], [12, 0], [12, 8]]",
            "room.outline: has two consecutive corners less than 0.1 mm apart at (0, 0) m"},
           {"/room/outline", "[[0, 0], [12, 0], [6, 1e-8]]", "room.outline: has an area below 1 mm^2"},
           {"/room/height", "[[0, 0, 3], [20, 0, 3], [0, 14, 1500]]", "room.height: is 1500 m at (20, 14)"},
           {"/room/zones/1/id", R"("room")", "room.zones[1].id: is the name of an area in every room"},
           {"/room/inner_walls/0/openings/0/top", "3.3",
            "room.inner_walls[0].openings[0].top: is above the ceiling of 3.2 m"},
           {"/room/inner_walls/2/openings", R"([{"at": 7.5, "width": 1, "top": 2.95}])",
            "room.inner_walls[2].openings[0].top: is above the ceiling of 2.9"},
           {"/room/inner_walls/2/openings", R"([{"at": 8.5, "width": 0.7, "top": 2}])",
            "room.inner_walls[2].openings[0]: is in a part of its wall that is outside the room and cut off"},
           {"/room/zones/1/id", R"("low")", "room.zones[1].id: is the duplicate id 'low'"},
           {"/room/inner_walls/0/to", "[4, 0]",
            "room.inner_walls[0].to: is at 'from': the wall has no length"},
           {"/room/inner_walls/0/openings/0/at", "5.5",
            "room.inner_walls[0].openings[0]: extends from 5.5 m to 6.4 m, but the wall is 6 m long"},
           {"/room/inner_walls/0/openings/1/at", "1.5",
            "room.inner_walls[0].openings[1]: overlaps another opening"},
           {"/room/inner_walls/0/openings/1/top", "0.9",
            "room.inner_walls[0].openings[1].top: is not above 'bottom'"},
           {"/room/inner_walls/1/openings", R"([{"at": 1, "width": 1, "top": 2.3}])",
            "room.inner_walls[1].openings[0].top: is above the wall of 2.2 m"},
           {"/room/inner_walls/0/openings/1/pane", R"("jar")",
            "room.inner_walls[0].openings[1].pane: 'jar' is a solid 'dielectric'"},
           {"/room/inner_walls/2", R"({"id": "W3", "from": [30, 30], "to": [40, 30]})",
            "room.inner_walls[2]: is outside the room"},
           {"/labels/0/position", "[15, 3, 1]",
            "label 'L' at (15, 3, 1) is outside the room: 2.36 m behind wall 2"},
           {"/labels/0/position", "[8.8, 8.2, 1]", "is outside the room: in hole 0"},
           {"/labels/0/position", "[3, 12, 2.7]",
            "is outside the room: above the ceiling of zone 'low' (2.7 m > 2.6 m)"},
           {"/transceivers/list/0/position", "[1, 1, 3.3]", "above the ceiling (3.3 m > 3.2 m)"}})
    test::expect_input_error(
        [&, &at = pointer, &json = value] { make_scene(test::read_text(changed(at, json).dump())); },
        std::string_view(message));
}

TEST(RoomReader, StatesLengthsInTheUnitOfTheStore) {
  Json store =
      test::store_of_room(R"({"outline": [[0, 0], [8, 6], [8, 0], [0, 6]], "height": 3, "floor": "tile",
                              "ceiling": "white", "walls": "white"})");
  store["units"] = "ft";
  test::expect_input_error([&] { test::read_text(store.dump()); },
                           std::string_view("room.outline: crosses or touches itself at (4, 3) ft"));
}

// Rounded corners: the zone is cut off at the wall.
TEST(RoomReader, ZonesMayExtendACentimetreOutside) {
  const char* zone = "[[13, 5.116], [20, 6], [20, 10], [12, 10]]";
  const Scene scene = make_scene(test::read_text(changed("/room/zones/1/polygon", zone).dump()));
  EXPECT_EQ(open_edges(scene, {8}), 0U);
}

// The points of a zone's border.
TEST(RoomShape, CeilingAtTheBorderOfZonesIsTheHighestThatTouches) {
  RoomShape room;
  room.outline = {{0, 0}, {6, 0}, {6, 4}, {0, 4}};
  room.height.level = 4;
  room.zones = {{"all", room.outline, {2.5, {}}}};
  EXPECT_EQ(room.beyond({0, 3, 3.5}, 1e-6), "above the ceiling of zone 'all' (3.5 m > 2.5 m)");
  EXPECT_EQ(room.beyond({0, 3, 2.5}, 1e-6), "");
  room.zones = {{"left", {{0, 0}, {3, 0}, {3, 4}, {0, 4}}, {2.5, {}}},
                {"right", {{3, 0}, {6, 0}, {6, 2}, {3, 2}}, {2.7, {}}}};
  EXPECT_EQ(room.beyond({3, 1, 3.5}, 1e-6), "above the ceiling of zone 'right' (3.5 m > 2.7 m)");
  EXPECT_EQ(room.beyond({3, 1, 2.7}, 1e-6), "");
  EXPECT_EQ(room.beyond({3, 3, 3.5}, 1e-6), "") << "under the ceiling of the room";
  room.is_box = true;
  EXPECT_EQ(room.beyond({7, 3, 1}, 1e-6), "behind the wall x1 (7 m > 6 m)");
}

TEST(RoomReader, LabelInADoorBelowATransomIsInTheOpen) {
  const Json store = [] {
    Json changes = changed("/room/inner_walls/0/openings",
                           R"([{"at": 1, "width": 0.9, "top": 2.1},
                               {"at": 1.2, "width": 1.5, "bottom": 2.3, "top": 2.8}])");
    changes["labels"][0] =
        Json::parse(R"({"id": "L", "position": [4, 1.5, 1], "normal": [1, 0, 0], "type": "small"})");
    return changes;
  }();
  const Scene scene = make_scene(test::read_text(store.dump()));
  EXPECT_EQ(sentences(scene.warnings), std::vector<std::string>{});
  const auto is_solid = [&](const Vec3& p) {
    return std::any_of(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
      return part.bottom < p.z && p.z < part.top && contains(part.footprint, {p.x, p.y});
    });
  };
  EXPECT_TRUE(is_solid({4, 1.5, 2.2}));
  EXPECT_FALSE(is_solid({4, 1.5, 2.5}));
  EXPECT_FALSE(is_solid({4, 2.5, 2.5}));
  EXPECT_TRUE(is_solid({4, 2.5, 2.2}));
  EXPECT_TRUE(is_solid({4, 1.1, 2.5}));
}

// Rooms that would take minutes or very much memory.
TEST(RoomReader, RefusesTooManyEdgesAndCrossings) {
  Json store = test::store_of_room(l_shape);
  Json& walls = store["room"]["inner_walls"] = Json::array();
  for (int k = 0; k < 1000; ++k)
    walls.push_back({{"id", std::to_string(k)}, {"from", {0.01 * k, 0.1}}, {"to", {10 - 0.01 * k, 13.9}}});
  test::expect_input_error([&] { test::read_text(store.dump()); },
                           std::string_view("room: has edges that meet in more than 20,000 points"));
  for (Json& wall : walls)
    for (int k = 0; k < 10; ++k) wall["openings"].push_back({{"at", k}, {"width", 0.5}, {"top", 2}});
  test::expect_input_error([&] { test::read_text(store.dump()); },
                           std::string_view("room: has more than 20,000 edges"));
  store["room"]["inner_walls"] = Json::array();
  Json& holes = store["room"]["holes"] = Json::array();
  for (int k = 0; k < 1001; ++k) holes.push_back({{1, 1}, {2, 1}, {2, 2}});
  test::expect_input_error([&] { test::read_text(store.dump()); },
                           std::string_view("room.holes: has 1001 members"));
}

TEST(RoomReader, WarnsOfLabelsThatFaceOrLieInInnerWalls) {
  const auto warnings = [](const char* label) {
    std::string text;
    for (const std::string& one :
         sentences(make_scene(test::read_text(changed("/labels/0", label).dump())).warnings))
      text += one + "\n";
    return text;
  };
  EXPECT_EQ(warnings(R"({"id": "L", "position": [3.9, 5, 1], "normal": [-1, 0, 0], "type": "small"})"), "");
  EXPECT_NE(
      warnings(R"({"id": "L", "position": [3.9, 5, 1], "normal": [1, 0, 0], "type": "small"})").find("'W1'"),
      std::string::npos);
  EXPECT_NE(
      warnings(R"({"id": "L", "position": [4, 5, 1], "normal": [1, 0, 0], "type": "small"})").find("'W1'"),
      std::string::npos);
  EXPECT_EQ(warnings(R"({"id": "L", "position": [4, 1.5, 1], "normal": [1, 0, 0], "type": "small"})"), "")
      << "in the door";
}

TEST(RoomReader, ResolvedStoreHasTheSameRoom) {
  const Store store = test::read_text(test::store_of_room(l_shape).dump());
  const Scene scene = make_scene(store);
  const std::string text = resolved_store_json(store, scene);
  const Store again = test::read_text(text);
  EXPECT_EQ(resolved_store_json(again, make_scene(again)), text);
  EXPECT_EQ(make_scene(again).mesh.vertices, scene.mesh.vertices);
}

}  // namespace
}  // namespace shelfbeam
