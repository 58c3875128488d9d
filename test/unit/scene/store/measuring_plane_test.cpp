#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/scene/states/store_states.hpp"

#include "support/expect_input_error.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

using test::Json;

// The sample, a box of 8 x 6 x 3 m, with measuring planes only.
Json store_with_planes(const std::string& planes) {
  Json store = test::sample_store();
  store["fixtures"] = Json::array();
  store["labels"] = Json::array();
  store["measuring_planes"] = Json::parse(planes);
  return store;
}

std::vector<Label> labels_of(const std::string& planes) {
  return test::scene_of(store_with_planes(planes)).labels;
}

const std::string horizontal = R"([{"id": "P", "type": "small", "origin": [1, 1, 0.8],
  "axes": [[2, 0, 0], [0, 1, 0]], "size": [3, 2], "spacing": 1}])";

TEST(MeasuringPlane, HasAReceiverInTheMiddleOfEachCell) {
  const auto labels = labels_of(horizontal);
  ASSERT_EQ(labels.size(), 6u);
  std::string ids;
  for (const Label& label : labels) {
    ids += label.id + " ";
    EXPECT_EQ(label.normal, (Vec3{0, 0, 1})) << "x crossed with y";
  }
  EXPECT_EQ(ids, "P-1-1 P-1-2 P-1-3 P-2-1 P-2-2 P-2-3 ");
  EXPECT_EQ(labels[0].position, (Vec3{1.5, 1.5, 0.8}));
  EXPECT_EQ(labels[1].position, (Vec3{2.5, 1.5, 0.8}));
  EXPECT_EQ(labels[5].position, (Vec3{3.5, 2.5, 0.8}));
}

TEST(MeasuringPlane, MayStandAndTiltAndHaveCountsAndANormal) {
  const auto standing = labels_of(R"([{"id": "P", "type": "small", "origin": [4, 1, 0.5],
    "axes": [[0, 1, 0], [0, 0, 1]], "size": [4, 2], "counts": [2, 4]}])");
  ASSERT_EQ(standing.size(), 8u);
  EXPECT_EQ(standing[0].position, (Vec3{4, 2, 0.75}));
  EXPECT_EQ(standing[1].position, (Vec3{4, 4, 0.75}));
  EXPECT_EQ(standing[0].normal, (Vec3{1, 0, 0}));
  const auto tilted = labels_of(R"([{"id": "P", "type": "small", "origin": [4, 1, 0.5], "normal": [0, 0, 3],
    "axes": [[1, 0, 0], [0, 0.8, 0.6]], "size": [1, 1], "counts": [1, 1]}])");
  ASSERT_EQ(tilted.size(), 1u);
  EXPECT_NEAR(length(tilted[0].position - Vec3{4.5, 1.4, 0.8}), 0, 1e-12);
  EXPECT_EQ(tilted[0].normal, (Vec3{0, 0, 1}));
}

TEST(MeasuringPlane, ComesAfterOtherLabelsAndIsListedInTheResolvedStore) {
  Json json = test::sample_store();
  const std::size_t others = test::scene_of(json).labels.size();
  json["measuring_planes"] = Json::parse(horizontal);
  const Store store = test::read_text(json.dump());
  DeviceSources sources;
  const Scene scene = make_scene(store, &sources);
  ASSERT_EQ(scene.labels.size(), others + 6);
  EXPECT_EQ(scene.labels[others].id, "P-1-1");
  EXPECT_EQ(sources.labels.back(), "store.json: measuring_planes[0]");
  const std::string text = resolved_store_json(store, scene);
  const Json resolved = Json::parse(text);
  EXPECT_FALSE(resolved.contains("measuring_planes"));
  EXPECT_EQ(resolved["labels"].back()["id"], "P-2-3");
  const Store again = test::read_text(text);
  const Scene same = make_scene(again);
  EXPECT_EQ(same.store_hash, scene.store_hash);
  EXPECT_TRUE(scene.labels.back().is_receiver);
  EXPECT_TRUE(same.labels.back().is_receiver);
  EXPECT_FALSE(same.labels.front().is_receiver);
}

