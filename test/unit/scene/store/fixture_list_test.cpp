#include "shelfbeam/math/warp.hpp"

#include "support/processor_time.hpp"
#include "support/testing.hpp"
#include "unit/scene/same_scene.hpp"
#include "unit/scene/solids.hpp"
#include "unit/scene/store/list_store.hpp"

namespace shelfbeam::test {
namespace {

TEST(FixtureList, RepeatEqualsTheListWrittenOut) {
  const Json repeated = store_with(shelves(R"({"id": "A{n}", "at": [2, 3], "rotation_deg": 15,
    "repeat": {"count": 3, "step": [0.5, 2.5], "first": 4, "count2": 2, "step2": [6, 0]}})"_json));
  Json list = Json::array();
  for (int k = 0; k < 6; ++k)
    list.push_back(shelves({{"id", fmt::format("A{}", 4 + k)},
                            {"at", {(k < 3 ? 2 : 8) + 0.5 * (k % 3), 3 + 2.5 * (k % 3)}},
                            {"rotation_deg", 15}}));
  EXPECT_EQ(fixtures_of(read(repeated)), fixtures_of(read(store_with(list))));
}

TEST(FixtureList, RepeatsAlongTheFixtureAndMirrorsEverySecond) {
  const Scene scene = scene_of(store_with(shelves(R"({"id": "A{n}", "at": [5, 5], "rotation_deg": 30,
    "repeat": {"count": 2, "step": 1.33, "mirror": true}})"_json)));
  ASSERT_EQ(scene.fixtures.size(), 2u);
  const auto middle = [&](std::size_t f) {
    Vec2 sum{};
    for (const auto& [x, y] : scene.fixtures[f].footprint) sum = {sum[0] + x / 4, sum[1] + y / 4};
    return sum;
  };
  EXPECT_NEAR(middle(1)[0] - middle(0)[0], 1.33 * std::cos(radians(30)), 1e-12);
  EXPECT_NEAR(middle(1)[1] - middle(0)[1], 1.33 * std::sin(radians(30)), 1e-12);
  const auto front = [&](const char* id) { return by_id(scene.labels, id).normal; };
  EXPECT_NEAR(length(front("A1-front-1-1") + front("A2-front-1-1")), 0, 1e-12);
}

TEST(FixtureList, ListedLabelsMoveAndTurnWithTheirFixture) {
  const Scene scene = scene_of(store_with(R"([{"type": "box", "id": "T{n}", "at": [5, 5, 0.1],
    "size": [1.2, 0.8, 0.7], "rotation_deg": 30, "material": "steel",
    "repeat": {"count": 2, "step": [3, 1], "mirror": true},
    "labels": [{"id": "card", "position": [0.2, -0.01, 0.6], "normal": [0, -1, 0], "type": "small"}]}])"_json));
  const Label &one = by_id(scene.labels, "T1-card"), &other = by_id(scene.labels, "T2-card");
  const double c = std::cos(radians(30)), s = std::sin(radians(30));
  const Vec3 first{5 + 0.2 * c + 0.01 * s, 5 + 0.2 * s - 0.01 * c, 0.7}, outward{s, -c, 0};
  EXPECT_NEAR(length(one.position - first), 0, 1e-12);
  EXPECT_NEAR(length(one.normal - outward), 0, 1e-12);
  // Half a turn about the middle of the box, then the step.
  const Vec3 middle{5 + 0.6 * c - 0.4 * s, 5 + 0.6 * s + 0.4 * c, 0.7};
  EXPECT_NEAR(length(other.position - (middle * 2 - first + Vec3{3, 1, 0})), 0, 1e-12);
  EXPECT_NEAR(length(other.normal + outward), 0, 1e-12);
}

Json in_slanted_room(const Json& fixtures, const Json& outline = {{0, 0}, {30, 0}, {30, 20}, {0, 18}}) {
  Json store = store_with(fixtures);
  store["room"] = {
      {"outline", outline}, {"height", 3}, {"floor", "tile"}, {"ceiling", "white"}, {"walls", "white"}};
  return store;
}

TEST(FixtureList, StandsAgainstWallsAndFixtures) {
  const Scene scene =
      scene_of(in_slanted_room({shelves({{"id", "W"}, {"against", {{"wall", 2}, {"from", 1}, {"gap", 0.1}}}}),
                                shelves({{"id", "A"}, {"at", {10, 8}}, {"rotation_deg", 30}}),
                                shelves({{"id", "E"}, {"against", {{"fixture", "A"}, {"side", "right"}}}}),
                                R"({"type": "box", "id": "B", "size": [0.6, 0.4, 1], "material": "steel",
           "against": {"fixture": "A", "side": "front", "shift": 0.2, "gap": 0.05}})"_json}));
  const auto& wall = scene.fixtures[0].footprint;
  // The corners of its back are 0.1 m from the slanted wall, one of them 1 m along it.
  const Vec2 a{30, 20}, b{0, 18};
  const double length = std::hypot(30, 2), x = (b[0] - a[0]) / length, y = (b[1] - a[1]) / length;
  for (const std::size_t corner : {2, 3}) {
    const double away = (wall[corner][0] - a[0]) * -y + (wall[corner][1] - a[1]) * x;
    EXPECT_NEAR(away, 0.1, 1e-12);
  }
  EXPECT_NEAR((wall[2][0] - a[0]) * x + (wall[2][1] - a[1]) * y, 1, 1e-12);
  const Vec3& front = by_id(scene.labels, "W-front-1-1").normal;
  EXPECT_NEAR(front.x * -y + front.y * x, 1, 1e-12) << "its front faces the room";

  const auto distance = [](const Vec2& p, const Vec2& q) { return std::hypot(p[0] - q[0], p[1] - q[1]); };
  const auto middle = [](const Vec2& p, const Vec2& q) { return Vec2{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2}; };
  const auto &run_a = scene.fixtures[1].footprint, &end = scene.fixtures[2].footprint;
  EXPECT_NEAR(distance(middle(run_a[1], run_a[2]), middle(end[2], end[3])), 0, 1e-12) << "back to the end";
  const auto& box = scene.fixtures[3].footprint;
  EXPECT_NEAR(distance(middle(run_a[0], run_a[1]), middle(box[0], box[2])), std::hypot(0.2, 0.05 + 0.4 / 2),
              1e-12);
  EXPECT_NEAR(distance(run_a[1], middle(box[0], box[2])), std::hypot(1.33 / 2 - 0.2, 0.05 + 0.4 / 2), 1e-12)
      << "shifted to the right of a person who faces the front";
}

// Also where the outline is clockwise: the first unit begins at `from`, and the others follow along the wall.
TEST(FixtureList, RepeatsAlongTheWallThatItStandsAgainst) {
  for (const char* outline :
       {"[[0, 0], [30, 0], [30, 20], [0, 18]]", "[[0, 18], [30, 20], [30, 0], [0, 0]]"}) {
    const Scene scene = scene_of(in_slanted_room(shelves(R"({"id": "W{n}", "against": {"wall": 2, "from": 1},
                                              "repeat": {"count": 3, "step": 1.33}})"_json),
                                                 Json::parse(outline)));
    EXPECT_EQ(sentences(scene.warnings), std::vector<std::string>());
    const Polygon corners = Json::parse(outline);
    const Vec2 &a = corners[2], &b = corners[3];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    for (std::size_t k = 0; k < 3; ++k) {
      double nearest = HUGE_VAL;
      for (const Vec2& p : scene.fixtures[k].footprint)
        nearest = std::min(nearest, ((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])) / length);
      EXPECT_NEAR(nearest, 1 + 1.33 * static_cast<double>(k), 1e-9) << outline;
    }
  }
}

// Each copy has its own mesh, so that they are counted before they are made.
TEST(FixtureList, CountsTheMemoryOfCopies) {
  Json store = store_with(R"([{"type": "prism", "id": "P{n}", "top": 1, "material": "steel",
    "repeat": {"count": 10000, "step": [0.001, 0]}}])"_json);
  for (int k = 0; k < 1000; ++k) {
    const double angle = 2 * pi * k / 1000;
    store["fixtures"][0]["polygon"].push_back({10 + std::cos(angle), 10 + std::sin(angle)});
  }
  constexpr std::size_t memory = 100'000'000;
  expect_input_error([&] { parse_store(store.dump(), "store.json", {}, {false, memory}); },
                     "store.json: fixtures[0]: the store up to here requires about 0.1");
}

