#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"

#include "support/expect_input_error.hpp"
#include "support/processor_time.hpp"
#include "unit/scene/store/list_store.hpp"

namespace shelfbeam {
namespace {

using test::fixtures_of;
using test::Json;
using test::read;
using test::run_of_shelves;
using test::store_with;

TEST(FixtureList, RepeatEqualsTheListWrittenOut) {
  const std::string base = run_of_shelves;
  const Store repeated = read(store_with("[{" + base + R"(, "id": "A{n}", "at": [2, 3], "rotation_deg": 15,
    "repeat": {"count": 3, "step": [0.5, 2.5], "first": 4, "count2": 2, "step2": [6, 0]}}])"));
  std::string list;
  int number = 4;
  for (const double x : {2.0, 8.0})
    for (int k = 0; k < 3; ++k)
      list += (list.empty() ? "[{" : ", {") + base + R"(, "rotation_deg": 15, "id": "A)" +
              std::to_string(number++) + R"(", "at": [)" + std::to_string(x + 0.5 * k) + ", " +
              std::to_string(3 + 2.5 * k) + "]}";
  EXPECT_EQ(fixtures_of(repeated), fixtures_of(read(store_with(list + "]"))));
}

TEST(FixtureList, RepeatsAlongTheFixtureAndMirrorsEverySecond) {
  const std::string base = run_of_shelves;
  const Store store = read(store_with("[{" + base + R"(, "id": "A{n}", "at": [5, 5], "rotation_deg": 30,
    "repeat": {"count": 2, "step": 1.33, "mirror": true}}])"));
  const Scene scene = make_scene(store);
  ASSERT_EQ(scene.fixtures.size(), 2u);
  const auto middle = [&](std::size_t f) {
    Vec2 sum{};
    for (const auto& [x, y] : scene.fixtures[f].footprint) sum = {sum[0] + x / 4, sum[1] + y / 4};
    return sum;
  };
  EXPECT_NEAR(middle(1)[0] - middle(0)[0], 1.33 * std::cos(radians(30)), 1e-12);
  EXPECT_NEAR(middle(1)[1] - middle(0)[1], 1.33 * std::sin(radians(30)), 1e-12);
  const auto front = [&](const std::string& id) {
    return std::find_if(scene.labels.begin(), scene.labels.end(),
                        [&](const Label& label) { return label.id == id; })
        ->normal;
  };
  EXPECT_NEAR(length(front("A1-front-1-1") + front("A2-front-1-1")), 0, 1e-12);
}

TEST(FixtureList, ListedLabelsMoveAndTurnWithTheirFixture) {
  const Scene scene = make_scene(read(store_with(R"([{"type": "box", "id": "T{n}", "at": [5, 5, 0.1],
    "size": [1.2, 0.8, 0.7], "rotation_deg": 30, "material": "steel",
    "repeat": {"count": 2, "step": [3, 1], "mirror": true},
    "labels": [{"id": "card", "position": [0.2, -0.01, 0.6], "normal": [0, -1, 0], "type": "small"}]}])")));
  const auto label = [&](const std::string& id) {
    return *std::find_if(scene.labels.begin(), scene.labels.end(),
                         [&](const Label& one) { return one.id == id; });
  };
  const double c = std::cos(radians(30)), s = std::sin(radians(30));
  const Vec3 first{5 + 0.2 * c + 0.01 * s, 5 + 0.2 * s - 0.01 * c, 0.7}, outward{s, -c, 0};
  EXPECT_NEAR(length(label("T1-card").position - first), 0, 1e-12);
  EXPECT_NEAR(length(label("T1-card").normal - outward), 0, 1e-12);
  // Half a turn about the middle of the box, then the step.
  const Vec3 middle{5 + 0.6 * c - 0.4 * s, 5 + 0.6 * s + 0.4 * c, 0.7};
  const Vec3 second = middle * 2 - first + Vec3{3, 1, 0};
  EXPECT_NEAR(length(label("T2-card").position - second), 0, 1e-12);
  EXPECT_NEAR(length(label("T2-card").normal + outward), 0, 1e-12);
}

