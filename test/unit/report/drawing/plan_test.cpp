// Tests the drawings of shops: floor plans, rooms, fixtures and their ids.

#include <cctype>

#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/report/drawing/fixture_look.hpp"
#include "shelfbeam/report/drawing/part_drawing.hpp"
#include "shelfbeam/report/drawing/store_layer.hpp"
#include "shelfbeam/report/drawing/text_space.hpp"
#include "shelfbeam/report/drawing/wall_elevation.hpp"

#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

Markup plan_of(const Store& store) {
  Markup plan = read_markup(floor_plan_svg(make_scene(store)));
  EXPECT_EQ(plan.problem, "");
  return plan;
}

TEST(FloorPlan, HasALegend) {
  const Scene scene = make_scene(supermarket());
  const std::string svg = floor_plan_svg(scene);
  const Markup plan = read_markup(svg);
  std::vector<std::string> texts{"25 × 18 × 4 m · 14 fixtures · 926 labels"};
  for (const FixtureOutline& fixture : scene.fixtures) texts.push_back(fixture.id);
  EXPECT_THAT(missing_in(plan.text, texts), testing::IsEmpty());
  for (const char* part : {"panel", "board", "kick", "tub", "solid"})
    EXPECT_FALSE(plan.of_class(part).empty()) << part;
  EXPECT_EQ(svg, floor_plan_svg(scene));
}

TEST(FloorPlan, DrawsAMountingPointOnce) {
  Store store = kiosk();
  const auto crosses = [&] {
    std::size_t count = 0;
    // Each cross has one M, including the one in the key.
    for (const Element& element : plan_of(store).of_class("cand")) count += count_of("M", element["d"]);
    return count - 1;
  };
  EXPECT_EQ(crosses(), 2U);  // two candidates and an installed unit
  EXPECT_EQ(plan_of(store).text.find("mounting point"), std::string::npos);
  add_unit(store, "option", store.transceivers[0].value.position, {1, 0, 0});
  add_unit(store, "where one is installed", store.transceivers[1].value.position, {1, 0, 0});
  EXPECT_EQ(crosses(), 2U);
  EXPECT_THAT(plan_of(store).text, testing::HasSubstr("5 candidate transceivers at 3 mounting points"));
  store.transceivers.back().value.position.x -= 0.01;
  EXPECT_EQ(crosses(), 3U);
}

TEST(FloorPlan, ShowsWhichWayAUnitLeans) {
  Store store = kiosk();
  for (const bool leans : {false, true}) {
    if (leans) store.transceivers[0].value.axis = {0, 0.6, -0.8};
    const std::string svg = floor_plan_svg(make_scene(store));
    for (const char* part : {"l0 -12\" class=\"aim\"", "tilted this way"})  // north is up
      EXPECT_EQ(svg.find(part) != std::string::npos, leans) << part;
  }
}

// Two blocks that form an L: the plan fills the L, not its hull. Each block is seen as its top and its
// bottom, whose triangles have opposite orientations in the mesh.
TEST(FloorPlan, DrawsAMeshAsItIs) {
  Store store = kiosk();
  MeshFixture two = mesh("L", {}, {});
  two.at = {0.5, 0.5, 0};
  for (const auto& [x, y] : {std::array{2.0, 0.5}, {0.5, 2.0}}) {
    const auto first = static_cast<std::uint32_t>(two.pieces[0].vertices.size());
    for (const double z : {0.0, 1.0})
      for (const Vec3& corner : {Vec3{0, 0, z}, Vec3{x, 0, z}, Vec3{x, y, z}, Vec3{0, y, z}})
        two.pieces[0].vertices.push_back(corner);
    for (const auto& [a, b, c] : {std::array{0U, 2U, 1U}, {0U, 3U, 2U}, {4U, 5U, 6U}, {4U, 6U, 7U}})
      two.pieces[0].triangles.push_back({first + a, first + b, first + c});
  }
  add(store, two);
  const Scene scene = make_scene(store);
  const PlanView view(scene);
  const std::string data = mesh_silhouette(view, scene, 1U);
  double area = 0, least = 1;
  std::size_t triangles = 0;
  for (std::size_t at = 0; at < data.size(); at = data.find('Z', at) + 1, ++triangles) {
    std::array<double, 6> p{};
    std::sscanf(data.c_str() + at, "M%lf %lfL%lf %lfL%lf %lf", &p[0], &p[1], &p[2], &p[3], &p[4], &p[5]);
    const double one =
        -((p[2] - p[0]) * (p[5] - p[1]) - (p[3] - p[1]) * (p[4] - p[0])) / 2 / view.scale() / view.scale();
    area += one;
    least = std::min(least, one);
  }
  EXPECT_EQ(triangles, 8U);
  EXPECT_GT(least, 0) << "turned another way, it would be a hole";
  EXPECT_NEAR(area, 2 * 2 * 2 * 0.5, 0.01);  // m^2; a tenth of a drawing unit is below 1 mm here
  const std::string svg = floor_plan_svg(scene);
  EXPECT_EQ(count_of("class=\"mesh\"", svg), 1U);
  EXPECT_EQ(count_of("class=\"outline\"", svg), 1U) << "of the gondola; of the mesh it would be the hull";
  EXPECT_EQ(mesh_silhouette(view, scene, 0U), "");
}

