#include "shelfbeam/math/warp.hpp"

#include "support/testing.hpp"
#include "unit/scene/stores.hpp"

namespace shelfbeam::test {
namespace {

using testing::HasSubstr;

// The candidates of one member of a list in the section "transceivers".
std::vector<Transceiver> units_of(const char* list, const Json& keys) {
  Json member{{"type", "down"}};
  member.update(keys);
  return scene_of(zoned_store({{list, Json::array({member})}})).transceivers;
}

TEST(MountPoints, FollowTheOutlineAndTheCeilings) {
  const auto units = units_of("areas", R"({"area": "room", "spacing": 2, "below_ceiling": 0.1})"_json);
  // Cells of 2 m: two rows of four, three rows of two.
  EXPECT_EQ(ids_of(units),
            "A1-1-1 A1-2-1 A1-3-1 A1-4-1 A1-1-2 A1-2-2 A1-3-2 A1-4-2 A1-1-3 A1-2-3 A1-1-4 A1-2-4 "
            "A1-1-5 A1-2-5 ");
  for (const Transceiver& unit : units)
    EXPECT_NEAR(unit.position.z, unit.position.y > 6 ? 2.5 : 3.1, 1e-12) << unit.id;
  EXPECT_EQ(units.front().position, (Vec3{1, 1, 3.1}));
}

TEST(MountPoints, OfAZoneOrAPolygonHaveSeveralAxesAndLeaveInnerWallsOut) {
  const auto zone = units_of("areas", R"({"area": "low", "spacing": 4, "z": 2.5,
    "axes": [[0, 0, -1], [1, 0, -1]]})"_json);
  EXPECT_EQ(ids_of(zone), "A1-1-1/a1 A1-1-1/a2 ");
  EXPECT_EQ(zone[1].position, (Vec3{2, 8, 2.5}));
  EXPECT_NEAR(zone[1].axis.x, std::sqrt(0.5), 1e-12);
  const auto wall = units_of("areas", R"({"area": [[5, 0.5], [7, 0.5], [7, 1.5], [5, 1.5]],
    "spacing": 0.4, "z": 2})"_json);
  EXPECT_EQ(ids_of(wall),
            "A1-1-1 A1-2-1 A1-4-1 A1-5-1 A1-1-2 A1-2-2 A1-4-2 A1-5-2 A1-1-3 A1-2-3 A1-4-3 A1-5-3 ")
      << "the third column is in the wall";
}

TEST(MountPoints, OfTheRoomWithoutZonesAreThoseOfTheRoomOutsideThem) {
  const auto of_area = [](const std::string& area) {
    return units_of("areas", {{"area", area}, {"spacing", 2}, {"below_ceiling", 0.1}});
  };
  std::vector<Transceiver> outside;
  for (const Transceiver& unit : of_area("room"))
    if (unit.position.y < 6) outside.push_back(unit);
  ASSERT_EQ(outside.size(), 10u) << "negative control: 4 of 14 are in the zone";
  const auto units = of_area("room without zones");
  EXPECT_EQ(ids_of(units), ids_of(outside));
  for (const Transceiver& unit : units) EXPECT_NEAR(unit.position.z, 3.1, 1e-12) << unit.id;
}

TEST(MountPoints, OfAnAreaBeyondTheRoomAreOnlyThoseInTheRoom) {
  const auto units = units_of("areas", R"({"spacing": 2, "z": 2,
    "area": [[-9e3, -9e3], [9e3, -9e3], [9e3, 9e3], [-9e3, 9e3]]})"_json);
  ASSERT_EQ(units.size(), 14u);
  EXPECT_EQ(units.front().id, "A1-4501-4501");
  EXPECT_NEAR(length(units.front().position - Vec3{1, 1, 2}), 0, 1e-9);
}

TEST(MountPoints, OfARailIncludeItsEndsAndCorners) {
  const auto units = units_of("rails", R"({"id": "R", "points": [[1, 1, 2.8], [3, 1, 2.8], [3, 2, 2.8]],
    "spacing": 0.52})"_json);
  ASSERT_EQ(units.size(), 7u);
  EXPECT_EQ(ids_of(units), "R-1 R-2 R-3 R-4 R-5 R-6 R-7 ");
  EXPECT_EQ(units.front().position, (Vec3{1, 1, 2.8}));
  EXPECT_NEAR(length(units[4].position - Vec3{3, 1, 2.8}), 0, 1e-12);
  EXPECT_EQ(units.back().position, (Vec3{3, 2, 2.8}));
}

