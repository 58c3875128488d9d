#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/scene/room/plan_lines.hpp"
#include "shelfbeam/scene/scene.hpp"

#include "support/l_shaped_room.hpp"
#include "support/testing.hpp"
#include "unit/scene/same_scene.hpp"
#include "unit/scene/sample_store.hpp"
#include "unit/scene/solids.hpp"

namespace shelfbeam::test {
namespace {

const std::string l_shape = l_shaped_room("tile", "door");

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
  const Scene scene = scene_of(store_of_room(l_shape));
  const MaterialId pane{static_cast<std::uint32_t>(
      std::ranges::find(scene.materials, "door", &NamedMaterial::name) - scene.materials.begin())};
  EXPECT_EQ(open_edges(scene.mesh, pane).size(), 0U);
  TriangleMesh torn = scene.mesh;
  torn.triangles.erase(torn.triangles.begin());
  torn.materials.erase(torn.materials.begin());
  EXPECT_EQ(open_edges(torn, pane).size(), 3U) << "the control: a triangle is missing";

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
  EXPECT_NEAR(enclosed_volume(scene, pane), air, 0.005 * air);
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

bool is_in_wall(const RoomShape& room, const std::vector<PlanLines::Footprints>& walls, const Vec3& p) {
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
      scene = scene_of(store_of_room(room.dump()));
    } catch (const InputError&) {
      continue;  // overlapping zones, a wall shorter than its opening
    }
    ++built;
    ASSERT_EQ(open_edges(scene.mesh).size(), 0u) << room.dump();
    const auto walls = PlanLines::of(*scene.room).inner_walls;
    for (int k = 0; k < 100; ++k) {
      const Vec3 p{rooms.upto(20), rooms.upto(20), rooms.upto(4.5)};
      const Vec2 plan{p.x, p.y};
      const bool is_air = scene.room->covers(plan) && p.z < scene.room->ceiling_over(plan).at(plan) &&
                          !is_in_wall(*scene.room, walls, p);
      ASSERT_EQ(surfaces_above(scene, p) % 2 == 1, is_air) << room.dump() << p.x << ' ' << p.y << ' ' << p.z;
      shared += is_air;
    }
  }
  EXPECT_EQ(built, 30);
  EXPECT_GT(shared, 2'000);
}

Json changed(const std::string& pointer, const std::string& value) {
  Json store = store_of_room(l_shape);
  store[Json::json_pointer(pointer)] = Json::parse(value);
  return store;
}

// Rounded corners: the zone is cut off at the wall.
TEST(RoomReader, ZonesMayExtendACentimetreOutside) {
  const char* zone = "[[13, 5.116], [20, 6], [20, 10], [12, 10]]";
  const Scene scene = scene_of(changed("/room/zones/1/polygon", zone));
  EXPECT_EQ(open_edges(scene.mesh, MaterialId{8}).size(), 0U);
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
  Json store = changed("/room/inner_walls/0/openings",
                       R"([{"at": 1, "width": 0.9, "top": 2.1},
                           {"at": 1.2, "width": 1.5, "bottom": 2.3, "top": 2.8}])");
  store["labels"][0]["position"] = {4, 1.5, 1};
  const Scene scene = scene_of(store);
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
  Json store = store_of_room(l_shape);
  Json& walls = store["room"]["inner_walls"] = Json::array();
  for (int k = 0; k < 1000; ++k)
    walls.push_back({{"id", std::to_string(k)}, {"from", {0.01 * k, 0.1}}, {"to", {10 - 0.01 * k, 13.9}}});
  expect_input_error([&] { read(store); }, "room: has edges that meet in more than 20,000 points");
  for (Json& wall : walls)
    for (int k = 0; k < 10; ++k) wall["openings"].push_back({{"at", k}, {"width", 0.5}, {"top", 2}});
  expect_input_error([&] { read(store); }, "room: has more than 20,000 edges");
  store["room"]["inner_walls"] = Json::array();
  Json& holes = store["room"]["holes"] = Json::array();
  for (int k = 0; k < 1001; ++k) holes.push_back({{1, 1}, {2, 1}, {2, 2}});
  expect_input_error([&] { read(store); }, "room.holes: has 1001 members");
}

TEST(RoomReader, WarnsOfLabelsThatFaceOrLieInInnerWalls) {
  const auto warnings = [](const Vec3& at, double x) {
    Json store = store_of_room(l_shape);
    store["labels"][0].update({{"position", {at.x, at.y, at.z}}, {"normal", {x, 0, 0}}});
    return warnings_of(store);
  };
  const auto names_the_wall = testing::Contains(testing::HasSubstr("'W1'"));
  EXPECT_THAT(warnings({3.9, 5, 1}, -1), testing::IsEmpty());
  EXPECT_THAT(warnings({3.9, 5, 1}, 1), names_the_wall);
  EXPECT_THAT(warnings({4, 5, 1}, 1), names_the_wall);
  EXPECT_THAT(warnings({4, 1.5, 1}, 1), testing::IsEmpty()) << "in the door";
}

TEST(RoomReader, ResolvedStoreHasTheSameRoom) {
  expect_same_scene(read(store_of_room(l_shape)));
}

}  // namespace
}  // namespace shelfbeam::test
