#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/scene/build/misplaced.hpp"

#include "unit/scene/sample_store.hpp"

// Fixtures and devices at the outline, at holes and below the zones of a room that is not a box.

namespace shelfbeam {
namespace {

using test::Json;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

// An L with a slanted wall from (6, 6) to (2, 10), a hole and a low zone.
Json slanted_store() {
  return test::store_of_room(R"({
    "outline": [[0, 0], [10, 0], [10, 4], [6, 4], [6, 6], [2, 10], [0, 10]], "height": 3,
    "holes": [[[2, 2], [3, 2], [3, 3], [2, 3]]], "floor": "tile", "ceiling": "white", "walls": "white",
    "zones": [ {"id": "low", "polygon": [[8, 0], [10, 0], [10, 2], [8, 2]], "height": 1.5} ]})");
}

Scene scene_with(const std::string& fixture) {
  Json store = slanted_store();
  store["fixtures"].push_back(Json::parse(fixture));
  return test::scene_of(store);
}

std::string box(const std::string& min, const std::string& max) {
  return R"({"type": "box", "id": "B", "material": "white", "min": )" + min + R"(, "max": )" + max + "}";
}

TEST(OutsideRoom, FixturesWithAllCornersInTheRoom) {
  for (const std::string& across : {box("[1.5, 2.4, 0]", "[3.5, 2.6, 1]"),     // a hole
                                    box("[5, 3, 0]", "[8, 3.9, 2.9]"),         // none
                                    box("[7, 0.5, 0]", "[11, 1, 1]"),          // a wall
                                    box("[7.5, 0.5, 0]", "[9.5, 1.5, 2]"),     // the ceiling of the zone
                                    box("[7, 0.5, 0]", "[9.5, 1.5, 1.5]")}) {  // none
    const bool is_warned =
        across != box("[5, 3, 0]", "[8, 3.9, 2.9]") && across != box("[7, 0.5, 0]", "[9.5, 1.5, 1.5]");
    const auto warnings = sentences(scene_with(across).warnings);
    if (is_warned)
      EXPECT_THAT(warnings, Contains(HasSubstr("fixture 'B' extends outside the room"))) << across;
    else
      EXPECT_THAT(warnings, IsEmpty()) << across;
  }
  // Across the corner (6, 4) where the outline turns inwards, with all its corners in the room.
  EXPECT_THAT(sentences(scene_with(R"({"type": "box", "id": "B", "at": [5, 5.2, 0], "size": [3.1, 0.5, 1],
                             "rotation_deg": -45, "material": "white"})")
                            .warnings),
              Contains(HasSubstr("extends outside the room")));
  EXPECT_THAT(
      sentences(
          scene_with(
              R"({"type": "prism", "id": "P", "polygon": [[1.5, 1.5], [3.5, 1.5], [3.5, 3.5], [1.5, 3.5],
                             [1.5, 3.2], [3.2, 3.2], [3.2, 1.8], [1.5, 1.8]], "top": 1, "material": "white"})")
              .warnings),
      IsEmpty())
      << "around the hole";
}

TEST(OutsideRoom, BlocksUpToTheCeilingEndBelowTheLowestZone) {
  const auto top = [](const std::string& polygon) {
    return scene_with(R"({"type": "prism", "id": "P", "polygon": )" + polygon +
                      R"(, "top": "ceiling", "material": "white"})")
        .parts.front()
        .top;
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
    return sentences(test::scene_of(store).warnings);
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
    return sentences(test::scene_of(store).warnings);
  };
  EXPECT_THAT(warnings(4 - 0.1415), IsEmpty());
  EXPECT_THAT(warnings(4 - 0.1413), Contains(HasSubstr("the disc of transceiver 'T' extends")));
}

TEST(OutsideRoom, RemedyOfASinglePositionIsGeneral) {
  const Scene scene = test::scene_of(slanted_store());
  EXPECT_EQ(remedy_outside(*scene.room, {{7, 7, 1}}), "move it inside, or correct the room");
  const std::vector<Vec3> feet{{30, 10, 6}, {20, 12, 5}, {25, 9, 4}, {3, 3, 1}};
  EXPECT_THAT(remedy_outside(*scene.room, feet), HasSubstr("look like feet"));
}

}  // namespace
}  // namespace shelfbeam