TEST(MountPoints, OnFacesLookAwayFromThem) {
  const auto column = units_of("on", R"({"fixture": "C", "z": 2.4, "spacing": 0.4, "tilt_deg": 30,
    "offset": 0.05})"_json);
  ASSERT_EQ(column.size(), 4u) << "its girth is 1.57 m";
  for (const Transceiver& unit : column) {
    const Vec3 out{unit.position.x - 2, unit.position.y - 3, 0};
    EXPECT_NEAR(length(out), 0.3, 0.002);
    EXPECT_NEAR(unit.axis.z, -0.5, 1e-12);
    EXPECT_GT(dot(unit.axis, normalized(out)), std::cos(radians(30)) - 0.01);
  }
  const auto wall = units_of("on", R"({"wall": 3, "z": 2, "spacing": 2})"_json);
  EXPECT_EQ(ids_of(wall), "wall-3-1 wall-3-2 wall-3-3 ");
  EXPECT_EQ(wall[0].position, (Vec3{3.98, 5, 2}));
  EXPECT_EQ(wall[0].axis, (Vec3{-1, 0, 0}));
  for (const Transceiver& unit : units_of("on", R"({"inner_wall": "W", "z": 2, "spacing": 0.5,
    "offset": 0.01})"_json))
    EXPECT_GT(dot(unit.axis, unit.position - Vec3{6, 1, 2}), 0) << unit.id;
}

TEST(MountPoints, OnFacesAreInFrontOfThemWithoutAnOffset) {
  // The girth is 5.2 m: two on each side, one at the free end. The other end is in the wall of the room.
  const auto units = units_of("on", R"({"inner_wall": "W", "z": 2, "spacing": 0.87, "offset": 0})"_json);
  ASSERT_EQ(units.size(), 5u);
  for (const Transceiver& unit : units)
    EXPECT_NEAR(std::max(std::abs(unit.position.x - 6) - 0.3, unit.position.y - 2), 1e-4, 1e-9) << unit.id;
}

// The candidates of a member of `on` in a store with this fixture or with these openings of the wall.
std::vector<Transceiver> units_on(const Json& keys, const Json& fixture,
                                  const Json& openings = Json::array()) {
  Json member{{"type", "down"}};
  member.update(keys);
  Json store = zoned_store({{"on", Json::array({member})},
                            {"list", R"([{"id": "T", "position": [1, 1, 2], "type": "down"}])"_json}});
  store["fixtures"].push_back(fixture);
  store["room"]["inner_walls"][0]["openings"] = openings;
  return scene_of(store).transceivers;
}

TEST(MountPoints, AreOnlyWhereThereIsAFace) {
  const Json box =
      R"({"type": "box", "id": "B", "min": [1, 1, 0.5], "max": [2, 2, 1], "material": "white"})"_json;
  const auto on_box = [&](double z) {
    return units_on({{"fixture", "B"}, {"spacing", 1}, {"z", z}}, box).size() - 1;
  };
  EXPECT_EQ(on_box(0.4), 0u) << "below it";
  EXPECT_EQ(on_box(0.8), 4u);
  EXPECT_EQ(on_box(1.1), 0u) << "above it";
  const auto on_wall = [&](double z) {
    return ids_of(units_on({{"inner_wall", "W"}, {"spacing", 0.52}, {"z", z}}, box,
                           R"([{"at": 0.5, "width": 0.8, "top": 2.1}])"_json));
  };
  EXPECT_EQ(on_wall(2.2), "W-1 W-2 W-3 W-4 W-5 W-6 W-7 W-8 W-9 T ") << "above the door";
  EXPECT_EQ(on_wall(1.5), "W-1 W-4 W-5 W-6 W-9 T ") << "beside the door";
}

// The mean position of candidates.
Vec3 middle_of(const std::vector<Transceiver>& units) {
  Vec3 sum;
  for (const Transceiver& unit : units) sum = sum + unit.position;
  return sum / static_cast<double>(units.size());
}

TEST(MountPoints, OnAFaceByTheCompassLookThere) {
  for (const auto& [name, outward] : {std::pair{"north", Vec3{0, 1, 0}},
                                      {"east", Vec3{1, 0, 0}},
                                      {"south", Vec3{0, -1, 0}},
                                      {"west", Vec3{-1, 0, 0}}}) {
    Json keys{{"fixture", "C"}, {"spacing", 0.1}, {"z", 2}, {"offset", 0.01}};
    const auto all = units_of("on", keys);
    keys["face"] = name;
    const auto column = units_of("on", keys);
    EXPECT_EQ(ids_of(column), fmt::format("C-{0}-1 C-{0}-2 C-{0}-3 C-{0}-4 ", name))
        << "a quarter of its girth is 0.39 m";
    for (const Transceiver& unit : column) EXPECT_GT(dot(unit.axis, outward), std::sqrt(0.5)) << unit.id;
    const Vec3 offset = middle_of(column) - Vec3{2, 3, 2};
    EXPECT_GT(dot(offset, outward), 0.23);
    // At corners of the outline, either neighbour decides where a candidate is.
    EXPECT_NEAR(length(offset - outward * dot(offset, outward)), 0, 2e-3) << "symmetrical about " << name;
    // Negative control: those around the column look to the other side, too.
    EXPECT_TRUE(std::ranges::any_of(
        all, [&, &away = outward](const Transceiver& unit) { return dot(unit.axis, away) < 0; }));
  }
}