TEST(FloorPlan, ShowsDoors) {
  Store store = kiosk();
  EXPECT_TRUE(plan_of(store).of_class("door").empty());
  auto& gondola = std::get<Gondola>(store.fixtures[0].value);
  gondola.doors = gondola.material;
  // One per face with boards in the plan, and two in the elevation.
  EXPECT_EQ(plan_of(store).of_class("door").size(), 3 * gondola.faces.size());
  EXPECT_FALSE(plan_of(store).of_class("casing").empty());
}

TEST(FloorPlan, EscapesNames) {
  EXPECT_THAT(plan_of(kiosk()).text, testing::HasSubstr("Joe's <Kiosk> & \"Bar\""));
}

TEST(FloorPlan, DrawsFromLowToHighAndOmitsHiddenParts) {
  const Scene scene = make_scene(supermarket());
  const auto seen = parts_seen_from_above(scene);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end(),
                             [&](auto a, auto b) { return scene.parts[a].top < scene.parts[b].top; }));
  std::size_t goods = 0, hidden = 0;
  for (std::uint32_t k = 0; k < scene.parts.size(); ++k) {
    if (std::find(seen.begin(), seen.end(), k) != seen.end()) {
      goods += scene.parts[k].kind == PartKind::goods ? 1 : 0;
      continue;
    }
    ++hidden;
    // Each corner of a hidden part is below a board of its fixture, but for the rounding of rotated corners.
    constexpr double margin = 1e-6;  // m
    const bool covered = std::ranges::any_of(scene.parts, [&](const Part& board) {
      if (board.kind != PartKind::board || board.fixture != scene.parts[k].fixture) return false;
      if (board.bottom < scene.parts[k].top - 1e-6) return false;
      return std::ranges::all_of(scene.parts[k].footprint, [&](const Vec2& p) {
        return contains(board.footprint, p) || distance_to_border(board.footprint, p) < margin;
      });
    });
    EXPECT_TRUE(covered) << k;
  }
  EXPECT_GT(goods, 200U);
  EXPECT_GT(hidden, 500U);
}

TEST(Elevation, ShowsTheFixtureWithMostLabels) {
  const Scene scene = make_scene(supermarket());
  const auto fixture = fixture_with_max_labels(scene);
  ASSERT_TRUE(fixture);
  std::vector<std::size_t> counts;
  for (const FixtureOutline& outline : scene.fixtures)
    counts.push_back(static_cast<std::size_t>(std::ranges::count_if(
        scene.labels, [&](const Label& label) { return label.id.starts_with(outline.id + "-"); })));
  EXPECT_EQ(counts[*fixture], *std::max_element(counts.begin(), counts.end()));
  EXPECT_GT(counts[*fixture], *std::min_element(counts.begin(), counts.end()));

  SvgCanvas canvas;
  EXPECT_GT(draw_elevation(canvas, scene, *fixture, 0, 1000), 100);
  // Wall shelving: all its labels face the viewer.
  EXPECT_EQ(read_markup(canvas.body()).of_class("tag").size(), counts[*fixture]);
}

TEST(Elevation, IsMissingWithoutLabelsOnFixtures) {
  Store store = kiosk();
  std::get<Gondola>(store.fixtures[0].value).labels.reset();
  add_label(store, "L", {0.5, 0.5, 1});
  EXPECT_FALSE(fixture_with_max_labels(make_scene(store)));
  plan_of(store);
}