// A text of a few hundred bytes could produce any number of labels.
TEST(FixtureList, CountsTheLabelsOfCopiesBeforeItMakesThem) {
  Json store = store_with(R"([{"type": "box", "id": "T{n}", "at": [1, 1, 0], "size": [0.5, 0.5, 0.5],
    "material": "steel", "labels": [], "repeat": {"count": 100, "step": [0.01, 0], "count2": 100, "step2": [0, 0.01]}}])"_json);
  for (int k = 0; k < 101; ++k)
    store["fixtures"][0]["labels"].push_back(
        {{"id", std::to_string(k)}, {"position", {0, 0, 0.6}}, {"normal", {0, -1, 0}}, {"type", "small"}});
  const ProcessorTime time;
  expect_input_error([&] { read(store); },
                     "fixtures[0].labels: produces 1010000 labels, 101 for each of 10000 "
                     "copies; at most 1000000 are allowed");
  store["fixtures"][0]["preset"] = "many";
  store["presets"]["many"]["labels"] = std::exchange(store["fixtures"][0]["labels"], nullptr);
  store["fixtures"][0].erase("labels");
  expect_input_error([&] { read(store); }, "fixtures[0].labels (preset 'many'): produces");
  store["presets"]["many"] = shelves({{"labels", {{"spacing", 0.01}}}});
  store["fixtures"] =
      R"([{"preset": "many", "id": "T{n}", "at": [1, 1], "repeat": {"count": 5000, "step": 0}}])"_json;
  expect_input_error([&] { read(store); },
                     "labels (preset 'many'): produces 1330000 labels, 266 for each of 5000");
  EXPECT_LT(time.seconds(), 2);
}