TEST(FixtureList, StandsAgainstWallsAndFixtures) {
  const std::string base = run_of_shelves;
  Json store = store_with("[{" + base + R"(, "id": "W", "against": {"wall": 2, "from": 1, "gap": 0.1}},
    {)" + base + R"(, "id": "A", "at": [10, 8], "rotation_deg": 30},
    {)" + base + R"(, "id": "E", "against": {"fixture": "A", "side": "right"}},
    {"type": "box", "id": "B", "size": [0.6, 0.4, 1], "material": "steel",
     "against": {"fixture": "A", "side": "front", "shift": 0.2, "gap": 0.05}}])");
  store["room"] =
      Json::parse(R"({"outline": [[0, 0], [30, 0], [30, 20], [0, 18]], "height": 3, "floor": "tile",
                                  "ceiling": "white", "walls": "white"})");
  const Scene scene = make_scene(read(store));
  const auto& wall = scene.fixtures[0].footprint;
  // The corners of its back are 0.1 m from the slanted wall, one of them 1 m along it.
  const Vec2 a{30, 20}, b{0, 18};
  const double length = std::hypot(30, 2), x = (b[0] - a[0]) / length, y = (b[1] - a[1]) / length;
  for (const std::size_t corner : {2, 3}) {
    const double away = (wall[corner][0] - a[0]) * -y + (wall[corner][1] - a[1]) * x;
    EXPECT_NEAR(away, 0.1, 1e-12);
  }
  EXPECT_NEAR((wall[2][0] - a[0]) * x + (wall[2][1] - a[1]) * y, 1, 1e-12);
  const auto label = std::find_if(scene.labels.begin(), scene.labels.end(),
                                  [](const Label& one) { return one.id == "W-front-1-1"; });
  EXPECT_NEAR(label->normal.x * -y + label->normal.y * x, 1, 1e-12) << "its front faces the room";

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
    Json store = store_with(std::string("[{") + run_of_shelves +
                            R"(, "id": "W{n}", "against": {"wall": 2, "from": 1},
                               "repeat": {"count": 3, "step": 1.33}}])");
    store["room"] = {{"outline", Json::parse(outline)},
                     {"height", 3},
                     {"floor", "tile"},
                     {"ceiling", "white"},
                     {"walls", "white"}};
    const Scene scene = make_scene(read(store));
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

