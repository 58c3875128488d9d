#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"

#include "support/expect_input_error.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

using test::Json;
using testing::HasSubstr;

// An L-shaped room with a lower zone, an inner wall and a column.
Json l_shaped_store(const std::string& transceivers) {
  Json store = test::sample_store();
  store["room"] = Json::parse(R"({
    "outline": [[0, 0], [8, 0], [8, 4], [4, 4], [4, 10], [0, 10]], "height": 3.2, "floor": "tile", "ceiling": "white",
    "walls": "white",
    "zones": [{"id": "low", "polygon": [[0, 6], [4, 6], [4, 10], [0, 10]], "height": 2.6}],
    "inner_walls": [{"id": "W", "from": [6, 0], "to": [6, 2], "thickness": 0.6}]})");
  store["fixtures"] = Json::parse(
      R"([{"type": "cylinder", "id": "C", "at": [2, 3], "radius": 0.25, "top": "ceiling", "material": "white"}])");
  store["labels"] =
      Json::parse(R"([{"id": "L", "position": [1, 1, 1], "normal": [1, 0, 0], "type": "small"}])");
  store["transceivers"] = Json::parse(transceivers);
  return store;
}

std::vector<Transceiver> units_of(const std::string& transceivers) {
  return make_scene(test::read_text(l_shaped_store(transceivers).dump())).transceivers;
}

std::string ids_of(const std::vector<Transceiver>& units) {
  std::string ids;
  for (const Transceiver& unit : units) ids += unit.id + " ";
  return ids;
}

// A list with copies of a value.
std::string repeated(const std::string& value, int count) {
  std::string list;
  for (int k = 0; k < count; ++k) list += (k == 0 ? "[" : ", ") + value;
  return list + "]";
}

TEST(MountPoints, FollowTheOutlineAndTheCeilings) {
  const auto units =
      units_of(R"({"areas": [{"type": "down", "area": "room", "spacing": 2, "below_ceiling": 0.1}]})");
  // Cells of 2 m: two rows of four, three rows of two.
  EXPECT_EQ(ids_of(units),
            "A1-1-1 A1-2-1 A1-3-1 A1-4-1 A1-1-2 A1-2-2 A1-3-2 A1-4-2 A1-1-3 A1-2-3 A1-1-4 A1-2-4 "
            "A1-1-5 A1-2-5 ");
  for (const Transceiver& unit : units)
    EXPECT_NEAR(unit.position.z, unit.position.y > 6 ? 2.5 : 3.1, 1e-12) << unit.id;
  EXPECT_EQ(units.front().position, (Vec3{1, 1, 3.1}));
}

TEST(MountPoints, OfAZoneOrAPolygonHaveSeveralAxesAndLeaveInnerWallsOut) {
  const auto zone = units_of(R"({"areas": [{"type": "down", "area": "low", "spacing": 4, "z": 2.5,
    "axes": [[0, 0, -1], [1, 0, -1]]}]})");
  EXPECT_EQ(ids_of(zone), "A1-1-1/a1 A1-1-1/a2 ");
  EXPECT_EQ(zone[1].position, (Vec3{2, 8, 2.5}));
  EXPECT_NEAR(zone[1].axis.x, std::sqrt(0.5), 1e-12);
  const auto wall = units_of(R"({"areas": [{"type": "down", "area": [[5, 0.5], [7, 0.5], [7, 1.5], [5, 1.5]],
    "spacing": 0.4, "z": 2}]})");
  EXPECT_EQ(ids_of(wall),
            "A1-1-1 A1-2-1 A1-4-1 A1-5-1 A1-1-2 A1-2-2 A1-4-2 A1-5-2 A1-1-3 A1-2-3 A1-4-3 A1-5-3 ")
      << "the third column is in the wall";
}

