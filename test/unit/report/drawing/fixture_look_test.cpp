#include "shelfbeam/report/drawing/fixture_look.hpp"

#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/report/data/report.hpp"

#include "unit/report/markup.hpp"
#include "unit/report/sample_store.hpp"

namespace shelfbeam {
namespace {

// A shelf below a lowered ceiling, on a platform, and a wall of two upright faces.
Scene shop() {
  Store store = sample_store::empty_store("Shop", {12, 10, 4});
  const auto add = [&](Fixture fixture) { store.fixtures.push_back({std::move(fixture), "fixtures"}); };
  add(Box{"lowered ceiling", {1, 1, 2.6}, {8, 6, 2.7}, {}});
  add(Box{"canopy", {1.5, 1.5, 0}, {7, 5, 2.5}, {}});
  add(Box{"shelf", {2, 2, 0}, {6, 3, 1.8}, {}});
  MeshFixture wall{"wall", {}, 0, 1, {{"m", {}, {}, {}}}};
  wall.pieces[0].vertices = {{9, 1, 0},   {9, 7, 0},   {9, 7, 3},   {9, 1, 3},
                             {9.2, 1, 0}, {9.2, 7, 0}, {9.2, 7, 3}, {9.2, 1, 3}};
  wall.pieces[0].triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  add(wall);
  sample_store::add_devices(store, {3, 1.9, 1}, {11, 9, 3.9});
  return make_scene(store);
}

TEST(FixtureLook, HidesNothing) {
  const Scene scene = shop();
  EXPECT_EQ(looks_of(scene), (std::vector{Look::overhead, Look::covering, Look::solid, Look::solid}));
  const auto order = fixtures_by_height(scene);
  for (std::size_t k = 1; k < order.size(); ++k)
    EXPECT_LE(scene.fixtures[order[k - 1]].height, scene.fixtures[order[k]].height);
}

TEST(FixtureLook, DrawsAMeshWallAsItsSection) {
  const Scene scene = shop();
  const PlanView view(scene);
  const std::string section = mesh_section(view, scene, 3);
  EXPECT_EQ(test::count_of("M", section), 4U) << "two triangles per face";
  const Point from = view.at(9, 1), to = view.at(9, 7);
  EXPECT_NE(section.find(coordinate(from.x) + " " + coordinate(from.y)), std::string::npos);
  EXPECT_NE(section.find(coordinate(to.x) + " " + coordinate(to.y)), std::string::npos);
  EXPECT_EQ(mesh_section(view, scene, 2), "");
}

TEST(FixtureLook, FloorPlanShowsShelvesBelowALoweredCeiling) {
  const std::string svg = floor_plan_svg(shop());
  EXPECT_EQ(test::read_markup(svg).problem, "");
  EXPECT_EQ(test::count_of("class=\"outline over\"", svg), 1U);
  EXPECT_EQ(test::count_of("class=\"solid\"", svg), 3U) << "the shelf in plan and in two side views";
}

}  // namespace
}  // namespace shelfbeam
