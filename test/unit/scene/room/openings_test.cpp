#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/scene/scene.hpp"

#include "support/expect_input_error.hpp"
#include "support/l_shaped_room.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

using test::Json;

// A store with openings in the walls of an L-shaped room.
Json l_store(const std::string& openings) {
  Json store = test::store_of_room(test::l_shaped_room("tile", ""));
  store["room"]["openings"] = Json::parse(openings);
  return store;
}

// The same with a box.
Json box_store(const std::string& openings) {
  Json store = l_store(openings);
  store["room"]["size"] = {8, 6, 3};
  for (const char* key : {"outline", "holes", "height", "zones", "inner_walls"}) store["room"].erase(key);
  return store;
}

Scene scene_with(const Json& store) {
  return make_scene(test::read_text(store.dump()));
}

// By material.
std::map<std::string, double> areas_of(const Scene& scene) {
  std::map<std::string, double> areas;
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = scene.mesh.triangles[t];
    const auto& v = scene.mesh.vertices;
    areas[scene.materials[scene.mesh.materials[t].value].name] += length(cross(v[b] - v[a], v[c] - v[a])) / 2;
  }
  return areas;
}

// The length of the edges that do not belong to an even number of triangles: 0 for a closed surface.
double open_length(const Scene& scene) {
  std::map<std::array<std::uint32_t, 2>, int> count;
  for (const auto& triangle : scene.mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      ++count[{a, b}];
    }
  double sum = 0;
  for (const auto& [edge, times] : count)
    if (times % 2 != 0) sum += length(scene.mesh.vertices[edge[0]] - scene.mesh.vertices[edge[1]]);
  return sum;
}

const std::string glazed =
    R"([{"wall": 0, "at": 5, "width": 1.2, "bottom": 0.8, "top": 2.4, "material": "door",
  "repeat": {"count": 4, "pier": 0.4}}, {"wall": 2, "at": 2, "width": 1, "top": 2.1, "material": "steel"}])";

TEST(Openings, OfGlassAndSteelKeepTheRoomClosed) {
  const Scene scene = scene_with(l_store(glazed)), plain = scene_with(l_store("[]"));
  EXPECT_EQ(open_length(scene), 0);
  const auto areas = areas_of(scene), before = areas_of(plain);
  EXPECT_NEAR(areas.at("door"), 4 * 1.2 * 1.6, 1e-6);
  EXPECT_NEAR(areas.at("steel"), 2.1, 1e-6);
  EXPECT_NEAR(before.at("white") - areas.at("white"), 4 * 1.2 * 1.6 + 2.1, 1e-6);
  EXPECT_EQ(before.count("door"), 0u) << "negative control";
}

TEST(Openings, WithoutAMaterialAreHolesOfTheirSize) {
  const std::string open = R"([{"wall": 1, "at": 1, "width": 0.9, "top": 2},
    {"wall": 4, "at": 15, "width": 2, "bottom": 1, "top": 2, "repeat": {"count": 2, "pier": 0.5}}])";
  const Scene scene = scene_with(l_store(open)), plain = scene_with(l_store("[]"));
  EXPECT_NEAR(open_length(scene), 2 * (0.9 + 2) + 2 * 2 * (2 + 1), 1e-6);
  EXPECT_NEAR(areas_of(plain).at("white") - areas_of(scene).at("white"), 0.9 * 2 + 2 * 2, 1e-6);
  EXPECT_EQ(open_length(plain), 0) << "negative control";
}

// The wall 4 of 20 m runs to the left, below the zone "low" from x = 6 on, where the ceiling is at 2.6 m.
TEST(Openings, ReachTheCeilingAndTheCorners) {
  const Scene scene =
      scene_with(l_store(R"([{"wall": 4, "at": 0, "width": 20, "top": 2.6, "material": "door"}])"));
  EXPECT_EQ(open_length(scene), 0);
  EXPECT_NEAR(areas_of(scene).at("door"), 20 * 2.6, 1e-6);
}

TEST(Openings, OfABoxAreNamedByItsWalls) {
  const std::array<const char*, 4> names{"y0", "x1", "y1", "x0"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto store = [&](const std::string& wall) {
      return box_store(
          fmt::format(R"([{{"wall": {}, "at": 1, "width": 1, "top": 2, "material": "steel"}}])", wall));
    };
    const Scene named = scene_with(store(fmt::format("\"{}\"", names[k]))),
                numbered = scene_with(store(std::to_string(k)));
    EXPECT_EQ(named.mesh.vertices, numbered.mesh.vertices) << names[k];
    EXPECT_EQ(named.store_hash, numbered.store_hash);
    const std::array<Vec2, 2> ends = named.room->along_wall(k, 1, 2);
    const std::array<std::array<Vec2, 2>, 4> expected{
        {{{{1, 0}, {2, 0}}}, {{{8, 1}, {8, 2}}}, {{{7, 6}, {6, 6}}}, {{{0, 5}, {0, 4}}}}};
    EXPECT_EQ(ends, expected[k]) << names[k];
  }
}