TEST(MountPoints, OfTheRoomWithoutZonesAreThoseOfTheRoomOutsideThem) {
  const auto of_area = [](const std::string& area) {
    return units_of(R"({"areas": [{"type": "down", "spacing": 2, "below_ceiling": 0.1, "area": ")" + area +
                    "\"}]}");
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
  const auto units = units_of(R"({"areas": [{"type": "down", "spacing": 2, "z": 2,
    "area": [[-9e3, -9e3], [9e3, -9e3], [9e3, 9e3], [-9e3, 9e3]]}]})");
  ASSERT_EQ(units.size(), 14u);
  EXPECT_EQ(units.front().id, "A1-4501-4501");
  EXPECT_NEAR(length(units.front().position - Vec3{1, 1, 2}), 0, 1e-9);
}

TEST(MountPoints, OfARailIncludeItsEndsAndCorners) {
  const auto units =
      units_of(R"({"rails": [{"type": "down", "id": "R", "points": [[1, 1, 2.8], [3, 1, 2.8], [3, 2, 2.8]],
    "spacing": 0.52}]})");
  ASSERT_EQ(units.size(), 7u);
  EXPECT_EQ(ids_of(units), "R-1 R-2 R-3 R-4 R-5 R-6 R-7 ");
  EXPECT_EQ(units.front().position, (Vec3{1, 1, 2.8}));
  EXPECT_NEAR(length(units[4].position - Vec3{3, 1, 2.8}), 0, 1e-12);
  EXPECT_EQ(units.back().position, (Vec3{3, 2, 2.8}));
}

TEST(MountPoints, OnFacesLookAwayFromThem) {
  const auto column =
      units_of(R"({"on": [{"type": "down", "fixture": "C", "z": 2.4, "spacing": 0.4, "tilt_deg": 30,
    "offset": 0.05}]})");
  ASSERT_EQ(column.size(), 4u) << "its girth is 1.57 m";
  for (const Transceiver& unit : column) {
    const Vec3 out{unit.position.x - 2, unit.position.y - 3, 0};
    EXPECT_NEAR(length(out), 0.3, 0.002);
    EXPECT_NEAR(unit.axis.z, -0.5, 1e-12);
    EXPECT_GT(dot(unit.axis, normalized(out)), std::cos(radians(30)) - 0.01);
  }
  const auto wall = units_of(R"({"on": [{"type": "down", "wall": 3, "z": 2, "spacing": 2}]})");
  EXPECT_EQ(ids_of(wall), "wall-3-1 wall-3-2 wall-3-3 ");
  EXPECT_EQ(wall[0].position, (Vec3{3.98, 5, 2}));
  EXPECT_EQ(wall[0].axis, (Vec3{-1, 0, 0}));
  for (const Transceiver& unit :
       units_of(R"({"on": [{"type": "down", "inner_wall": "W", "z": 2, "spacing": 0.5,
    "offset": 0.01}]})"))
    EXPECT_GT(dot(unit.axis, unit.position - Vec3{6, 1, 2}), 0) << unit.id;
}

TEST(MountPoints, OnFacesAreInFrontOfThemWithoutAnOffset) {
  // The girth is 5.2 m: two on each side, one at the free end. The other end is in the wall of the room.
  const auto units =
      units_of(R"({"on": [{"type": "down", "inner_wall": "W", "z": 2, "spacing": 0.87, "offset": 0}]})");
  ASSERT_EQ(units.size(), 5u);
  for (const Transceiver& unit : units)
    EXPECT_NEAR(std::max(std::abs(unit.position.x - 6) - 0.3, unit.position.y - 2), 1e-4, 1e-9) << unit.id;
}

// The candidates of a member of `on` in a store with this fixture or with these openings of the wall.
std::vector<Transceiver> units_on(const std::string& member, const std::string& fixture,
                                  const std::string& openings = "[]") {
  Json store = l_shaped_store(R"({"on": [)" + member + R"(], "list": [{"id": "T", "position": [1, 1, 2],
    "type": "down"}]})");
  store["fixtures"].push_back(Json::parse(fixture));
  store["room"]["inner_walls"][0]["openings"] = Json::parse(openings);
  return make_scene(test::read_text(store.dump())).transceivers;
}