TEST(FixtureList, RefusesFaultsWithTheirPlace) {
  struct Fault {
    const char *fixtures, *presets, *message;
  };
  const std::string base = run_of_shelves;
  const std::string copies =
      "[{" + base + R"(, "id": "A", "at": [2, 3], "repeat": {"count": 2, "step": [0, 2]}}])";
  const std::string beside = "[{" + base + R"(, "id": "A", "against": {"fixture": "B", "side": "left"}}])";
  const std::string twice = "[{" + base + R"(, "id": "A", "at": [1, 1], "against": {"wall": 0, "from": 0}}])";
  const std::string many =
      "[{" + base +
      R"(, "id": "A{n}", "at": [2, 3], "repeat": {"count": 200, "step": 1, "count2": 200, "step2": 1}}])";
  for (
      const auto& [fixtures, presets, message] : std::vector<Fault>{
          {R"([{"preset": "a", "id": "A"}])", R"({"a": {"preset": "b"}, "b": {"preset": "a"}})",
           "presets.b.preset: refers to itself: a -> b -> a"},
          {R"([{"preset": "a", "id": "A"}])", R"({"a": {"preset": "a"}})", "refers to itself: a -> a"},
          {R"([{"preset": "c", "id": "A"}])", R"({})", "fixtures[0].preset: names the unknown preset 'c'"},
          {R"([{"preset": "runn", "id": "A"}])", R"({"run": {}})", "did you mean 'run'?"},
          {R"([{"type": "cylinder", "id": "A", "radius": 1, "top": 1, "material": "steel", "against": {"wall": 0, "from": 1}}])",
           "{}", "fixtures[0].against: does not apply to a cylinder"},
          {R"([{"type": "cylinder", "id": "A", "at": [3, 3], "radius": 1, "bottom": 3, "top": "ceiling", "material": "steel"}])",
           "{}", "fixtures[0].bottom: is 3 m, not below the ceiling at 3 m"},
          {R"([{"type": "cylinder", "id": "A{n}", "at": [1, 1], "radius": 1, "top": 1, "material": "steel",
                "repeat": {"count": 3, "step": [9000, 0]}}])",
           "{}", "fixtures[0].repeat: puts a copy 18000 m from the first"},
          {R"([{"preset": "a", "id": "A", "at": [1, 1]}])", R"({"a": {"type": "gondola", "lenght": 3}})",
           "store.json: presets.a: has the unknown key 'lenght'; did you mean 'length'?"},
          {R"([{"type": "cylinder", "id": "A{n}", "at": [1, 1], "radius": 1, "top": 1, "material": "steel",
                "repeat": {"count": 3, "step": 2}}])",
           "{}",
           "fixtures[0].repeat.step: is one number, a step along the length, which a cylinder does not have"},
          {R"([{"type": "cylinder", "id": "A{n}", "at": [1, 1], "radius": 1, "top": 1, "material": "steel"}])",
           "{}", "fixtures[0].id: has the number {n} of a copy, but there is no 'repeat'"},
          {R"([{"type": "box", "id": "A", "min": [1, 1, 0], "max": [2, 2, 1], "material": "steel",
                "against": {"wall": 0, "from": 1}}])",
           "{}", "fixtures[0].against: does not apply to a box with 'min' and 'max'"},
          {R"([{"type": "box", "id": "A", "size": [2, 1, 1], "material": "steel", "against": {}}])", "{}",
           "fixtures[0].against: must have one of 'wall' and 'fixture'"},
          {R"([{"type": "box", "id": "A", "size": [2, 1, 1], "material": "steel",
                "against": {"wall": 1, "from": 18.5}}])",
           "{}",
           "fixtures[0].against.from: puts the end of the fixture 20.5 m from the first corner of the wall, "
           "which is 20 m long"},
          {R"([{"type": "box", "id": "A", "at": [1, 1, 0], "size": [2, 1, 1], "material": "steel",
                "labels": {"type": "small", "count": 2}}])",
           "{}", "fixtures[0].labels: is not a list"},
          {copies.c_str(), "{}", "fixtures[0].id: is 'A' for all copies"},
          {many.c_str(), "{}", "fixtures[0].repeat: produces 40000 fixtures"},
          {beside.c_str(), "{}",
           "fixtures[0].against.fixture: names the fixture 'B', which is not listed before"},
          {twice.c_str(), "{}", "fixtures[0].at: has no effect beside 'against'"},
          {R"([{"type": "prism", "id": "P", "polygon": [[1, 1], [2, 2], [2, 1], [1, 2]], "top": 1, "material": "steel"}])",
           "{}", "fixtures[0].polygon: crosses or touches itself at (1.5, 1.5) m"},
          {R"([{"type": "panel", "id": "P", "corners": [[1, 1, 1], [2, 2, 2], [3, 3, 3]], "material": "steel"}])",
           "{}", "fixtures[0].corners: lie on a line"},
          {R"([{"type": "cylinder", "id": "P", "at": [1, 1], "radius": 0.2, "bottom": 1, "top": 1, "material": "steel"}])",
           "{}", "fixtures[0].top: is not above 'bottom'"}}) {
    Json store = store_with(fixtures);
    store["presets"] = Json::parse(presets);
    test::expect_input_error([&] { make_scene(read(store)); }, std::string_view(message));
  }
}

// Each copy has its own mesh, so that they are counted before they are made.
TEST(FixtureList, CountsTheMemoryOfCopies) {
  Json store = store_with(R"([{"type": "prism", "id": "P{n}", "top": 1, "material": "steel",
    "repeat": {"count": 10000, "step": [0.001, 0]}}])");
  for (int k = 0; k < 1000; ++k) {
    const double angle = 2 * pi * k / 1000;
    store["fixtures"][0]["polygon"].push_back({10 + std::cos(angle), 10 + std::sin(angle)});
  }
  constexpr std::size_t memory = 100'000'000;
  test::expect_input_error(
      [&] { parse_store(store.dump(), "store.json", {}, {false, memory}); },
      std::string_view("store.json: fixtures[0]: the store up to here requires about 0.1"));
}

// A text of a few hundred bytes could produce any number of labels.
TEST(FixtureList, CountsTheLabelsOfCopiesBeforeItMakesThem) {
  Json store = store_with(R"([{"type": "box", "id": "T{n}", "at": [1, 1, 0], "size": [0.5, 0.5, 0.5],
    "material": "steel", "labels": [], "repeat": {"count": 100, "step": [0.01, 0], "count2": 100, "step2": [0, 0.01]}}])");
  for (int k = 0; k < 101; ++k)
    store["fixtures"][0]["labels"].push_back(
        {{"id", std::to_string(k)}, {"position", {0, 0, 0.6}}, {"normal", {0, -1, 0}}, {"type", "small"}});
  const test::ProcessorTime time;
  test::expect_input_error(
      [&] { read(store); },
      std::string_view("fixtures[0].labels: produces 1010000 labels, 101 for each of 10000 "
                       "copies; at most 1000000 are allowed"));
  store["fixtures"][0]["preset"] = "many";
  store["presets"]["many"]["labels"] = std::exchange(store["fixtures"][0]["labels"], nullptr);
  store["fixtures"][0].erase("labels");
  test::expect_input_error([&] { read(store); },
                           std::string_view("fixtures[0].labels (preset 'many'): produces"));
  const Json gondola = Json::parse(std::string("{") + run_of_shelves + "}");
  store["presets"]["many"] = gondola;
  store["presets"]["many"]["labels"]["spacing"] = 0.01;
  store["fixtures"] = Json::parse(
      R"([{"preset": "many", "id": "T{n}", "at": [1, 1], "repeat": {"count": 5000, "step": 0}}])");
  test::expect_input_error(
      [&] { read(store); },
      std::string_view("labels (preset 'many'): produces 1330000 labels, 266 for each of 5000"));
  EXPECT_LT(time.seconds(), 2);
}

