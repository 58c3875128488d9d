#include "shelfbeam/scene/scene.hpp"

#include "support/l_shaped_room.hpp"
#include "support/testing.hpp"
#include "unit/scene/same_scene.hpp"
#include "unit/scene/sample_store.hpp"
#include "unit/scene/solids.hpp"

namespace shelfbeam::test {
namespace {

// A store with openings in the walls of an L-shaped room.
Json l_store(const std::string& openings) {
  Json store = store_of_room(l_shaped_room("tile", ""));
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

// The length of the open edges.
double open_length(const Scene& scene) {
  double sum = 0;
  for (const auto& [a, b] : open_edges(scene.mesh))
    sum += length(scene.mesh.vertices[a] - scene.mesh.vertices[b]);
  return sum;
}

const std::string glazed =
    R"([{"wall": 0, "at": 5, "width": 1.2, "bottom": 0.8, "top": 2.4, "material": "door",
  "repeat": {"count": 4, "pier": 0.4}}, {"wall": 2, "at": 2, "width": 1, "top": 2.1, "material": "steel"}])";

TEST(Openings, OfGlassAndSteelKeepTheRoomClosed) {
  const Scene scene = scene_of(l_store(glazed)), plain = scene_of(l_store("[]"));
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
  const Scene scene = scene_of(l_store(open)), plain = scene_of(l_store("[]"));
  EXPECT_NEAR(open_length(scene), 2 * (0.9 + 2) + 2 * 2 * (2 + 1), 1e-6);
  EXPECT_NEAR(areas_of(plain).at("white") - areas_of(scene).at("white"), 0.9 * 2 + 2 * 2, 1e-6);
  EXPECT_EQ(open_length(plain), 0) << "negative control";
}

// The wall 4 of 20 m runs to the left, below the zone "low" from x = 6 on, where the ceiling is at 2.6 m.
TEST(Openings, ReachTheCeilingAndTheCorners) {
  const Scene scene =
      scene_of(l_store(R"([{"wall": 4, "at": 0, "width": 20, "top": 2.6, "material": "door"}])"));
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
    const Scene named = scene_of(store(fmt::format("\"{}\"", names[k]))),
                numbered = scene_of(store(std::to_string(k)));
    EXPECT_EQ(named.mesh.vertices, numbered.mesh.vertices) << names[k];
    EXPECT_EQ(named.store_hash, numbered.store_hash);
    const std::array<Vec2, 2> ends = named.room->along_wall(k, 1, 2);
    const std::array<std::array<Vec2, 2>, 4> expected{
        {{{{1, 0}, {2, 0}}}, {{{8, 1}, {8, 2}}}, {{{7, 6}, {6, 6}}}, {{{0, 5}, {0, 4}}}}};
    EXPECT_EQ(ends, expected[k]) << names[k];
  }
}

TEST(Openings, AreInTheResolvedStore) {
  const Json resolved = Json::parse(expect_same_scene(read(l_store(glazed))));
  Json expected = Json::parse(glazed);
  expected[1]["bottom"] = 0;
  EXPECT_EQ(nlohmann::json(resolved["room"]["openings"]), nlohmann::json(expected));
  EXPECT_NE(scene_of(l_store(glazed)).store_hash, scene_of(l_store("[]")).store_hash);
  const Json without = Json::parse(expect_same_scene(read(l_store("[]"))));
  EXPECT_FALSE(without["room"].contains("openings")) << "the file is as before";
}

TEST(Openings, HaveNoCandidatesBeforeThem) {
  const auto candidates = [](const std::string& openings) {
    Json store = l_store(openings);
    store["transceivers"] = R"({"on": [{"type": "down", "wall": 0, "z": 2, "spacing": 1}]})"_json;
    std::string ids;
    for (const Transceiver& unit : scene_of(store).transceivers) ids += unit.id + " ";
    return ids;
  };
  // The windows are from 5 to 6.2 m, 6.6 to 7.8 m, 8.2 to 9.4 m and 9.8 to 11 m.
  EXPECT_EQ(candidates(glazed), "wall-0-1 wall-0-2 wall-0-3 wall-0-4 wall-0-5 wall-0-7 wall-0-10 wall-0-12 ");
  EXPECT_EQ(std::ranges::count(candidates("[]"), ' '), 12) << "negative control";
}

}  // namespace
}  // namespace shelfbeam::test