TEST(MountPoints, AreOnlyWhereThereIsAFace) {
  const std::string box =
      R"({"type": "box", "id": "B", "min": [1, 1, 0.5], "max": [2, 2, 1], "material": "white"})";
  const auto on_box = [&](const std::string& z) {
    return units_on(R"({"type": "down", "fixture": "B", "spacing": 1, "z": )" + z + "}", box).size() - 1;
  };
  EXPECT_EQ(on_box("0.4"), 0u) << "below it";
  EXPECT_EQ(on_box("0.8"), 4u);
  EXPECT_EQ(on_box("1.1"), 0u) << "above it";
  const auto on_wall = [&](const std::string& z) {
    return ids_of(units_on(R"({"type": "down", "inner_wall": "W", "spacing": 0.52, "z": )" + z + "}", box,
                           R"([{"at": 0.5, "width": 0.8, "top": 2.1}])"));
  };
  EXPECT_EQ(on_wall("2.2"), "W-1 W-2 W-3 W-4 W-5 W-6 W-7 W-8 W-9 T ") << "above the door";
  EXPECT_EQ(on_wall("1.5"), "W-1 W-4 W-5 W-6 W-9 T ") << "beside the door";
}

// The mean position of candidates.
Vec3 middle_of(const std::vector<Transceiver>& units) {
  Vec3 sum;
  for (const Transceiver& unit : units) sum = sum + unit.position;
  return sum / static_cast<double>(units.size());
}

TEST(MountPoints, OnAFaceByTheCompassLookThere) {
  struct Face {
    const char* name;
    Vec3 outward;
  };
  for (const auto& [name, outward] : std::vector<Face>{
           {"north", {0, 1, 0}}, {"east", {1, 0, 0}}, {"south", {0, -1, 0}}, {"west", {-1, 0, 0}}}) {
    const auto on = [face = std::string(name)](const std::string& members) {
      return units_of(fmt::format(
          R"({{"on": [{{"type": "down", "z": 2, "offset": 0.01, "face": "{}", {}}}]}})", face, members));
    };
    const auto column = on(R"("fixture": "C", "spacing": 0.1)");
    EXPECT_EQ(ids_of(column), fmt::format("C-{0}-1 C-{0}-2 C-{0}-3 C-{0}-4 ", name))
        << "a quarter of its girth is 0.39 m";
    for (const Transceiver& unit : column) EXPECT_GT(dot(unit.axis, outward), std::sqrt(0.5)) << unit.id;
    const Vec3 offset = middle_of(column) - Vec3{2, 3, 2};
    EXPECT_GT(dot(offset, outward), 0.23);
    // At corners of the outline, either neighbour decides where a candidate is.
    EXPECT_NEAR(length(offset - outward * dot(offset, outward)), 0, 2e-3) << "symmetrical about " << name;
    // Negative control: those around the column look to the other side, too.
    const auto all = units_of(R"({"on": [{"type": "down", "fixture": "C", "z": 2, "spacing": 0.1}]})");
    EXPECT_TRUE(std::ranges::any_of(
        all, [&, &away = outward](const Transceiver& unit) { return dot(unit.axis, away) < 0; }));
  }
}

TEST(MountPoints, OnAFaceByTheCompassFollowTurnedAndConcaveOutlines) {
  const auto on_box = [](const std::string& rotation_deg) {
    return units_on(R"({"type": "down", "fixture": "B", "face": "south", "spacing": 1, "z": 0.5})",
                    R"({"type": "box", "id": "B", "at": [1.5, 1.5, 0], "size": [2, 1, 1], "material": "white",
                        "rotation_deg": )" +
                        rotation_deg + "}");
  };
  const auto straight = on_box("0");
  ASSERT_EQ(ids_of(straight), "B-south-1 B-south-2 T ");
  EXPECT_EQ(straight[0].position, (Vec3{2, 1.48, 0.5}));
  EXPECT_EQ(straight[1].axis, (Vec3{0, -1, 0}));
  const auto turned = on_box("30");
  ASSERT_EQ(ids_of(turned), "B-south-1 B-south-2 T ");
  EXPECT_NEAR(turned[0].axis.x, 0.5, 1e-12);
  // Beyond 45 degrees, the south face is the short side.
  EXPECT_EQ(ids_of(on_box("60")), "B-south-1 T ");
  EXPECT_EQ(ids_of(on_box("-60")), "B-south-1 T ");

  for (const char* polygon : {"[[1, 1], [3, 1], [3, 2], [2, 2], [2, 5], [1, 5]]",
                              "[[1, 5], [2, 5], [2, 2], [3, 2], [3, 1], [1, 1]]"}) {
    const auto units =
        units_on(R"({"type": "down", "fixture": "P", "face": "north", "spacing": 1, "z": 1, "offset": 0.1})",
                 std::string(R"({"type": "prism", "id": "P", "top": 1.5, "material": "white", "polygon": )") +
                     polygon + "}");
    ASSERT_EQ(units.size(), 3u) << "two separate parts, and T";
    EXPECT_NEAR(length(middle_of({units[0], units[1]}) - Vec3{2, 3.6, 1}), 0, 1e-12);
  }
  const auto wall = units_of(R"({"on": [{"type": "down", "inner_wall": "W", "face": "west", "z": 2,
    "spacing": 1}]})");
  ASSERT_EQ(ids_of(wall), "W-west-1 W-west-2 ");
  EXPECT_NEAR(wall[0].position.x, 5.68, 1e-12);
}

