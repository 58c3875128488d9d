#include "shelfbeam/scene/build/nearest_mount.hpp"

#include "shelfbeam/math/polygon.hpp"

#include "support/testing.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {
namespace {

// A room of 10 x 6 x 3 m with a lower zone from x = 7, a column, and a rail that rises.
const Json shop_store = R"({
    "room": {"size": [10, 6, 3], "floor": "p", "ceiling": "p", "walls": "p",
             "zones": [{"id": "low", "polygon": [[7, 0], [10, 0], [10, 6], [7, 6]], "height": 2.6}]},
    "materials": {"p": {"type": "lambertian", "reflectance": 0.5}},
    "label_types": {"l": {"threshold": 1}},
    "transceiver_types": {"t": {"emission": {"type": "sin2theta", "peak": 1}}},
    "fixtures": [{"type": "box", "id": "column", "min": [4, 2, 0], "max": [4.4, 2.4, 2.9], "material": "p"}],
    "labels": [{"id": "L", "position": [1, 1, 1], "normal": [0, 1, 0], "type": "l"}],
    "transceivers": {
      "rails": [{"id": "R", "type": "t", "points": [[1, 5, 2.5], [5, 5, 2.9]], "spacing": 1}],
      "list": [{"id": "U", "type": "t", "position": [2, 2, 2.9]},
               {"id": "V", "type": "t", "position": [2, 3, 1.2]},
               {"id": "F", "type": "t", "position": [4.2, 1.95, 2.0], "axis": [0, -0.8, -0.6]}]}})"_json;

struct Shop {
  explicit Shop(const Json& json = shop_store) : store(read(json)), scene(make_scene(store)) {}

  Store store;
  Scene scene;

  MountPlace nearest(double x, double y) const { return nearest_mount(store, scene, {{x, y}, {}}, 0.2); }
  MountPlace moved(const std::string& id, double x, double y, std::optional<double> z = {}) const {
    return moved_mount(store, scene, by_id(scene.transceivers, id), {{x, y}, z});
  }
};

void expect_at(const MountPlace& place, const Vec3& p, MountKind on, const std::string& name = "") {
  EXPECT_NEAR(length(place.position - p), 0, 1e-9)
      << place.position.x << ' ' << place.position.y << ' ' << place.position.z;
  EXPECT_EQ(place.on, on);
  EXPECT_EQ(place.name, name);
}

TEST(NearestMount, IsARailAFaceOrTheCeiling) {
  const Shop shop;
  expect_at(shop.nearest(2, 2), {2, 2, 2.95}, MountKind::ceiling);
  expect_at(shop.nearest(8, 2), {8, 2, 2.55}, MountKind::ceiling);
  expect_at(shop.nearest(3, 5.1), {3, 5, 2.7}, MountKind::rail, "R");
  const MountPlace face = shop.nearest(4.3, 1.9);
  expect_at(face, {4.3, 1.98, 2.4}, MountKind::face, "column");
  EXPECT_NEAR(length(face.axis - Vec3{0, -1, 0}), 0, 1e-12);
  expect_at(shop.nearest(0.1, 3), {0.02, 3, 2.4}, MountKind::face, "wall 3");
  expect_at(shop.nearest(-5, 3), {0.01, 3, 2.95}, MountKind::ceiling);
}

// Two columns back to back, and a wall in a zone that is lower than the usual height.
TEST(NearestMount, IsWhereAUnitHasRoom) {
  Json json = shop_store;
  json["room"]["zones"][0]["height"] = 2.2;
  json["fixtures"].push_back(json["fixtures"][0]);
  json["fixtures"][1].update({{"id", "b"}, {"min", {4.4, 2, 0}}, {"max", {4.8, 2.4, 2.9}}});
  json["transceivers"] =
      R"({"list": [{"id": "U", "type": "t", "position": [1, 5.9, 2.97], "axis": [0, -0.3, -1]}]})"_json;
  const Shop shop(json);
  EXPECT_LE(shop.nearest(9.9, 3).position.z, 2.2);
  EXPECT_EQ(shop.nearest(9.9, 3).on, MountKind::face);
  const MountPlace between = shop.nearest(4.4, 2.2);
  EXPECT_EQ(between.on, MountKind::face);
  for (const FixtureOutline& fixture : shop.scene.fixtures)
    EXPECT_FALSE(contains(fixture.footprint, {between.position.x, between.position.y}));
  // A tilted unit that is nearer to the ceiling than to the wall stays below the ceiling.
  expect_at(shop.moved("U", 3, 3), {3, 3, 2.97}, MountKind::ceiling);
}

TEST(MovedMount, StaysOnItsSurface) {
  const Shop shop;
  expect_at(shop.moved("U", 5, 4), {5, 4, 2.9}, MountKind::ceiling);
  expect_at(shop.moved("U", 8, 4), {8, 4, 2.5}, MountKind::ceiling);
  expect_at(shop.moved("U", 12, 4), {9.99, 4, 2.5}, MountKind::ceiling);
  expect_at(shop.moved("R-2", 4, 3), {4, 5, 2.8}, MountKind::rail, "R");
  expect_at(shop.moved("V", 3, 3), {3, 3, 1.2}, MountKind::free);
  expect_at(shop.moved("V", 3, 3, 1.5), {3, 3, 1.5}, MountKind::free);
  expect_at(shop.moved("F", 4.1, 0.5), {4.1, 1.95, 2}, MountKind::face, "column");
  expect_at(shop.moved("F", 4.1, 0.5, 9), {4.1, 1.95, 2.85}, MountKind::face, "column");
  const MountPlace turned = shop.moved("F", 6, 2.2);
  expect_at(turned, {4.45, 2.2, 2}, MountKind::face, "column");
  EXPECT_NEAR(length(turned.axis - Vec3{0.8, 0, -0.6}), 0, 1e-12) << "the tilt stays around the corner";
}

// Wherever a hand points, a unit below the ceiling stays in the room.
TEST(MovedMount, IsInTheRoom) {
  const Shop shop;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> x(-3, 13), y(-3, 9);
  for (int k = 0; k < 2000; ++k) {
    const double px = x(random), py = y(random);
    for (const char* id : {"U", "V", "F", "R-3"})
      EXPECT_EQ(shop.scene.room->beyond(shop.moved(id, px, py).position, 1e-9), "") << id << px << ' ' << py;
    EXPECT_EQ(shop.scene.room->beyond(shop.nearest(px, py).position, 1e-9), "");
  }
}

TEST(NearestMount, KeepsAHeightWithoutARoom) {
  Shop shop;
  shop.scene.room.reset();
  expect_at(shop.nearest(20, 20), {20, 20, 2.5}, MountKind::free);
  expect_at(nearest_mount(shop.store, shop.scene, {{20, 20}, 4.0}, 0.2), {20, 20, 4}, MountKind::free);
}

}  // namespace
}  // namespace shelfbeam::test