TEST(Openings, AreInTheResolvedStore) {
  const Store store = test::read_text(l_store(glazed).dump());
  const Scene scene = make_scene(store);
  const std::string text = resolved_store_json(store, scene);
  const Json resolved = Json::parse(text);
  Json expected = Json::parse(glazed);
  expected[1]["bottom"] = 0;
  EXPECT_EQ(nlohmann::json(resolved["room"]["openings"]), nlohmann::json(expected));
  const Store again = test::read_text(text);
  EXPECT_EQ(resolved_store_json(again, make_scene(again)), text);
  EXPECT_NE(scene.store_hash, scene_with(l_store("[]")).store_hash);
  // Without openings, the file is as before.
  EXPECT_FALSE(Json::parse(resolved_store_json(test::read_text(l_store("[]").dump()),
                                               scene_with(l_store("[]"))))["room"]
                   .contains("openings"));
}

TEST(Openings, HaveNoCandidatesBeforeThem) {
  const auto candidates = [](const std::string& openings) {
    Json store = l_store(openings);
    store["transceivers"] = Json::parse(R"({"on": [{"type": "down", "wall": 0, "z": 2, "spacing": 1}]})");
    std::string ids;
    for (const Transceiver& unit : scene_with(store).transceivers) ids += unit.id + " ";
    return ids;
  };
  // The windows are from 5 to 6.2 m, 6.6 to 7.8 m, 8.2 to 9.4 m and 9.8 to 11 m.
  EXPECT_EQ(candidates(glazed), "wall-0-1 wall-0-2 wall-0-3 wall-0-4 wall-0-5 wall-0-7 wall-0-10 wall-0-12 ");
  EXPECT_EQ(std::ranges::count(candidates("[]"), ' '), 12) << "negative control";
}

TEST(Openings, AreRefusedWithTheirPlace) {
  struct Fault {
    const char *openings, *message;
  };
  for (const auto& [openings, message] : std::vector<Fault>{
           {R"([{"wall": 6, "at": 1, "width": 1, "top": 2}])",
            "room.openings[0].wall: is not the number of a wall; the room has the walls 0 to 5"},
           {R"([{"wall": "y0", "at": 1, "width": 1, "top": 2}])",
            "room.openings[0].wall: is the name of a wall of a box, but the room has an 'outline'"},
           {R"([{"wall": "z0", "at": 1, "width": 1, "top": 2}])",
            "room.openings[0].wall: has the unknown value 'z0'"},
           {R"([{"wall": 1, "at": 4.5, "width": 1, "top": 2}])",
            "room.openings[0]: extends from 4.5 m to 5.5 m, but wall 1 is 5 m long"},
           {R"([{"wall": 0, "at": 1, "width": 2, "top": 2, "repeat": {"count": 5, "pier": 0.5}}])",
            "room.openings[0]: extends from 1 m to 13 m, but wall 0 is 12 m long; keep the openings within"},
           {R"([{"wall": 0, "at": 1, "width": 2, "bottom": 2, "top": 2}])",
            "room.openings[0].top: is not above 'bottom'"},
           {R"([{"wall": 0, "at": 1, "width": 2, "top": 3.3}])",
            "room.openings[0].top: is above the ceiling of 3.2 m"},
           {R"([{"wall": 4, "at": 13, "width": 2, "top": 2.7}])",
            "room.openings[0].top: is above the ceiling of 2.6 m"},
           {R"([{"wall": 0, "at": 1, "width": 2, "top": 2}, {"wall": 0, "at": 2.9, "width": 2, "top": 2}])",
            "room.openings[1]: overlaps openings[0]; move one of the two"},
           {R"([{"wall": 0, "at": 1, "width": 1, "top": 2, "material": "jar"}])",
            "room.openings[0].material: 'jar' is a solid 'dielectric'"},
           {R"([{"wall": 0, "at": 1, "width": 1, "top": 2, "repeat": {"count": 2}}])",
            "room.openings[0].repeat: is missing the key 'pier'"},
           {R"([{"wall": 0, "at": 0, "width": 0.003, "top": 2, "repeat": {"count": 999, "pier": 0.001}},
                {"wall": 0, "at": 5, "width": 1, "top": 2, "repeat": {"count": 2, "pier": 1}}])",
            "room.openings[1]: is one of more than 1,000 openings"}})
    test::expect_input_error([&, &json = openings] { scene_with(l_store(json)); }, std::string_view(message));
  // Negative controls: openings above one another, end to end, and along the lower ceiling.
  for (const char* openings : {R"([{"wall": 0, "at": 1, "width": 2, "top": 1},
                                   {"wall": 0, "at": 1, "width": 2, "bottom": 1, "top": 2}])",
                               R"([{"wall": 0, "at": 1, "width": 2, "top": 2},
                                   {"wall": 0, "at": 3, "width": 2, "top": 2}])",
                               R"([{"wall": 4, "at": 13, "width": 2, "top": 2.6}])"})
    EXPECT_GT(open_length(scene_with(l_store(openings))), 1) << openings;
}

}  // namespace
}  // namespace shelfbeam