TEST(MountPoints, OnFacesHaveSeveralTiltsAndAnId) {
  const auto units = units_of(R"({"on": [
    {"type": "down", "fixture": "C", "z": 2.4, "spacing": 2, "tilt_deg": [0, 90]},
    {"type": "down", "fixture": "C", "id": "low", "z": 1, "spacing": 2, "tilt_deg": [30]},
    {"type": "down", "wall": 3, "id": "east", "z": 1, "spacing": 6}]})");
  ASSERT_EQ(ids_of(units), "C-1/a1 C-1/a2 low-1 east-1 ");
  EXPECT_EQ(units[0].position, units[1].position);
  EXPECT_NEAR(units[0].axis.z, 0, 1e-12);
  EXPECT_NEAR(units[1].axis.z, -1, 1e-12);
  EXPECT_NEAR(units[2].axis.z, -0.5, 1e-12);
}

TEST(MountPoints, FollowAConcavePrism) {
  for (const char* polygon : {"[[1, 1], [3, 1], [3, 2], [2, 2], [2, 5], [1, 5]]",
                              "[[1, 5], [2, 5], [2, 2], [3, 2], [3, 1], [1, 1]]"}) {
    const auto units =
        units_on(R"({"type": "down", "fixture": "P", "spacing": 1, "z": 1, "offset": 0.1})",
                 std::string(R"({"type": "prism", "id": "P", "top": 1.5, "material": "white", "polygon": )") +
                     polygon + "}");
    ASSERT_EQ(units.size(), 13u);
    EXPECT_EQ(std::count_if(units.begin(), units.end(),
                            [](const Transceiver& unit) {
                              return std::abs(unit.position.x - 2.1) < 1e-9 && unit.axis.x > 0.99;
                            }),
              3)
        << "along its inner side";
  }
}

TEST(MountPoints, AreKeptOutByPolygonsAndHeights) {
  const std::string areas = R"({"areas": [{"type": "down", "area": "room", "spacing": 2, "z": 2.5}])";
  const std::string low =
      units_of(areas + R"(, "keep_out": [{"polygon": [[0, 0], [4, 0], [0, 4]], "z": [2, 2.6]}]})").front().id;
  EXPECT_EQ(low, "A1-2-1") << "(1, 1) is in the triangle, (3, 1) on its border or outside";
  EXPECT_EQ(
      units_of(areas + R"(, "keep_out": [{"polygon": [[0, 0], [4, 0], [0, 4]], "z": [2.6, 3]}]})").front().id,
      "A1-1-1");
}

