#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/report/mounting/mounting_sheet.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "unit/report/corner_shop.hpp"

namespace shelfbeam {
namespace {

std::string texts_of(const Scene& scene, const Vec3& unit) {
  std::string text;
  for (const Reference& reference : references_of(scene, unit))
    text += std::to_string(centimetres(reference.distance)) + " " + name_of(english(), reference) + "; ";
  return text;
}

TEST(RoomReference, AreSurfacesThatALaserMeets) {
  const Scene scene = make_scene(test::corner_shop_store());
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
TEST(RoomReference, PreferSquareSurfacesToSlantedOnes) {
  Store store = test::corner_shop_store();
  store.room->shape.inner_walls.clear();
  store.room->inner_walls.clear();
  const Scene scene = make_scene(store);
  EXPECT_EQ(texts_of(scene, {7, 2, 3}), "700 wall at the left; 200 wall at the bottom; ");
  EXPECT_EQ(texts_of(scene, {9, 2, 3}), "900 wall at the left; 800 wall at the top; ");
}

TEST(RoomReference, TellTheDistanceFromCeilingsOfSeveralHeights) {
  const Scene scene = make_scene(test::corner_shop_store());
  MountedUnit unit;
  unit.position = {2, 8, 2.55};
  EXPECT_EQ(cm_below_ceiling(scene, unit), 5);
  unit.position = {6, 8, 2.55};
  EXPECT_EQ(cm_below_ceiling(scene, unit), 65);
  EXPECT_EQ(cm_below_ceiling(test::Supermarket().scene, unit), std::nullopt);
}

TEST(RoomReference, TheDrawingForCadHasTheWallsInSection) {
  const test::CornerShop shop;
  const std::string dxf = mounting_dxf(shop.input);
  // The door of W1 from y = 0.5 to 1.4: its jambs are lines across the wall, and no line passes it.
  EXPECT_NE(dxf.find("10\n5.900000\n20\n0.500000\n"), std::string::npos);
  EXPECT_EQ(dxf.find("10\n5.900000\n20\n0.000000\n30\n0.000000\n11\n5.900000\n21\n3"), std::string::npos);
}

// The lines of the drawing from one point of the plan to another.
std::size_t lines_between(const std::string& dxf, const Vec2& from, const Vec2& to) {
  return test::count_of(fmt::format("10\n{:.6f}\n20\n{:.6f}\n30\n0.000000\n11\n{:.6f}\n21\n{:.6f}\n", from[0],
                                    from[1], to[0], to[1]),
                        dxf);
}

TEST(RoomReference, TheDrawingForCadHasTheOpeningsOfThePlan) {
  test::CornerShop shop;
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
  EXPECT_EQ(test::count_of("\nLINE\n", dxf), test::count_of("\nLINE\n", closed) + 2);
}

}  // namespace
}  // namespace shelfbeam