TEST(MeasuringPlane, HasReceiversThatAreAtNoFixture) {
  Json json = test::sample_store();
  const Scene others = make_scene(test::read_text(json.dump()));
  const Vec3 label = others.labels.front().position;
  Json plane = Json::parse(horizontal);
  plane[0].update({{"origin", {label.x, label.y, label.z}}, {"size", {0.02, 0.02}}});
  json["measuring_planes"] = plane;
  const Store store = test::read_text(json.dump());
  const Scene scene = make_scene(store);
  const Scene again = make_scene(test::read_text(resolved_store_json(store, scene)));
  EXPECT_TRUE(others.labels.front().place.is_known());
  for (const Scene* one : {&scene, &again}) EXPECT_FALSE(one->labels.back().place.is_known());
}

TEST(MeasuringPlane, HasItsReceiversOnceInAState) {
  Json json = store_with_planes(horizontal);
  json["variation"] = Json::parse(R"({"label_sensitivity_db": 1})");
  const Store store = test::read_text(json.dump());
  const Scene scene = make_scene(store);
  const Scene state = make_scene(StoreStates(store, scene, 1).state(0));
  ASSERT_EQ(state.labels.size(), 6u);
  EXPECT_EQ(state.labels[5].position, scene.labels[5].position);
  EXPECT_NE(state.labels[5].relative_sensitivity, 1) << "the state has its own";
}

TEST(MeasuringPlane, IsRefusedWithItsPlace) {
  struct Fault {
    std::string_view replaced, by, message;
  };
  for (const auto& [replaced, by, message] : std::vector<Fault>{
           {"[0, 1, 0]", "[1, 1, 0]",
            "measuring_planes[0].axes: are not perpendicular to each other; correct one of the two"},
           {"[[2, 0, 0], [0, 1, 0]]", "[[2, 0, 0]]", "measuring_planes[0].axes: has 1 directions"},
           {R"("spacing": 1)", R"("spacing": 1, "counts": [2, 2])", "measuring_planes[0]: "},
           {R"(, "spacing": 1)", "", "measuring_planes[0]: must have one of"},
           {R"("spacing": 1)", R"("spacing": 0.001)",
            "measuring_planes[0].spacing: produces more than 1,000,000 receivers; use a wider spacing"},
           {R"("spacing": 1)", R"("counts": [1001, 1000])",
            "measuring_planes[0].counts: produces more than 1,000,000 receivers"},
           {R"("spacing": 1)", R"("counts": [0, 3])", "measuring_planes[0].counts[0]: is 0"},
           {R"("type": "small")", R"("type": "tiny")", "measuring_planes[0].type: "},
           {"[1, 1, 0.8]", "[6, 1, 0.8]", "measuring_planes[0]: label 'P-1-3' at (8.5, 1.5, 0.8) is outside"},
           {"}]", R"(}, {"id": "P", "type": "small", "origin": [1, 1, 2], "axes": [[1, 0, 0], [0, 1, 0]],
                        "size": [1, 1], "spacing": 1}])",
            "measuring_planes[1]: has the duplicate label id 'P-1-1'"}}) {
    std::string planes = horizontal;
    planes.replace(planes.find(replaced), replaced.size(), by);
    test::expect_input_error([&] { labels_of(planes); }, message);
  }
}

// Receivers count before they are allocated.
TEST(MeasuringPlane, CountsInTheMemoryOfTheScene) {
  std::string planes = horizontal;
  planes.replace(planes.find(R"("spacing": 1)"), 12, R"("counts": [1000, 1000])");
  constexpr std::size_t memory = 100'000'000;
  const Store store = parse_store(store_with_planes(planes).dump(), "store.json", {}, {false, memory});
  test::expect_input_error([&] { make_scene(store); }, std::string_view("measuring_planes[0]"),
                           std::string_view("the store up to here requires about "));
}

}  // namespace
}  // namespace shelfbeam