TEST(MountPoints, OnAFaceByTheCompassFollowTurnedAndConcaveOutlines) {
  const auto on_box = [](double rotation_deg) {
    Json box =
        R"({"type": "box", "id": "B", "at": [1.5, 1.5, 0], "size": [2, 1, 1], "material": "white"})"_json;
    box["rotation_deg"] = rotation_deg;
    return units_on({{"fixture", "B"}, {"face", "south"}, {"spacing", 1}, {"z", 0.5}}, box);
  };
  const auto straight = on_box(0);
  ASSERT_EQ(ids_of(straight), "B-south-1 B-south-2 T ");
  EXPECT_EQ(straight[0].position, (Vec3{2, 1.48, 0.5}));
  EXPECT_EQ(straight[1].axis, (Vec3{0, -1, 0}));
  const auto turned = on_box(30);
  ASSERT_EQ(ids_of(turned), "B-south-1 B-south-2 T ");
  EXPECT_NEAR(turned[0].axis.x, 0.5, 1e-12);
  // Beyond 45 degrees, the south face is the short side.
  EXPECT_EQ(ids_of(on_box(60)), "B-south-1 T ");
  EXPECT_EQ(ids_of(on_box(-60)), "B-south-1 T ");
  const auto wall = units_of("on", R"({"inner_wall": "W", "face": "west", "z": 2,
    "spacing": 1})"_json);
  ASSERT_EQ(ids_of(wall), "W-west-1 W-west-2 ");
  EXPECT_NEAR(wall[0].position.x, 5.68, 1e-12);
}

TEST(MountPoints, OnFacesHaveSeveralTiltsAndAnId) {
  const auto units = scene_of(zoned_store(R"({"on": [
    {"type": "down", "fixture": "C", "z": 2.4, "spacing": 2, "tilt_deg": [0, 90]},
    {"type": "down", "fixture": "C", "id": "low", "z": 1, "spacing": 2, "tilt_deg": [30]},
    {"type": "down", "wall": 3, "id": "east", "z": 1, "spacing": 6}]})"_json))
                         .transceivers;
  ASSERT_EQ(ids_of(units), "C-1/a1 C-1/a2 low-1 east-1 ");
  EXPECT_EQ(units[0].position, units[1].position);
  EXPECT_NEAR(units[0].axis.z, 0, 1e-12);
  EXPECT_NEAR(units[1].axis.z, -1, 1e-12);
  EXPECT_NEAR(units[2].axis.z, -0.5, 1e-12);
}

TEST(MountPoints, FollowAConcavePrism) {
  for (const char* polygon : {"[[1, 1], [3, 1], [3, 2], [2, 2], [2, 5], [1, 5]]",
                              "[[1, 5], [2, 5], [2, 2], [3, 2], [3, 1], [1, 1]]"}) {
    const Json prism{{"type", "prism"},
                     {"id", "P"},
                     {"top", 1.5},
                     {"material", "white"},
                     {"polygon", Json::parse(polygon)}};
    Json keys{{"fixture", "P"}, {"spacing", 1}, {"z", 1}, {"offset", 0.1}};
    const auto units = units_on(keys, prism);
    ASSERT_EQ(units.size(), 13u);
    EXPECT_EQ(std::ranges::count_if(units,
                                    [](const Transceiver& unit) {
                                      return std::abs(unit.position.x - 2.1) < 1e-9 && unit.axis.x > 0.99;
                                    }),
              3)
        << "along its inner side";
    keys["face"] = "north";
    const auto north = units_on(keys, prism);
    ASSERT_EQ(north.size(), 3u) << "two separate parts, and T";
    EXPECT_NEAR(length(middle_of({north[0], north[1]}) - Vec3{2, 3.6, 1}), 0, 1e-12);
  }
}

