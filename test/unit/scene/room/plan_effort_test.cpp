#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/plan_parts.hpp"

#include "support/l_shaped_room.hpp"
#include "support/processor_time.hpp"
#include "support/testing.hpp"
#include "unit/scene/store/list_store.hpp"

namespace shelfbeam::test {
namespace {

Json strips(int count, double width) {
  Json store = store_with(Json::array());
  store["room"]["size"] = {100, 60, 3};
  for (int k = 0; k < count; ++k) {
    const double x = 100.0 * k / count;
    store["room"]["zones"].push_back({{"id", "z" + std::to_string(k)},
                                      {"polygon", {{x, 0}, {x + width, 0}, {x + width, 50}, {x, 50}}},
                                      {"height", 2.9}});
  }
  return store;
}

// The lines between zones side by side would cover one another.
TEST(PlanEffort, GrowsInProportionToTheZones) {
  const ProcessorTime time;
  const Scene scene = scene_of(strips(600, 0.13));
  EXPECT_EQ(scene.room->zones.size(), 600U);
  EXPECT_LT(time.seconds(), 3);  // 0.4 s; 3.3 s when all lines were drawn in full
  Json backwards = strips(600, 0.13);
  std::reverse(backwards["room"]["zones"].begin(), backwards["room"]["zones"].end());
  EXPECT_EQ(scene_of(backwards).mesh.triangles.size(), scene.mesh.triangles.size());
  EXPECT_LT(time.seconds(), 6);
}

TEST(PlanEffort, AllowsAnOpeningInEveryWall) {
  constexpr int walls = 1000;
  Json room{{"height", 3}, {"floor", "tile"}, {"ceiling", "white"}, {"walls", "white"}};
  for (int k = 0; k < walls; ++k) {
    const double phi = 2 * pi * k / walls;
    room["outline"].push_back({100 * std::cos(phi), 100 * std::sin(phi)});
    room["openings"].push_back({{"wall", k}, {"at", 0.1}, {"width", 0.4}, {"top", 2}});
  }
  const ProcessorTime time;
  const Scene scene = scene_of(store_of_room(room.dump()));
  EXPECT_GT(scene.mesh.triangles.size(), static_cast<std::size_t>(6 * walls));
  EXPECT_LT(time.seconds(), 2);  // 0.3 s; 8 s when every point on a wall examined the whole outline
}

TEST(PlanEffort, RefusesOpeningsNearTooManyZones) {
  Json store = strips(400, 0.2);
  for (int w = 0; w < 10; ++w) {
    Json wall{{"id", "W" + std::to_string(w)}, {"from", {0, 1 + w}}, {"to", {100, 1 + w}}};
    for (int k = 0; k < 5; ++k)
      wall["openings"].push_back({{"at", 1}, {"width", 98}, {"bottom", 0.02 * k}, {"top", 0.02 * k + 0.01}});
    store["room"]["inner_walls"].push_back(wall);
  }
  const ProcessorTime time;
  expect_input_error([&] { read(store); }, "room.inner_walls[2].openings[4]: is one of too many");
  EXPECT_LT(time.seconds(), 4);
}

TEST(PlanEffort, RefusesWallsThroughTooManyZones) {
  Json store = strips(300, 0.3);
  for (int w = 0; w < 40; ++w)
    store["room"]["inner_walls"].push_back(
        {{"id", "W" + std::to_string(w)}, {"from", {0, 1 + w}}, {"to", {100, 1 + w}}});
  expect_input_error([&] { read(store); }, "room: has edges that meet in more than 20,000 points");
}

// The quick decision agrees with that by dividing the plan, for boxes of any size, place and angle.
TEST(PlanEffort, BlocksAreWithinTheRoomAsTheirParts) {
  Json store = store_of_room(l_shaped_room("tile", ""));
  store["room"].erase("inner_walls");
  store["room"].update(R"({"height": 3,
    "zones": [{"id": "low", "polygon": [[12, 5], [20, 6], [20, 10], [12, 10]], "height": 1.7},
              {"id": "slope", "polygon": [[1, 9], [6, 9], [6, 12], [1, 12]],
               "height": [[1, 9, 1.5], [6, 9, 2.5], [1, 12, 1.5]]}]})"_json);
  const RoomShape room = read(store).room->shape;
  int within = 0, outside = 0;
  for (std::uint32_t k = 0; k < 3000; ++k) {
    const auto random = philox({k, 0, 0, 0}, 1), more = philox({k, 1, 0, 0}, 1);
    const double x = 20 * to_uniform(random[0]), y = 14 * to_uniform(random[1]),
                 turn = k % 3 == 0 ? 0 : 2 * pi * to_uniform(random[2]),
                 length = 4 * to_uniform(random[3]) + 0.01, width = 2 * to_uniform(more[0]) + 0.01,
                 top = 3 * to_uniform(more[1]) + 0.01;
    Polygon plan;
    for (const auto& [u, v] : {Vec2{0, 0}, {length, 0}, {length, width}, {0, width}})
      plan.push_back(
          {x + std::cos(turn) * u - std::sin(turn) * v, y + std::sin(turn) * u + std::cos(turn) * v});
    const auto parts = plan_parts(room, plan);
    const bool expected = !leave_room(parts) && lowest_ceiling(parts) >= top;
    EXPECT_EQ(is_within_room(room, plan, top), expected) << k;
    (expected ? within : outside) += 1;
  }
  EXPECT_GT(within, 500);
  EXPECT_GT(outside, 500);
  // Against a wall, and under a ceiling of its height.
  EXPECT_TRUE(is_within_room(room, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 3));
  EXPECT_FALSE(is_within_room(room, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 3.001));
  EXPECT_TRUE(is_within_room(room, {{13, 6}, {14, 6}, {14, 7}, {13, 7}}, 1.7));
}

}  // namespace
}  // namespace shelfbeam::test
