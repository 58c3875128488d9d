// Tests how a page describes the place of a unit: by distances, and in words.

#include "shelfbeam/report/mounting/mounting_sheet.hpp"
#include "shelfbeam/report/place/place_text.hpp"
#include "shelfbeam/report/place/shop_place.hpp"

#include "support/processor_time.hpp"
#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

std::string texts_of(const Scene& scene, const Vec3& unit) {
  std::string text;
  for (const Reference& reference : references_of(scene, unit))
    text += std::to_string(centimetres(reference.distance)) + " " + name_of(english(), reference) + "; ";
  return text;
}

// A room of 20 x 30 m with a tall box, a low one and an upright mesh.
Store hall() {
  Store store = empty_store("Hall", {20, 30, 4});
  add(store, Box{"column", {9, 14, 0}, {10, 15, 4}, {}});
  add(store, Box{"table", {9, 20, 0}, {11, 24, 1}, {}});
  add(store, mesh("wall", {{4, 2, 0}, {6, 4, 0}, {6, 4, 4}, {4, 2, 4}}, {{0, 1, 2}, {0, 2, 3}}));
  add_devices(store, {15, 5, 1}, {15, 8, 3.9});
  return store;
}

TEST(Reference, IsTheNearestSurfaceAtTheHeightOfTheUnit) {
  const Scene scene = make_scene(hall());
  EXPECT_EQ(texts_of(scene, {2, 27, 3.9}), "200 wall at the left; 300 wall at the top; ");
  EXPECT_EQ(texts_of(scene, {12, 14.5, 3}), "200 column; 1450 wall at the bottom; ");
  // The slanted wall, 3 m to the left, gives way to the square wall on the other side.
  EXPECT_EQ(texts_of(scene, {8, 3, 3}), "1200 wall at the right; 300 wall at the bottom; ");
  // A wall that is far away precedes a fixture below.
  EXPECT_EQ(texts_of(scene, {10.5, 19, 3.9}), "950 wall at the right; 1100 wall at the top; ");
}

TEST(Reference, IsAFixtureBelowOrTheAxisWithoutARoom) {
  Scene scene = make_scene(hall());
  scene.room.reset();
  EXPECT_THAT(texts_of(scene, {10.5, 19, 3.9}), testing::EndsWith("; 100 table; "));
  EXPECT_THAT(texts_of(scene, {10.5, 21, 3.9}), testing::EndsWith("; 100 bottom side of table; "));
  scene.fixtures.clear();
  scene.parts.clear();
  for (const auto& [axis, side, distance] :
       {std::tuple(0U, Side::left, 2.0), std::tuple(1U, Side::bottom, 27.0)}) {
    const Reference found = references_of(scene, {2, 27, 3.9})[axis];
    EXPECT_EQ(found.kind, Reference::Kind::origin);
    EXPECT_EQ(found.side, side);
    EXPECT_NEAR(found.distance, distance, 1e-9);
  }
}

// The distance along a wall that the laser grazes says nothing.
TEST(Reference, IsNoSurfaceAlongTheLaser) {
  Store store = empty_store("Wedge", {20, 30, 4});
  store.room->shape.is_box = false;
  store.room->shape.outline = {{0, 0}, {20, 0}, {20, 30}, {8, 30}};  // a wall at the left with 15 degrees
  store.room->walls.assign(4, MaterialId{0});
  add_devices(store, {15, 5, 1}, {15, 8, 3.9});
  // 1 m below the slanted wall and 24 m above that at the bottom.
  EXPECT_EQ(texts_of(make_scene(store), {7, 24, 3}), "1300 wall at the right; 2400 wall at the bottom; ");
}