TEST(MountPoints, AreKeptOutByPolygonsAndHeights) {
  const auto first_outside = [](double low, double high) {
    Json transceivers = R"({"areas": [{"type": "down", "area": "room", "spacing": 2, "z": 2.5}],
      "keep_out": [{"polygon": [[0, 0], [4, 0], [0, 4]]}]})"_json;
    transceivers["keep_out"][0]["z"] = {low, high};
    return scene_of(zoned_store(transceivers)).transceivers.front().id;
  };
  EXPECT_EQ(first_outside(2, 2.6), "A1-2-1") << "(1, 1) is in the triangle, (3, 1) on its border or outside";
  EXPECT_EQ(first_outside(2.6, 3), "A1-1-1");
}

TEST(MountPoints, WarnOfMountsWithoutCandidates) {
  EXPECT_THAT(
      warnings_of(zoned_store(
          R"({"areas": [{"type": "down", "area": [[5, 5], [7, 5], [7, 9]], "spacing": 1, "z": 2},
                        {"type": "down", "area": "low", "spacing": 4, "z": 2.7},
                        {"type": "down", "area": [[5.9, 0.5], [6.1, 0.5], [6.1, 1]], "spacing": 0.1, "z": 2}],
              "on": [{"type": "down", "fixture": "C", "spacing": 1, "z": 3.3}],
              "list": [{"id": "T", "position": [1, 1, 2], "type": "down"}]})"_json)),
      testing::ElementsAre(
          HasSubstr("areas[0]: has no candidates: no point of its grid is within both the area and the room"),
          HasSubstr("areas[1]: has no candidates: the point (2, 8, 2.7) is above the ceiling of zone 'low' "
                    "(2.7 m > 2.6 m); correct its place"),
          HasSubstr("areas[2]: has no candidates: the point (5.95, 0.55, 2) is within the inner wall 'W'"),
          HasSubstr(
              "on[0]: has no candidates: the point (1.99804, 2.72929, 3.3) is not in front of a face")));
}

// test/data/refused/transceivers.jsonc has the other faults.
TEST(MountPoints, LimitTheCandidatesWithSeveralAxes) {
  const Json rail{{"id", "R"},
                  {"points", {{1, 1, 2}, {7, 1, 2}}},
                  {"spacing", 0.001},
                  {"axes", std::vector<Json>(200, {0, 0, -1})}};
  expect_input_error([&] { units_of("rails", rail); },
                     "transceivers.rails[0].spacing: produces 1200200 candidates");
  const Json wall{{"wall", 1}, {"z", 2}, {"spacing", 0.001}, {"tilt_deg", std::vector<int>(300)}};
  expect_input_error([&] { units_of("on", wall); },
                     "transceivers.on[0].spacing: produces 1200000 candidates");
}

TEST(MountPoints, RefuseAFaceThatTheOutlineDoesNotHave) {
  Json square = R"({"type": "box", "id": "B", "at": [2, 1, 0], "size": [1, 1, 1], "material": "white"})"_json;
  for (const std::string face : {"north", "east", "south", "west"}) {
    const Json keys{{"fixture", "B"}, {"spacing", 1}, {"z", 0.5}, {"face", face}};
    square["rotation_deg"] = 45;
    expect_input_error([&] { units_on(keys, square); },
                       "transceivers.on[0].face: is " + face +
                           ", but all faces of 'B' look 45 degrees or more away from it; name another");
    square["rotation_deg"] = 44.9;
    EXPECT_EQ(units_on(keys, square).size(), 2u) << "negative control";
  }
}

// Candidates count before they are allocated.
TEST(MountPoints, CountInTheMemoryOfTheScene) {
  const auto refused = [](const Json& transceivers, std::string_view where) {
    constexpr std::size_t memory = 100'000'000;
    const Store store = parse_store(zoned_store(transceivers).dump(), "store.json", {}, {false, memory});
    expect_input_error([&] { make_scene(store); }, where, "the store up to here requires about 0.");
  };
  refused(R"({"areas": [{"type": "down", "area": "room", "spacing": 0.02, "z": 2}]})"_json,
          "transceivers.areas[0]");
  Json rail =
      R"({"rails": [{"type": "down", "id": "R", "points": [[1, 1, 2], [7, 1, 2]], "spacing": 0.001}]})"_json;
  rail["rails"][0]["axes"] = std::vector<Json>(20, {0, 0, -1});
  refused(rail, "transceivers.rails[0]");
  Json on;
  for (int k = 0; k < 80; ++k)
    on["on"].push_back(
        {{"id", std::to_string(k)}, {"type", "down"}, {"fixture", "C"}, {"z", 2}, {"spacing", 0.001}});
  refused(on, "transceivers.on[");
}

}  // namespace
}  // namespace shelfbeam::test
