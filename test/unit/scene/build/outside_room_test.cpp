#include "shelfbeam/scene/build/misplaced.hpp"

#include "support/testing.hpp"
#include "unit/scene/sample_store.hpp"

// Fixtures and devices at the outline, at holes and below the zones of a room that is not a box.

namespace shelfbeam::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

// An L with a slanted wall from (6, 6) to (2, 10), a hole and a low zone.
Json slanted_store() {
  return store_of_room(R"({
    "outline": [[0, 0], [10, 0], [10, 4], [6, 4], [6, 6], [2, 10], [0, 10]], "height": 3,
    "holes": [[[2, 2], [3, 2], [3, 3], [2, 3]]], "floor": "tile", "ceiling": "white", "walls": "white",
    "zones": [ {"id": "low", "polygon": [[8, 0], [10, 0], [10, 2], [8, 2]], "height": 1.5} ]})");
}

Scene scene_with(const Json& fixture) {
  Json store = slanted_store();
  store["fixtures"].push_back({{"id", "B"}, {"material", "white"}});
  store["fixtures"][0].update(fixture);
  return scene_of(store);
}

TEST(OutsideRoom, FixturesWithAllCornersInTheRoom) {
  const struct {
    const char* what;
    Json fixture;
    bool is_warned;
  } all[] = {
      {"a hole", R"({"type": "box", "min": [1.5, 2.4, 0], "max": [3.5, 2.6, 1]})"_json, true},
      {"none", R"({"type": "box", "min": [5, 3, 0], "max": [8, 3.9, 2.9]})"_json, false},
      {"a wall", R"({"type": "box", "min": [7, 0.5, 0], "max": [11, 1, 1]})"_json, true},
      {"the ceiling of the zone", R"({"type": "box", "min": [7.5, 0.5, 0], "max": [9.5, 1.5, 2]})"_json,
       true},
      {"below it", R"({"type": "box", "min": [7, 0.5, 0], "max": [9.5, 1.5, 1.5]})"_json, false},
      {"the corner (6, 4), where the outline turns inwards",
       R"({"type": "box", "at": [5, 5.2, 0], "size": [3.1, 0.5, 1], "rotation_deg": -45})"_json, true},
      {"around the hole", R"({"type": "prism", "polygon": [[1.5, 1.5], [3.5, 1.5], [3.5, 3.5], [1.5, 3.5],
         [1.5, 3.2], [3.2, 3.2], [3.2, 1.8], [1.5, 1.8]], "top": 1})"_json,
       false}};
  for (const auto& [what, fixture, is_warned] : all) {
    const auto warnings = sentences(scene_with(fixture).warnings);
    if (is_warned)
      EXPECT_THAT(warnings, Contains(HasSubstr("fixture 'B' extends outside the room"))) << what;
    else
      EXPECT_THAT(warnings, IsEmpty()) << what;
  }
}

TEST(OutsideRoom, BlocksUpToTheCeilingEndBelowTheLowestZone) {
  const auto top = [](const char* polygon) {
    const Json prism{{"type", "prism"}, {"polygon", Json::parse(polygon)}, {"top", "ceiling"}};
    return scene_with(prism).parts.front().top;
  };
  EXPECT_EQ(top("[[7, 0], [8, 0], [8, 1], [7, 1]]"), 3) << "beside the zone";
  EXPECT_EQ(top("[[7, 2], [8, 2], [8, 3], [7, 3]]"), 3) << "at its corner";
  EXPECT_EQ(top("[[7, 0], [10, 0], [10, 3], [7, 3]]"), 1.5) << "around the zone";
  EXPECT_EQ(top("[[8, 0], [9, 0], [9, 1], [8, 1]]"), 1.5);
}

TEST(OutsideRoom, FlushLabelsOnSlantedWallsAreInside) {
  const auto warnings = [](const char* position, const char* normal) {
    Json store = slanted_store();
    store["label_types"]["small"]["size"] = {0.2, 0.1};
    store["labels"][0]["position"] = Json::parse(position);
    store["labels"][0]["normal"] = Json::parse(normal);
    return warnings_of(store);
  };
  EXPECT_THAT(warnings("[4, 8, 1]", "[-1, -1, 0]"), IsEmpty());
  EXPECT_THAT(warnings("[3.99, 7.99, 1]", "[-1, 0, 0]"),
              Contains(HasSubstr("label 'L' extends 0.0566 m behind wall 4")));
}

TEST(OutsideRoom, DiscsAtSlantedWalls) {
  const auto warnings = [](double x) {
    Json store = slanted_store();
    store["transceivers"]["list"][0]["type"] = "disc";
    store["transceivers"]["list"][0]["position"] = {x, x + 4, 2};
    return warnings_of(store);
  };
  EXPECT_THAT(warnings(4 - 0.1415), IsEmpty());
  EXPECT_THAT(warnings(4 - 0.1413), Contains(HasSubstr("the disc of transceiver 'T' extends")));
}

TEST(OutsideRoom, RemedyOfASinglePositionIsGeneral) {
  const Scene scene = scene_of(slanted_store());
  EXPECT_EQ(remedy_outside(*scene.room, {{7, 7, 1}}), "move it inside, or correct the room");
  const std::vector<Vec3> feet{{30, 10, 6}, {20, 12, 5}, {25, 9, 4}, {3, 3, 1}};
  EXPECT_THAT(remedy_outside(*scene.room, feet), HasSubstr("look like feet"));
}

}  // namespace
}  // namespace shelfbeam::test