TEST(Reference, AreSurfacesThatALaserMeets) {
  const Scene scene = make_scene(corner_shop());
  // Through the door of W1 at 1.5 m, to its lintel at 3 m.
  EXPECT_EQ(texts_of(scene, {5, 1, 1.5}), "500 wall at the left; 100 wall at the bottom; ");
  EXPECT_EQ(texts_of(scene, {5, 1, 3}), "90 W1; 100 wall at the bottom; ");
  // Over the low wall W2, and against it.
  EXPECT_EQ(texts_of(scene, {7, 4.5, 3}), "500 wall at the right; 450 wall at the bottom; ");
  EXPECT_EQ(texts_of(scene, {7, 4.5, 0.9}).substr(0, 28), "500 wall at the right; 140 W");
  // The shaft hides the wall beyond it.
  EXPECT_EQ(texts_of(scene, {9.6, 6.5, 3}), "60 wall at the left; 350 wall at the top; ");
  // Below the ceiling of the shop and above that of the bakery; then below both.
  EXPECT_EQ(texts_of(scene, {4.5, 9.5, 3.1}), "50 edge of the ceiling at 2.60 m; 50 wall at the top; ");
  EXPECT_EQ(texts_of(scene, {4.5, 9.5, 2.5}), "450 wall at the left; 50 wall at the top; ");
}

// To the slanted wall at x = y + 8, the distance depends on the direction of the laser.
TEST(Reference, PreferSquareSurfacesToSlantedOnes) {
  Store store = corner_shop();
  store.room->shape.inner_walls.clear();
  store.room->inner_walls.clear();
  const Scene scene = make_scene(store);
  EXPECT_EQ(texts_of(scene, {7, 2, 3}), "700 wall at the left; 200 wall at the bottom; ");
  EXPECT_EQ(texts_of(scene, {9, 2, 3}), "900 wall at the left; 800 wall at the top; ");
}

TEST(Reference, TellTheDistanceFromCeilingsOfSeveralHeights) {
  const Scene scene = make_scene(corner_shop());
  MountedUnit unit;
  unit.position = {2, 8, 2.55};
  EXPECT_EQ(cm_below_ceiling(scene, unit), 5);
  unit.position = {6, 8, 2.55};
  EXPECT_EQ(cm_below_ceiling(scene, unit), 65);
  EXPECT_EQ(cm_below_ceiling(make_scene(hall()), unit), std::nullopt);
}

TEST(Reference, TheDrawingForCadHasTheWallsInSection) {
  const std::string dxf = mounting_dxf(PlannedShop(corner_shop()).input);
  // The door of W1 from y = 0.5 to 1.4: its jambs are lines across the wall, and no line passes it.
  EXPECT_THAT(dxf, testing::HasSubstr("10\n5.900000\n20\n0.500000\n"));
  EXPECT_EQ(dxf.find("10\n5.900000\n20\n0.000000\n30\n0.000000\n11\n5.900000\n21\n3"), std::string::npos);
}

// The lines of the drawing from one point of the plan to another.
std::size_t lines_between(const std::string& dxf, const Vec2& from, const Vec2& to) {
  return count_of(fmt::format("10\n{:.6f}\n20\n{:.6f}\n30\n0.000000\n11\n{:.6f}\n21\n{:.6f}\n", from[0],
                              from[1], to[0], to[1]),
                  dxf);
}

TEST(Reference, TheDrawingForCadHasTheOpeningsOfThePlan) {
  PlannedShop shop(corner_shop());
  const auto [first, last, inward] = shop.scene.room->wall(0);
  const auto at = [&](double along) { return shop.scene.room->along_wall(0, along, along).front(); };
  const std::string closed = mounting_dxf(shop.input);
  EXPECT_EQ(lines_between(closed, first, last), 1U);
  // A door, a window behind it, and a high window, which the section does not meet.
  shop.scene.room->openings = {{0, {4, 1, 0.8, 2.4, true}, 1, 0.4},
                               {0, {1, 0.9, 0, 2.1, false}, 1, 0.4},
                               {0, {6, 1, 2, 2.4, true}, 1, 0.4}};
  const std::string dxf = mounting_dxf(shop.input);
  EXPECT_EQ(lines_between(dxf, first, last), 0U);
  EXPECT_EQ(lines_between(dxf, first, at(1)), 1U);
  EXPECT_EQ(lines_between(dxf, at(1.9), at(4)), 1U);
  EXPECT_EQ(lines_between(dxf, at(5), last), 1U);
  EXPECT_EQ(count_of("\nLINE\n", dxf), count_of("\nLINE\n", closed) + 2);
}

