#include "shelfbeam/scene/wall_section.hpp"

#include "shelfbeam/math/polygon.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

double area(const std::vector<Polygon>& loops) {
  double sum = 0;
  for (const Polygon& loop : loops) sum += signed_area(loop);
  return sum;
}

// A room of 10 x 8 m without its corner above the line from (6, 8) to (10, 4).
RoomShape room() {
  RoomShape room;
  room.outline = {{0, 0}, {10, 0}, {10, 4}, {6, 8}, {0, 8}};
  room.height.level = 3;
  return room;
}

TEST(WallSection, IsOpenAtDoorsAndLowAtSills) {
  RoomShape shop = room();
  shop.inner_walls = {{"W", {2, 1}, {2, 7}, 0.2, {}, {{1, 0.9, 0, 2.1}, {3, 1.5, 0.9, 2, true}}}};
  const auto at = [&](double height) { return wall_sections(shop, height).front(); };
  EXPECT_EQ(at(1.2).cut.size(), 3U) << "beside the door and the window";
  EXPECT_NEAR(area(at(1.2).cut), 0.2 * (6 - 0.9 - 1.5), 1e-9);
  EXPECT_NEAR(area(at(1.2).below), 0.2 * 1.5, 1e-9);
  EXPECT_NEAR(area(at(0.5).cut), 0.2 * (6 - 0.9), 1e-9) << "through the sill";
  EXPECT_NEAR(area(at(2.5).cut), 0.2 * 6, 1e-9) << "above the door";
  EXPECT_EQ(at(2.5).cut.front().size(), 4U) << "corners on a straight side are omitted";
  shop.inner_walls[0].height = 1;
  EXPECT_NEAR(area(at(1.2).below), 0.2 * 6, 1e-9);
  EXPECT_TRUE(at(1.2).cut.empty());
}

// Walls of different thickness form a corner without a wedge; the corner is drawn once.
TEST(WallSection, JoinsWallsAndEndsAtTheOutline) {
  RoomShape shop = room();
  shop.inner_walls = {{"A", {4, 0}, {4, 3}, 0.2, {}, {}}, {"B", {4, 3}, {1, 3}, 0.4, {}, {}}};
  const auto corner = wall_sections(shop, 1.2);
  EXPECT_NEAR(area(corner[0].cut) + area(corner[1].cut), 0.2 * 2.8 + 0.4 * 3.1, 1e-9);
  // The slanted wall of the room cuts the end obliquely, also where the middle line ends on it.
  shop.inner_walls = {{"C", {7, 1}, {7, 7}, 0.2, {}, {}}};
  const auto slanted = wall_sections(shop, 1.2).front().cut;
  EXPECT_NEAR(area(slanted), 0.2 * 6, 1e-9);
  for (const Vec2& p : slanted.front()) EXPECT_LT(p[0] + p[1], 14 + 1e-9);
}

}  // namespace
}  // namespace shelfbeam::test
