#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/plan_parts.hpp"

#include "support/expect_input_error.hpp"
#include "support/processor_time.hpp"
#include "unit/scene/store/list_store.hpp"

namespace shelfbeam {
namespace {

using test::Json;

Json strips(int count, double width) {
  Json store = test::store_with("[]");
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
  const test::ProcessorTime time;
  const Scene scene = make_scene(test::read(strips(1000, 0.08)));
  EXPECT_EQ(scene.room->zones.size(), 1000U);
  EXPECT_LT(time.seconds(), 8);  // 1 s; 9 s when all lines were drawn in full
  Json backwards = strips(1000, 0.08);
  Json& zones = backwards["room"]["zones"];
  for (std::size_t k = 0; k < 500; ++k) std::swap(zones[k], zones[999 - k]);
  EXPECT_EQ(make_scene(test::read(backwards)).mesh.triangles.size(), scene.mesh.triangles.size());
  EXPECT_LT(time.seconds(), 16);
}

TEST(PlanEffort, AllowsAnOpeningInEveryWall) {
  constexpr int walls = 1000;
  Json room{{"height", 3}, {"floor", "tile"}, {"ceiling", "white"}, {"walls", "white"}};
  for (int k = 0; k < walls; ++k) {
    const double phi = 2 * pi * k / walls;
    room["outline"].push_back({100 * std::cos(phi), 100 * std::sin(phi)});
    room["openings"].push_back({{"wall", k}, {"at", 0.1}, {"width", 0.4}, {"top", 2}});
  }
  const test::ProcessorTime time;
  const Scene scene = make_scene(test::read_text(test::store_of_room(room.dump()).dump()));
  EXPECT_GT(scene.mesh.triangles.size(), static_cast<std::size_t>(6 * walls));
  EXPECT_LT(time.seconds(), 2);  // 0.3 s; 8 s when every point on a wall examined the whole outline
}

TEST(PlanEffort, RefusesOpeningsNearTooManyZones) {
  Json store = strips(1000, 0.08);
  for (int w = 0; w < 10; ++w) {
    Json wall{{"id", "W" + std::to_string(w)}, {"from", {0, 1 + w}}, {"to", {100, 1 + w}}};
    for (int k = 0; k < 5; ++k)
      wall["openings"].push_back({{"at", 1}, {"width", 98}, {"bottom", 0.02 * k}, {"top", 0.02 * k + 0.01}});
    store["room"]["inner_walls"].push_back(wall);
  }
  const test::ProcessorTime time;
  test::expect_input_error([&] { test::read(store); },
                           std::string_view("room.inner_walls[1].openings[0]: is one of too many"));
  EXPECT_LT(time.seconds(), 10);
}

TEST(PlanEffort, RefusesWallsThroughTooManyZones) {
  Json store = strips(300, 0.3);
  for (int w = 0; w < 40; ++w)
    store["room"]["inner_walls"].push_back(
        {{"id", "W" + std::to_string(w)}, {"from", {0, 1 + w}}, {"to", {100, 1 + w}}});
  test::expect_input_error([&] { test::read(store); },
                           std::string_view("room: has edges that meet in more than 20,000 points"));
}

// The quick decision agrees with that by dividing the plan, for boxes of any size, place and angle.
TEST(PlanEffort, BlocksAreWithinTheRoomAsTheirParts) {
  Json store = test::store_with("[]");
  store["room"] = Json::parse(R"({"outline": [[0, 0], [12, 0], [12, 5], [20, 6], [20, 14], [0, 14]],
    "holes": [[[8, 8], [9, 8], [9, 9], [8, 9]]], "height": 3, "floor": "tile", "ceiling": "white", "walls": "white",
    "zones": [{"id": "low", "polygon": [[12, 5], [20, 6], [20, 10], [12, 10]], "height": 1.7},
              {"id": "slope", "polygon": [[1, 9], [6, 9], [6, 12], [1, 12]],
               "height": [[1, 9, 1.5], [6, 9, 2.5], [1, 12, 1.5]]}]})");
  const RoomShape room = test::read(store).room->shape;
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
}  // namespace shelfbeam