TEST(FixtureList, NamesEachCopyInMessages) {
  const std::string copies = std::string(R"([{"id": "A{n}", "at": [1, 1], )") + run_of_shelves +
                             R"(, "repeat": {"count": 3, "step": 9.7}},
    {"type": "box", "id": "T{n}", "at": [1, 4, 0], "size": [1, 1, 1], "material": "steel",
     "labels": [{"id": "L", "position": [0.5, 0, 1.1], "normal": [0, -1, 0], "type": "small"}],
     "repeat": {"count": 2, "step": 3, "first": 7}}])";
  const Store store = read(store_with(copies));
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

// Closed surfaces that face outwards: the volume by the theorem of Gauss.
double volume(const Scene& scene, std::size_t first) {
  double sum = 0;
  const auto& v = scene.mesh.vertices;
  for (std::size_t t = first; t < scene.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = scene.mesh.triangles[t];
    sum += dot(v[a], cross(v[b], v[c])) / 6;
  }
  return sum;
}

TEST(FixtureShapes, HaveTheirVolumes) {
  const auto volume_of = [](const std::string& fixture) {
    return volume(make_scene(read(store_with("[" + fixture + "]"))), 12);
  };
  EXPECT_NEAR(volume_of(R"({"type": "prism", "id": "P", "polygon": [[7, 1], [9, 1], [9, 2], [8, 1.4], [7, 2]],
                            "top": 1.1, "material": "steel"})"),
              1.1 * (2 - 0.6), 1e-12)
      << "concave";
  EXPECT_NEAR(
      volume_of(R"({"type": "prism", "id": "P", "polygon": [[7, 2], [9, 2], [9, 1], [7, 1]], "bottom": 0.5,
                            "top": "ceiling", "material": "steel"})"),
      2 * 2.5, 1e-12)
      << "clockwise, up to the ceiling";
  EXPECT_NEAR(volume_of(R"({"type": "cylinder", "id": "C", "at": [10, 7], "radius": 0.25, "top": "ceiling",
                            "material": "white"})"),
              3 * pi * 0.25 * 0.25, 1e-12);
  EXPECT_NEAR(
      volume_of(R"({"type": "box", "id": "B", "at": [5, 5, 0], "size": [1.2, 0.8, 0.75], "rotation_deg": 30,
                            "material": "steel"})"),
      1.2 * 0.8 * 0.75, 1e-12);
}

TEST(FixtureShapes, AreReadBackToTheBit) {
  const Store store = read(store_with(R"([
    {"type": "prism", "id": "P", "polygon": [[7, 1], [9, 1], [9, 2], [8, 1.4], [7, 2]], "top": 1.1, "material": "steel"},
    {"type": "cylinder", "id": "C{n}", "at": [10, 7], "radius": 0.25, "top": "ceiling", "material": "white",
     "repeat": {"count": 3, "step": [3, 0.1]}},
    {"type": "box", "id": "B{n}", "at": [5, 5, 0], "size": [1.2, 0.8, 0.75], "rotation_deg": 30, "material": "steel",
     "repeat": {"count": 2, "step": [0, 3], "mirror": true}},
    {"type": "panel", "id": "S", "corners": [[1, 1, 2.2], [3, 1, 2.2], [3, 1.3, 2.8]], "material": "steel"}])"));
  const std::string text = resolved_store_json(store, make_scene(store));
  const Store again = test::read_text(text);
  EXPECT_EQ(resolved_store_json(again, make_scene(again)), text);
  EXPECT_EQ(make_scene(again).mesh.vertices, make_scene(store).mesh.vertices);
}

}  // namespace
}  // namespace shelfbeam
