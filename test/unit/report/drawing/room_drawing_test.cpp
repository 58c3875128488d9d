#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/drawing/fixture_look.hpp"
#include "shelfbeam/report/drawing/part_drawing.hpp"
#include "shelfbeam/report/drawing/store_layer.hpp"
#include "shelfbeam/report/drawing/text_space.hpp"
#include "shelfbeam/report/drawing/wall_elevation.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "unit/report/corner_shop.hpp"

namespace shelfbeam {
namespace {

std::vector<test::Element> of_class(const std::string& svg, const std::string& css_class) {
  std::vector<test::Element> found;
  for (const test::Element& element : test::read_markup(svg).elements) {
    const auto css = element.attributes.find("class");
    if (css != element.attributes.end() && css->second == css_class) found.push_back(element);
  }
  return found;
}

TEST(RoomDrawing, CutsInnerWallsAtDoorsAndWindows) {
  const std::string svg = floor_plan_svg(make_scene(test::corner_shop_store()));
  EXPECT_EQ(test::read_markup(svg).problem, "");
  const auto cut = of_class(svg, "wall"), below = of_class(svg, "wall-low");
  ASSERT_EQ(cut.size(), 1U) << "W2 is lower than the cut";
  EXPECT_EQ(test::count_of("M", cut[0].attributes.at("d")), 3U) << "beside the door and the window";
  EXPECT_EQ(below.size(), 2U) << "the sill in W1, and W2";
  EXPECT_EQ(of_class(svg, "pane").size(), 1U);
  EXPECT_EQ(of_class(svg, "floor hole").size(), 1U);
  // Seen from above, the lintel would close the door: only counter and column are blocks.
  EXPECT_EQ(of_class(svg, "solid").size(), 2U);
}

TEST(RoomDrawing, ShowsOpeningsOfOuterWalls) {
  Store store = test::corner_shop_store();
  const auto drawn = [&](const char* css_class) {
    return of_class(floor_plan_svg(make_scene(store)), css_class).size();
  };
  const std::size_t panes = drawn("pane"), ticks = drawn("tick");
  EXPECT_EQ(drawn("hole"), 0U) << "negative control";
  // Two windows with a pier, a high window, and an open door.
  store.room->shape.openings = {{0, {1, 1, 0.8, 2.4, true}, 2, 0.4},
                                {0, {4, 1, 2, 2.4, true}, 1, 0.4},
                                {0, {6, 1, 0, 2.1, false}, 1, 0.4}};
  store.room->openings = {MaterialId{0}, MaterialId{0}, std::nullopt};
  EXPECT_EQ(drawn("hole"), 3U + 4) << "in plan without the high window, which is above the section";
  EXPECT_EQ(drawn("pane"), panes + 3 + 3);
  EXPECT_EQ(drawn("tick"), ticks + 8 + 6) << "their jambs, and the heights in the view of the wall";
}

// A corner of a polygon, which is a path of absolute points.
Point corner_of(const test::Element& polygon, std::size_t nth) {
  std::string data = polygon.attributes.at("d");
  std::ranges::replace_if(data, [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }, ' ');
  std::istringstream numbers(data);
  Point point;
  for (std::size_t k = 0; k <= nth; ++k) numbers >> point.x >> point.y;
  return point;
}

TEST(RoomDrawing, ViewsWallsWithOpeningsFromInside) {
  Store store = test::corner_shop_store();
  const Scene before = make_scene(store);
  SvgCanvas none;
  EXPECT_EQ(draw_wall_elevations(none, before, 0, 1000), 0);
  EXPECT_EQ(none.body(), "");
  // Wall 0 is 8 m long and 3.2 m high. From inside, its first corner is on the right.
  store.room->shape.openings = {{0, {1, 2, 0.8, 2.4, true}, 1, 0.4}};
  store.room->openings = {MaterialId{0}};
  SvgCanvas canvas;
  EXPECT_GT(draw_wall_elevations(canvas, make_scene(store), 0, 1000), 3.2 * 60);
  const auto wall = of_class(canvas.body(), "solid"), windows = of_class(canvas.body(), "hole");
  ASSERT_EQ(wall.size(), 1U);
  ASSERT_EQ(windows.size(), 1U);
  const Point corner = corner_of(wall[0], 0), sill = corner_of(windows[0], 0), end = corner_of(windows[0], 1);
  EXPECT_NEAR(corner.x - sill.x, 1 * 60, 0.2);
  EXPECT_NEAR(corner.x - end.x, 3 * 60, 0.2);
  EXPECT_NEAR(corner.y - sill.y, 0.8 * 60, 0.2);
  EXPECT_NEAR(corner.y - corner_of(wall[0], 1).y, 3.2 * 60, 0.2);
}

TEST(RoomDrawing, CountsAndNamesZonesAndInnerWalls) {
  const std::string text = test::read_markup(floor_plan_svg(make_scene(test::corner_shop_store()))).text;
  EXPECT_NE(text.find("12 × 10 × 3.2 m · 4 fixtures · 2 inner walls · 1 ceiling zone · "), std::string::npos);
  EXPECT_NE(text.find("bakery, ceiling 2.6\u00a0m"), std::string::npos);
  const CeilingHeight slope{0, std::array{Vec3{0, 0, 2.4}, Vec3{2, 0, 3}, Vec3{0, 2, 2.4}}};
  EXPECT_EQ(zone_name(english(), {"ramp", {{0, 0}, {2, 0}, {2, 2}}, slope}), "ramp, ceiling 2.4 to 3\u00a0m");
}

// The name is in the zone and beside the counter in it.
TEST(RoomDrawing, KeepsNamesOfZonesClearOfFixtures) {
  const Scene scene = make_scene(test::corner_shop_store());
  const PlanView view(scene);
  SvgCanvas canvas;
  draw_fixture_ids(canvas, view, scene);
  const auto texts = of_class(canvas.body(), "fid mid");
  ASSERT_EQ(texts.size(), scene.fixtures.size() + 1);
  const Point at{std::stod(texts[0].attributes.at("x")), std::stod(texts[0].attributes.at("y"))};
  const Rectangle name{at.x - 40, at.y - 8, at.x + 40, at.y};
  EXPECT_TRUE(lies_within(name, view.outline(scene.room->zones[0].polygon)));
  EXPECT_FALSE(Obstacle(view.outline(scene.fixtures[1].footprint)).meets(name));
  // Negative control: the notch of the counter belongs to it only as a part of its hull.
  const Point notch = view.at(2, 8.7), body = view.at(2, 7.2);
  const auto around = [](const Point& p) { return Rectangle{p.x - 5, p.y - 5, p.x + 5, p.y + 5}; };
  EXPECT_FALSE(Obstacle(view.outline(scene.fixtures[1].footprint)).meets(around(notch)));
  EXPECT_TRUE(Obstacle(view.outline(scene.fixtures[1].footprint)).meets(around(body)));
}

TEST(RoomDrawing, DrawsTrueOutlines) {
  const Scene scene = make_scene(test::corner_shop_store());
  const PlanView view(scene);
  EXPECT_EQ(scene.fixtures[1].footprint.size(), 6U) << "the counter has a notch";
  EXPECT_EQ(scene.fixtures[2].footprint.size(), 32U);
  SvgCanvas canvas;
  draw_fixtures(canvas, view, scene);
  const auto panels = of_class(canvas.body(), "fx-s");
  ASSERT_FALSE(panels.empty()) << "an upright panel is a line";
  const Point from = view.at(1, 4), to = view.at(2, 5);
  for (const Point& end : {from, to})
    EXPECT_NE(panels[0].attributes.at("d").find(coordinate(end.x) + " " + coordinate(end.y)),
              std::string::npos);
}

// Its bounding box covers the fixtures of other rows, but the row itself does not.
TEST(RoomDrawing, ASlantedRowHidesNothing) {
  Store store = test::corner_shop_store();
  store.fixtures.push_back(
      {sample_store::gondola("long row", {1, 1}, 6, 0.8, {0.5}, 45, {Face::front}), "fixtures"});
  store.fixtures.push_back({Box{"bin", {1.2, 3, 0}, {1.6, 3.4, 0.8}, {}}, "fixtures"});
  const std::vector<Look> looks = looks_of(make_scene(store));
  EXPECT_EQ(std::count(looks.begin(), looks.end(), Look::covering), 0);
}

TEST(Elevation, CountsLabelsOfTheFixtureItself) {
  Store store = test::corner_shop_store();
  std::get<Gondola>(store.fixtures[0].value).labels.reset();
  const auto shown = [&] {
    const Scene scene = make_scene(store);
    const auto fixture = fixture_with_max_labels(scene);
    return fixture ? scene.fixtures[*fixture].id : std::string();
  };
  const auto add = [&](const char* id, const Vec3& position) {
    store.labels.push_back({Label{id, position, {0, -1, 0}, LabelTypeId{0}}, "labels"});
  };
  add("in the notch", {2, 9, 1});
  add("on the wall", {6.11, 2.9, 2.5});
  EXPECT_EQ(shown(), "");
  add("on the counter", {2, 6.99, 1});
  EXPECT_EQ(shown(), "counter");
}

}  // namespace
}  // namespace shelfbeam