TEST(FixtureList, NamesEachCopyInMessages) {
  const Store store = read(
      store_with({shelves(R"({"id": "A{n}", "at": [1, 1], "repeat": {"count": 3, "step": 9.7}})"_json),
                  R"({"type": "box", "id": "T{n}", "at": [1, 4, 0], "size": [1, 1, 1], "material": "steel",
           "labels": [{"id": "L", "position": [0.5, 0, 1.1], "normal": [0, -1, 0], "type": "small"}],
           "repeat": {"count": 2, "step": 3, "first": 7}})"_json}));
  std::vector<std::string> places;
  for (const auto& [fixture, where] : store.fixtures) places.push_back(where);
  for (const auto& [label, where] : store.labels) places.push_back(where);
  EXPECT_THAT(places,
              testing::ElementsAre(
                  "store.json: fixtures[0] (copy 'A1')", "store.json: fixtures[0] (copy 'A2')",
                  "store.json: fixtures[0] (copy 'A3')", "store.json: fixtures[1] (copy 'T7')",
                  "store.json: fixtures[1] (copy 'T8')", "store.json: fixtures[1].labels[0] (copy 'T7')",
                  "store.json: fixtures[1].labels[0] (copy 'T8')", "store.json: labels[0]"));
}

// Closed surfaces that face outwards.
TEST(FixtureShapes, HaveTheirVolumesAndAreReadBackToTheBit) {
  const Json shapes = R"([
    {"type": "prism", "id": "concave", "polygon": [[7, 1], [9, 1], [9, 2], [8, 1.4], [7, 2]], "top": 1.1,
     "material": "steel"},
    {"type": "prism", "id": "clockwise", "polygon": [[7, 2], [9, 2], [9, 1], [7, 1]], "bottom": 0.5,
     "top": "ceiling", "material": "steel"},
    {"type": "cylinder", "id": "C{n}", "at": [10, 7], "radius": 0.25, "top": "ceiling", "material": "white",
     "repeat": {"count": 3, "step": [3, 0.1]}},
    {"type": "box", "id": "B{n}", "at": [5, 5, 0], "size": [1.2, 0.8, 0.75], "rotation_deg": 30,
     "material": "steel", "repeat": {"count": 2, "step": [0, 3], "mirror": true}},
    {"type": "panel", "id": "S", "corners": [[1, 1, 2.2], [3, 1, 2.2], [3, 1.3, 2.8]], "material": "steel"}])"_json;
  const double volumes[] = {1.1 * (2 - 0.6), 2 * 2.5, 3 * 3 * pi * 0.25 * 0.25, 2 * 1.2 * 0.8 * 0.75};
  for (std::size_t k = 0; k < std::size(volumes); ++k) {
    TriangleMesh mesh = scene_of(store_with(shapes[k])).mesh;
    mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 12);  // those of the room
    EXPECT_NEAR(volume(mesh), volumes[k], 1e-12) << shapes[k]["id"];
  }
  expect_same_scene(read(store_with(shapes)));
}

}  // namespace
}  // namespace shelfbeam::test