TEST(MountPoints, WarnOfMountsWithoutCandidates) {
  const std::string list = R"("list": [{"id": "T", "position": [1, 1, 2], "type": "down"}])";
  const Json store = l_shaped_store(
      R"({"areas": [{"type": "down", "area": [[5, 5], [7, 5], [7, 9]], "spacing": 1, "z": 2},
                    {"type": "down", "area": "low", "spacing": 4, "z": 2.7},
                    {"type": "down", "area": [[5.9, 0.5], [6.1, 0.5], [6.1, 1]], "spacing": 0.1, "z": 2}],
          "on": [{"type": "down", "fixture": "C", "spacing": 1, "z": 3.3}], )" +
      list + "}");
  const Scene scene = make_scene(test::read_text(store.dump()));
  EXPECT_THAT(
      sentences(scene.warnings),
      testing::ElementsAre(
          HasSubstr("areas[0]: has no candidates: no point of its grid is within both the area and the room"),
          HasSubstr("areas[1]: has no candidates: the point (2, 8, 2.7) is above the ceiling of zone 'low' "
                    "(2.7 m > 2.6 m); correct its place"),
          HasSubstr("areas[2]: has no candidates: the point (5.95, 0.55, 2) is within the inner wall 'W'"),
          HasSubstr(
              "on[0]: has no candidates: the point (1.99804, 2.72929, 3.3) is not in front of a face")));
}

TEST(MountPoints, RefuseFaultsWithTheirPlace) {
  struct Fault {
    std::string transceivers;
    const char* message;
  };
  for (
      const auto& [transceivers, message] : std::vector<Fault>{
          {R"({"areas": [{"type": "down", "area": "high", "spacing": 1, "z": 2}]})",
           "transceivers.areas[0].area: is neither 'room' nor 'room without zones' nor the id of a zone"},
          {R"({"areas": [{"type": "down", "area": "room", "spacing": 0.001, "z": 2}]})",
           "transceivers.areas[0].spacing: produces 80000000 candidates"},
          {R"({"areas": [{"type": "down", "area": [[-9e3, 0], [9e3, 0], [9e3, 9e3]], "spacing": 0.004, "z": 2}]})",
           "transceivers.areas[0].spacing: produces 5007002 candidates"},
          {R"({"rails": [{"type": "down", "id": "R", "points": [[1, 1, 2], [7, 1, 2]], "spacing": 0.001,
               "axes": )" +
               repeated("[0, 0, -1]", 200) + R"(}]})",
           "transceivers.rails[0].spacing: produces 1200200 candidates"},
          {R"({"areas": [{"type": "down", "area": "room", "spacing": 0.01, "z": 2, "axes": [[0, 0, 1], [0, 0, -1]]}]})",
           "transceivers.areas[0].spacing: produces 1600000 candidates"},
          {R"({"areas": [{"type": "down", "area": "room", "spacing": 1, "z": 2, "below_ceiling": 1}]})",
           "transceivers.areas[0].below_ceiling: has no effect beside 'z'"},
          {R"({"areas": [{"type": "down", "area": [[0, 0], [4, 4], [4, 0], [0, 4]], "spacing": 1, "z": 2}]})",
           "transceivers.areas[0].area: crosses or touches itself at (2, 2) m"},
          {R"({"rails": [{"type": "down", "id": "R", "points": [[1, 1, 2], [1, 1, 2]], "spacing": 1}]})",
           "transceivers.rails[0].points[1]: is the point before"},
          {R"({"rails": [{"type": "down", "id": "R", "points": [[1, 1, 2], [9, 1, 2]], "spacing": 1}]})",
           "transceivers.rails[0]: transceiver 'R-9' at (9, 1, 2) is outside the room"},
          {R"({"on": [{"type": "down", "fixture": "D", "z": 2, "spacing": 1}]})",
           "transceivers.on[0].fixture: names an unknown fixture"},
          {R"({"on": [{"type": "down", "wall": 6, "z": 2, "spacing": 1}]})", "transceivers.on[0].wall: is 6"},
          {R"({"on": [{"type": "down", "wall": 1, "face": "north", "z": 2, "spacing": 1}]})",
           "transceivers.on[0].face: has no effect beside 'wall'"},
          {R"({"on": [{"type": "down", "fixture": "C", "face": "up", "z": 2, "spacing": 1}]})",
           "transceivers.on[0].face: has the unknown value 'up'; known: north, east, south, west"},
          {R"({"on": )" +
               repeated(R"({"type": "down", "fixture": "C", "face": "east", "z": 2, "spacing": 1})", 2) + "}",
           "transceivers.on[1]: has candidates named after 'C-east'"},
          {R"({"areas": [{"type": "down", "area": "room", "spacing": 1, "below_ceiling": 4}]})",
           "transceivers.areas[0]: has no candidates: the point (0.5, 0.5, -0.8) is below the floor"},
          {R"({"on": [{"type": "down", "z": 2, "spacing": 1}]})", "transceivers.on[0]: must have one of"},
          {R"({"on": [{"type": "down", "wall": 1, "z": 2, "spacing": 1, "tilt_deg": []}]})",
           "transceivers.on[0].tilt_deg: is empty"},
          {R"({"on": [{"type": "down", "wall": 1, "z": 2, "spacing": 1, "tilt_deg": [0, 91]}]})",
           "transceivers.on[0].tilt_deg[1]: is 91"},
          {R"({"on": [{"type": "down", "wall": 1, "z": 2, "spacing": 0.001, "tilt_deg": )" +
               repeated("0", 300) + "}]}",
           "transceivers.on[0].spacing: produces 1200000 candidates"},
          {R"({"on": )" + repeated(R"({"type": "down", "fixture": "C", "z": 2, "spacing": 1})", 2) + "}",
           "transceivers.on[1]: has candidates named after 'C', like the candidates of store.json: "
           "transceivers.on[0]; give it an 'id'"},
          {R"({"rails": [{"type": "down", "id": "C", "points": [[1, 1, 2], [2, 1, 2]], "spacing": 1}],
               "on": [{"type": "down", "fixture": "C", "z": 2, "spacing": 1}]})",
           "transceivers.on[0]: has candidates named after 'C'"},
          {R"({"rails": )" +
               repeated(R"({"type": "down", "id": "R", "points": [[1, 1, 2], [2, 1, 2]], "spacing": 1})", 2) +
               "}",
           "transceivers.rails[1].id: is 'R'"},
          {R"({"keep_out": [{"polygon": [[0, 0], [1, 0], [1, 1]], "z": [3, 2]}]})",
           "transceivers.keep_out[0].z: has its second height below its first"}})
    test::expect_input_error([&, &json = transceivers] { units_of(json); }, std::string_view(message));
}