std::string text_at(const Scene& scene, const Vec3& position) {
  return place_text(english(), ShopPlaces(scene).of(position));
}

// Two rows of shelves with an aisle of 2 m, below a lowered ceiling.
Store two_rows() {
  Store store = empty_store("Rows", {20, 12, 4});
  add(store, Box{"G3", {3, 4, 0}, {9, 5, 1.8}, {}});
  add(store, Box{"G4", {3, 7, 0}, {9, 8, 1.8}, {}});
  add(store, Box{"C2", {16, 4, 0}, {17, 5, 1}, {}});
  add(store, Box{"canopy", {2, 3, 3.2}, {10, 9, 3.3}, {}});
  add_devices(store, {3.1, 3.9, 1}, {15, 8, 3.9});
  return store;
}

TEST(ShopPlace, IsAmongTheFixturesOnTheFloor) {
  const Scene scene = make_scene(two_rows());
  EXPECT_EQ(text_at(scene, {6, 4.5, 3}), "above G3");
  EXPECT_EQ(text_at(scene, {6, 6.2, 3}), "over the aisle between G3 and G4");
  EXPECT_EQ(text_at(scene, {6, 5.2, 3.9}), "over the aisle between G3 and G4") << "the canopy is not a place";
  EXPECT_EQ(text_at(scene, {6, 6, 1.5}), "between G3 and G4");
  EXPECT_EQ(text_at(scene, {6, 2, 3}), "over the aisle between G3 and the wall");
  EXPECT_EQ(text_at(scene, {6, 5.05, 1.5}), "at G3") << "mounted on its face";
  EXPECT_EQ(text_at(scene, {15, 4.5, 3}), "beside C2") << "the wall is too far for an aisle";
  EXPECT_EQ(text_at(scene, {12.5, 10, 3}), "") << "far from everything";
  EXPECT_EQ(place_text(Words(Language::german), ShopPlaces(scene).of({6, 6.2, 3})),
            "über dem Gang zwischen G3 und G4");
}

TEST(ShopPlace, EndsAtAWall) {
  Store store = two_rows();
  EXPECT_EQ(text_at(make_scene(store), {10.5, 4.5, 3}), "beside G3");
  store.room->shape.inner_walls = {{"W", {9.5, 3}, {9.5, 9}, 0.1, {}, {}}};
  store.room->inner_walls = {{MaterialId{0}, {}}};
  EXPECT_EQ(text_at(make_scene(store), {10.5, 4.5, 3}), "") << "the wall hides G3";
  EXPECT_EQ(text_at(make_scene(store), {9.2, 4.5, 3}), "beside G3") << "on its own side of the wall";
}

TEST(ShopPlace, IsFoundAsFastWithManyFixturesElsewhere) {
  Store store = empty_store("Bins", {200, 100, 4});
  for (int k = 0; k < 20'000; ++k) {
    const double x = k % 200 + 0.2, y = std::floor(k / 200.0) + 0.2;
    add(store, Box{fmt::format("B{}", k), {x, y, 0}, {x + 0.4, y + 0.4, 1}, {}});
  }
  add_devices(store, {1.8, 1.8, 1}, {15, 8, 3.9});
  const Scene scene = make_scene(store);
  const ShopPlaces places(scene);
  const ProcessorTime time;
  for (int k = 0; k < 500; ++k) EXPECT_NE(places.of({k % 99 + 0.9, k % 59 + 0.9, 3}).fixture, "");
  EXPECT_LT(time.seconds(), 0.2);
}

TEST(ShopPlace, IsAZoneWithoutAFixture) {
  Store store = corner_shop();
  std::erase_if(store.fixtures, [](const auto& listed) { return id_of(listed.value) != "column"; });
  EXPECT_EQ(text_at(make_scene(store), {2, 8, 2.5}), "under the ceiling at 2.60 m");
  EXPECT_EQ(text_at(make_scene(store), {5, 8, 3}), "");
}

}  // namespace
}  // namespace shelfbeam::test