TEST(RoomDrawing, CutsInnerWallsAtDoorsAndWindows) {
  const Markup plan = read_markup(floor_plan_svg(make_scene(corner_shop())));
  EXPECT_EQ(plan.problem, "");
  const auto cut = plan.of_class("wall"), below = plan.of_class("wall-low");
  ASSERT_EQ(cut.size(), 1U) << "W2 is lower than the cut";
  EXPECT_EQ(count_of("M", cut[0]["d"]), 3U) << "beside the door and the window";
  EXPECT_EQ(below.size(), 2U) << "the sill in W1, and W2";
  EXPECT_EQ(plan.of_class("pane").size(), 1U);
  EXPECT_EQ(plan.of_class("floor hole").size(), 1U);
  // Seen from above, the lintel would close the door: only counter and column are blocks.
  EXPECT_EQ(plan.of_class("solid").size(), 2U);
  EXPECT_THAT(missing_in(plan.text, {"12 × 10 × 3.2 m · 4 fixtures · 2 inner walls · 1 ceiling zone · ",
                                     "bakery, ceiling 2.6\u00a0m"}),
              testing::IsEmpty());
  const CeilingHeight slope{0, std::array{Vec3{0, 0, 2.4}, Vec3{2, 0, 3}, Vec3{0, 2, 2.4}}};
  EXPECT_EQ(zone_name(english(), {"ramp", {{0, 0}, {2, 0}, {2, 2}}, slope}), "ramp, ceiling 2.4 to 3\u00a0m");
}

