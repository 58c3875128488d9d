#include "support/testing.hpp"
#include "unit/scene/sample_store.hpp"
#include "unit/scene/shelving.hpp"

namespace shelfbeam::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

Json label(const std::string& id, const std::vector<double>& position, const std::vector<double>& normal) {
  return {{"id", id}, {"position", position}, {"normal", normal}, {"type", "large"}};
}

std::vector<std::string> warnings_with(const Json& listed) {
  Json store = sample_store();
  store["labels"].push_back(listed);
  return warnings_of(store);
}

TEST(Misplaced, DevicesInsideFixtures) {
  Json store = changed_store("/labels/0/position", "[7.2, 0.2, 1]");
  store["transceivers"]["list"][1]["position"] = {7.3, 0.3, 2.9};
  EXPECT_THAT(warnings_of(store),
              ElementsAre(StartsWith("store.json: labels[0]: label 'L1' is inside fixture 'C'"),
                          StartsWith("store.json: transceivers.list[1]: transceiver 'T2' is inside")));
  // Points on the surface and above it are not inside; the hull of a mesh does not count either.
  for (const char* place : {"[7, 0.2, 1]", "[6.2, 4.2, 0.6]"})
    EXPECT_TRUE(scene_of(changed_store("/labels/0/position", place)).warnings.empty()) << place;
}

// The room is 8 x 6 x 3 m. A disc of 0.3 m whose axis is tilted by asin 0.6 extends upwards by 0.6 of its
// radius.
TEST(Misplaced, DiscsAndLabelsThatReachOutsideTheRoom) {
  const auto warnings = [](double z, double label_x) {
    Json store = sample_store();
    store["label_types"]["large"]["size"] = {0.4, 0.2};
    store["labels"] = Json::array({label("W", {label_x, 0.5, 1}, {0, 1, 0})});
    store["transceiver_types"]["wide"] = {{"emission", {{"type", "isotropic"}, {"intensity", 1}}},
                                          {"radius", 0.3}};
    store["transceivers"]["list"].push_back(
        {{"id", "D"}, {"position", {4, 3, z}}, {"axis", {0.6, 0, -0.8}}, {"type", "wide"}});
    return warnings_of(store);
  };
  EXPECT_TRUE(warnings(2.8199, 0.2001).empty());
  EXPECT_THAT(warnings(2.83, 0.15),
              ElementsAre(AllOf(StartsWith("store.json: labels[0]: label 'W' "), HasSubstr("x0 (-0.05 m")),
                          AllOf(StartsWith("store.json: transceivers.list[2]: "), HasSubstr("'D'"),
                                HasSubstr("ceiling (3.01 m"))));
}

TEST(Misplaced, GeneratedLabelsNameTheirFixture) {
  Json store = freezer_store();
  store["fixtures"].push_back(
      R"({ "type": "box", "id": "C", "min": [2, 0.5, 0], "max": [2.3, 0.999, 2], "material": "m" })"_json);
  store["transceivers"]["list"][0]["position"] = {3, 1, 0.5};
  EXPECT_THAT(warnings_of(store),
              ElementsAre(StartsWith("store.json: fixtures[0]: label 'F-front-1-1' is inside fixture 'C'")));
}

// The column C reaches from (7, 0, 0) to (7.5, 0.5, 3).
TEST(Misplaced, LabelThatLooksAtAFixture) {
  EXPECT_THAT(warnings_with(label("W", {6.99, 0.2, 1}, {1, 0, 0})),
              ElementsAre(StartsWith("store.json: labels[1]: label 'W' faces fixture 'C', 1 cm")));
  const struct {
    std::vector<double> position, normal;
    bool warned;
  } all[] = {
      {{6.99, 0.2, 1}, {-1, 0, 0}, false},  // faces away
      {{6.96, 0.2, 1}, {1, 0, 0}, true},    // 4 cm
      {{6.94, 0.2, 1}, {1, 0, 0}, false},   // 6 cm
      {{6.99, 0.2, 1}, {1, 0, 1}, true},    // tilted, 1.4 cm
      {{6.99, 0.2, 1}, {1, 0, 10}, false},  // nearly along the surface, 10 cm
      {{6.99, 0.2, 1}, {0, 0, 1}, false},   // along it
      {{7, 0.2, 1}, {1, 0, 0}, true},       // on the surface, facing inwards
      {{7, 0.2, 1}, {-1, 0, 0}, false},     // on the surface, facing outwards
      {{6.99, 0.52, 1}, {1, 0, 0}, false},  // beside it
      {{7.2, 0.51, 1}, {0, -1, 0}, true},   // from another side
  };
  for (const auto& [position, normal, warned] : all)
    EXPECT_EQ(warnings_with(label("W", position, normal)).size(), warned ? 1u : 0u)
        << testing::PrintToString(position) << testing::PrintToString(normal);
}