TEST(MountPoints, RefuseAFaceThatTheOutlineDoesNotHave) {
  const std::string square = R"({"type": "box", "id": "B", "at": [2, 1, 0], "size": [1, 1, 1],
    "material": "white", "rotation_deg": )";
  for (const char* face : {"north", "east", "south", "west"}) {
    const std::string member =
        std::string(R"({"type": "down", "fixture": "B", "spacing": 1, "z": 0.5, "face": ")") + face + "\"}";
    test::expect_input_error([&] { units_on(member, square + "45}"); },
                             "transceivers.on[0].face: is " + std::string(face) +
                                 ", but all faces of 'B' look 45 degrees or more away from it; name another");
    EXPECT_EQ(units_on(member, square + "44.9}").size(), 2u) << "negative control";
  }
}

// Candidates count before they are allocated.
TEST(MountPoints, CountInTheMemoryOfTheScene) {
  const auto refused = [](const std::string& transceivers, std::string_view where) {
    constexpr std::size_t memory = 100'000'000;
    const Store store = parse_store(l_shaped_store(transceivers).dump(), "store.json", {}, {false, memory});
    test::expect_input_error([&] { make_scene(store); }, where,
                             std::string_view("the store up to here requires about 0."));
  };
  refused(R"({"areas": [{"type": "down", "area": "room", "spacing": 0.02, "z": 2}]})",
          "transceivers.areas[0]");
  refused(R"({"rails": [{"type": "down", "id": "R", "points": [[1, 1, 2], [7, 1, 2]], "spacing": 0.001,
                         "axes": )" +
              repeated("[0, 0, -1]", 20) + "}]}",
          "transceivers.rails[0]");
  std::string mounts;
  for (int k = 0; k < 80; ++k)
    mounts += (k == 0 ? R"([{"id": ")" : R"(, {"id": ")") + std::to_string(k) +
              R"(", "type": "down", "fixture": "C", "z": 2, "spacing": 0.001})";
  refused(R"({"on": )" + mounts + "]}", "transceivers.on[");
}

}  // namespace
}  // namespace shelfbeam