TEST(RoomDrawing, ShowsOpeningsOfOuterWalls) {
  Store store = corner_shop();
  const auto drawn = [&](const char* css_class) {
    return read_markup(floor_plan_svg(make_scene(store))).of_class(css_class).size();
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
Point corner_of(const Element& polygon, std::size_t nth) {
  std::string data = polygon["d"];
  std::ranges::replace_if(data, [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }, ' ');
  std::istringstream numbers(data);
  Point point;
  for (std::size_t k = 0; k <= nth; ++k) numbers >> point.x >> point.y;
  return point;
}

TEST(RoomDrawing, ViewsWallsWithOpeningsFromInside) {
  Store store = corner_shop();
  const Scene before = make_scene(store);
  SvgCanvas none;
  EXPECT_EQ(draw_wall_elevations(none, before, 0, 1000), 0);
  EXPECT_EQ(none.body(), "");
  // Wall 0 is 8 m long and 3.2 m high. From inside, its first corner is on the right.
  store.room->shape.openings = {{0, {1, 2, 0.8, 2.4, true}, 1, 0.4}};
  store.room->openings = {MaterialId{0}};
  SvgCanvas canvas;
  EXPECT_GT(draw_wall_elevations(canvas, make_scene(store), 0, 1000), 3.2 * 60);
  const Markup views = read_markup(canvas.body());
  const auto wall = views.of_class("solid"), windows = views.of_class("hole");
  ASSERT_EQ(wall.size(), 1U);
  ASSERT_EQ(windows.size(), 1U);
  const Point corner = corner_of(wall[0], 0), sill = corner_of(windows[0], 0), end = corner_of(windows[0], 1);
  EXPECT_NEAR(corner.x - sill.x, 1 * 60, 0.2);
  EXPECT_NEAR(corner.x - end.x, 3 * 60, 0.2);
  EXPECT_NEAR(corner.y - sill.y, 0.8 * 60, 0.2);
  EXPECT_NEAR(corner.y - corner_of(wall[0], 1).y, 3.2 * 60, 0.2);
}

// The name is in the zone and beside the counter in it.
TEST(RoomDrawing, KeepsNamesOfZonesClearOfFixtures) {
  const Scene scene = make_scene(corner_shop());
  const PlanView view(scene);
  SvgCanvas canvas;
  draw_fixture_ids(canvas, view, scene);
  const auto texts = read_markup(canvas.body()).of_class("fid mid");
  ASSERT_EQ(texts.size(), scene.fixtures.size() + 1);
  const Point at{std::stod(texts[0]["x"]), std::stod(texts[0]["y"])};
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
  const Scene scene = make_scene(corner_shop());
  const PlanView view(scene);
  EXPECT_EQ(scene.fixtures[1].footprint.size(), 6U) << "the counter has a notch";
  EXPECT_EQ(scene.fixtures[2].footprint.size(), 32U);
  SvgCanvas canvas;
  draw_fixtures(canvas, view, scene);
  const auto panels = read_markup(canvas.body()).of_class("fx-s");
  ASSERT_FALSE(panels.empty()) << "an upright panel is a line";
  const Point from = view.at(1, 4), to = view.at(2, 5);
  for (const Point& end : {from, to})
    EXPECT_THAT(panels[0]["d"], testing::HasSubstr(coordinate(end.x) + " " + coordinate(end.y)));
}

// Its bounding box covers the fixtures of other rows, but the row itself does not.
TEST(RoomDrawing, ASlantedRowHidesNothing) {
  Store store = corner_shop();
  add(store, gondola("long row", {1, 1}, 6, 0.8, {0.5}, 45, {Face::front}));
  add(store, Box{"bin", {1.2, 3, 0}, {1.6, 3.4, 0.8}, {}});
  EXPECT_THAT(looks_of(make_scene(store)), testing::Not(testing::Contains(Look::covering)));
}

TEST(Elevation, CountsLabelsOfTheFixtureItself) {
  Store store = corner_shop();
  std::get<Gondola>(store.fixtures[0].value).labels.reset();
  const auto shown = [&] {
    const Scene scene = make_scene(store);
    const auto fixture = fixture_with_max_labels(scene);
    return fixture ? scene.fixtures[*fixture].id : std::string();
  };
  add_label(store, "in the notch", {2, 9, 1});
  add_label(store, "on the wall", {6.11, 2.9, 2.5});
  EXPECT_EQ(shown(), "");
  add_label(store, "on the counter", {2, 6.99, 1});
  EXPECT_EQ(shown(), "counter");
}

// The ids of fixtures in a plan.
struct Drawn {
  PlanView view;
  std::vector<Element> elements, texts;
  std::ptrdiff_t lines = 0;
  double x(std::size_t nth) const { return std::stod(texts.at(nth)["x"]); }
};

struct Others {
  Vec3 label{1, 1, 1}, room{25, 18, 4};
  std::vector<Box> boxes = {};
  std::set<std::string> referenced = {};
};

// Square pillars of half a metre, too small for their ids, with these corners.
Drawn draw(const std::vector<Vec2>& corners, const Others& others = {}) {
  Store store = empty_store("Pillars", others.room);
  for (const Box& box : others.boxes) add(store, box);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto& [x, y] = corners[k];
    add(store, Box{fmt::format("pillar-{}", k), {x, y, 0}, {x + 0.5, y + 0.5, 4}, {}});
  }
  add_devices(store, others.label, {2, 2, 3});
  const Scene scene = make_scene(store);
  const PlanView view(scene);
  SvgCanvas canvas;
  draw_fixture_ids(canvas, view, scene, {}, others.referenced);
  const Markup markup = read_markup(canvas.body());
  EXPECT_EQ(markup.problem, "");
  Drawn drawn{view, markup.elements, {}};
  for (const Element& element : markup.elements) {
    if (element.name == "text") drawn.texts.push_back(element);
    if (element.name == "line") ++drawn.lines;
  }
  return drawn;
}

TEST(FixtureIds, StandBesideAPillarAndNotOnLabels) {
  const Drawn alone = draw({{10, 8}}), labelled = draw({{10, 8}}, {.label = {10.5, 8.25, 1}});
  EXPECT_GT(alone.x(0), alone.view.at(10.5, 8).x);
  EXPECT_NE(labelled.x(0), alone.x(0));
  EXPECT_EQ(alone.lines + labelled.lines, 0);
}

TEST(FixtureIds, AvoidNeighbours) {
  const Drawn two = draw({{10, 8}, {11, 8}});
  EXPECT_LT(two.x(0), two.view.at(10, 8).x);
  EXPECT_GT(two.x(1), two.view.at(11.5, 8).x);
}

TEST(FixtureIds, HaveALeaderLineInCrowdedPlans) {
  std::vector<Vec2> crowd{{10, 8}};
  for (const double dx : {-0.7, 0.0, 0.7})
    for (const double dy : {-0.7, 0.0, 0.7})
      if (dx != 0 || dy != 0) crowd.push_back({10 + dx, 8 + dy});
  const Drawn drawn = draw(crowd);
  EXPECT_EQ(drawn.texts.size(), 9U);
  EXPECT_GE(drawn.lines, 1);
}

// Neighbours 3 m apart in a hall of 120 m: ids of the usual size would overlap.
TEST(FixtureIds, ShrinkWithTheScale) {
  std::vector<Vec2> row(9);
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = {40.0 + 3 * static_cast<double>(k), 8};
  const Drawn hall = draw(row, {.room = {120, 18, 4}});
  EXPECT_NEAR(hall.view.mark_share(), 1000.0 / 120 / 16, 1e-9);
  EXPECT_EQ(draw(row, {.room = {62, 18, 4}}).view.mark_share(), 1);
  std::size_t small = 0;
  for (const Element& element : hall.elements)
    if (element.name == "g") small += element["style"].find(",5.7px)") != std::string::npos ? 1 : 0;
  EXPECT_EQ(small, 9U);
}

// The middle of a lowered ceiling belongs to the fixtures below it.
TEST(FixtureIds, OfALoweredCeilingStandInACornerFreeOfLabels) {
  const std::vector<Box> ceiling{{"ceiling", {5, 4, 2.7}, {15, 12, 2.8}, {}}};
  const Drawn free = draw({}, {.boxes = ceiling});
  const double middle = free.view.at(10, 8).x;
  EXPECT_GT(free.x(0), free.view.at(5, 8).x);
  EXPECT_LT(free.x(0), middle);
  EXPECT_GT(draw({}, {.label = {5.5, 11.8, 1}, .boxes = ceiling}).x(0), middle);
}

// They are legible at any scale, and no other id covers them.
TEST(FixtureIds, ThatTheMountingSheetNamesAreDrawnLast) {
  const std::vector<Vec2> three{{4, 4}, {10, 8}, {16, 12}};
  const auto order = [](const Drawn& drawn) {
    std::string classes;
    for (const Element& text : drawn.texts) classes += text["class"] + "; ";
    return classes;
  };
  EXPECT_EQ(order(draw(three)), "fid mid; fid mid; fid mid; ");
  const Drawn named = draw(three, {.referenced = {"pillar-0"}});
  EXPECT_EQ(order(named), "fid mid; fid mid; fid mid ref; ");
  EXPECT_LT(named.x(2), named.x(0));
}

// A shelf below a lowered ceiling, on a platform, and a wall of two upright faces.
Scene shop() {
  Store store = empty_store("Shop", {12, 10, 4});
  add(store, Box{"lowered ceiling", {1, 1, 2.6}, {8, 6, 2.7}, {}});
  add(store, Box{"canopy", {1.5, 1.5, 0}, {7, 5, 2.5}, {}});
  add(store, Box{"shelf", {2, 2, 0}, {6, 3, 1.8}, {}});
  add(store,
      mesh("wall",
           {{9, 1, 0}, {9, 7, 0}, {9, 7, 3}, {9, 1, 3}, {9.2, 1, 0}, {9.2, 7, 0}, {9.2, 7, 3}, {9.2, 1, 3}},
           {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}));
  add_devices(store, {3, 1.9, 1}, {11, 9, 3.9});
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
  EXPECT_EQ(count_of("M", section), 4U) << "two triangles per face";
  const Point from = view.at(9, 1), to = view.at(9, 7);
  EXPECT_NE(section.find(coordinate(from.x) + " " + coordinate(from.y)), std::string::npos);
  EXPECT_NE(section.find(coordinate(to.x) + " " + coordinate(to.y)), std::string::npos);
  EXPECT_EQ(mesh_section(view, scene, 2), "");
}

TEST(FixtureLook, FloorPlanShowsShelvesBelowALoweredCeiling) {
  const std::string svg = floor_plan_svg(shop());
  EXPECT_EQ(read_markup(svg).problem, "");
  EXPECT_EQ(count_of("class=\"outline over\"", svg), 1U);
  EXPECT_EQ(count_of("class=\"solid\"", svg), 3U) << "the shelf in plan and in two side views";
}

}  // namespace
}  // namespace shelfbeam::test