TEST(Misplaced, LabelThatLooksIntoItsShelf) {
  Json store = gondola_store();
  store["transceivers"]["list"][0]["position"] = {2.5, 1.2, 1.79};
  store["transceivers"]["list"][0]["axis"] = {0, -1, 0};
  // The third board of the front has its edge at y = 1 from z = 1.48 to 1.52.
  store["labels"][0] = {
      {"id", "turned"}, {"position", {3, 0.98, 1.5}}, {"normal", {0, 1, 0.1}}, {"type", "l"}};
  for (const double rotation : {0.0, 1e-9}) {
    store["fixtures"][0]["rotation_deg"] = rotation;
    EXPECT_THAT(warnings_of(store),
                ElementsAre(StartsWith("store.json: labels[0]: label 'turned' faces fixture 'A', 2 cm")));
  }
}

TEST(Misplaced, LabelsOfFixturesLookOutwardsWhateverTheirTilt) {
  for (const double tilt : {-89.0, -60.0, -20.0, 0.0, 20.0, 60.0, 89.0})
    for (const double rotation : {0.0, 33.3, 90.0, -77.7})
      for (Json store : {gondola_store(), freezer_store()}) {
        store["fixtures"][0].merge_patch({{"labels", {{"tilt_deg", tilt}}},
                                          {"rotation_deg", rotation},
                                          {"stocking", 1},
                                          {"at", {10, 10}}});
        store["room"] = R"({"size": [20, 20, 4], "floor": "m", "ceiling": "m", "walls": "m"})"_json;
        store["labels"][0]["position"] = {1, 1, 1};
        store["transceivers"]["list"][0]["position"] = {1, 1, 3};
        EXPECT_TRUE(scene_of(store).warnings.empty()) << tilt << ' ' << rotation;
      }
}

TEST(Misplaced, LabelThatLooksAtAWall) {
  EXPECT_THAT(warnings_with(label("W", {0.01, 3, 1}, {-1, 0, 0})),
              ElementsAre(StartsWith("store.json: labels[1]: label 'W' faces the wall x0, 1 cm")));
  EXPECT_TRUE(warnings_with(label("W", {0.01, 3, 1}, {1, 0, 0})).empty());
  EXPECT_TRUE(warnings_with(label("W", {0, 3, 1}, {1, 0, 0})).empty());
  EXPECT_THAT(warnings_with(label("W", {1, 3, 2.98}, {0, 0, 1})),
              ElementsAre(HasSubstr("the ceiling, 2 cm")));
}

TEST(Misplaced, ManyOfAKindAreCounted) {
  Json store = sample_store();
  for (int k = 0; k < 128; ++k) {
    store["labels"].push_back(label("in " + std::to_string(k), {7.2, 0.2, 1 + k / 100.0}, {-1, 0, 0}));
    store["labels"].push_back(label("at " + std::to_string(k), {6.99, 0.2, 1 + k / 100.0}, {1, 0, 0}));
  }
  const auto warnings = warnings_of(store);
  ASSERT_EQ(warnings.size(), 12u);
  EXPECT_NE(warnings[4].find("'in 4'"), std::string::npos);
  EXPECT_EQ(warnings[5], "and 123 more labels inside a fixture");
  EXPECT_NE(warnings[6].find("'at 0'"), std::string::npos);
  EXPECT_EQ(warnings[11], "and 123 more labels that face a surface right in front of them");
}

// The column C reaches from (7, 0, 0) to (7.5, 0.5, 3).
TEST(Misplaced, BodiesInsideFixtures) {
  Json store = sample_store();
  store["label_types"]["large"]["size"] = {0.4, 0.2};
  store["transceiver_types"]["wide"]["radius"] = 0.3;
  const auto warnings = [&](const std::vector<double>& position, const std::vector<double>& normal,
                            const std::vector<double>& unit) {
    Json changed = store;
    changed["fixtures"][1].erase("labels");
    changed["labels"] = Json::array({label("W", position, normal)});
    changed["transceivers"]["list"] = {{{"id", "U"}, {"position", unit}, {"type", "wide"}}};
    changed["transceivers"].erase("installed");
    return warnings_of(changed);
  };
  // Upright and 1 cm from the column, and a disc flush with the ceiling, both as near to a side as possible.
  EXPECT_EQ(warnings({6.99, 0.3, 1}, {-1, 0, 0}, {7.2, 0.81, 3}), std::vector<std::string>{});
  EXPECT_THAT(warnings({6.99, 0.3, 1}, {-1, 0, 0.3}, {7.2, 0.79, 2.9}),
              ElementsAre(StartsWith("store.json: labels[0]: part of label 'W' is inside fixture 'C'"),
                          StartsWith("store.json: transceivers.list[0]: part of transceiver 'U' is inside")));
}

TEST(Misplaced, WithoutARoomUnitsOutsideOfAllSurfaces) {
  Json store = gondola_store();
  EXPECT_THAT(warnings_of(store),
              ElementsAre(AllOf(StartsWith("store.json: transceivers.list[0]: transceiver 'T' at (0, 0, 3) "),
                                HasSubstr("from (2, 1, 0) to (5.2, 1.9, 1.8)"))));
  store["transceivers"]["list"][0]["position"] = {3, 1.02, 1.79};
  EXPECT_TRUE(scene_of(store).warnings.empty());
}

}  // namespace
}  // namespace shelfbeam::test
