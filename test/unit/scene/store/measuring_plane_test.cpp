#include "shelfbeam/scene/states/store_states.hpp"

#include "support/testing.hpp"
#include "unit/scene/same_scene.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {
namespace {

const Json horizontal = R"([{"id": "P", "type": "small", "origin": [1, 1, 0.8],
  "axes": [[2, 0, 0], [0, 1, 0]], "size": [3, 2], "spacing": 1}])"_json;

// The sample, a box of 8 x 6 x 3 m, with measuring planes only.
Json store_with_planes(const Json& planes = horizontal) {
  Json store = sample_store();
  store["fixtures"] = Json::array();
  store["labels"] = Json::array();
  store["measuring_planes"] = planes;
  return store;
}

std::vector<Label> labels_of(const Json& planes = horizontal) {
  return scene_of(store_with_planes(planes)).labels;
}

TEST(MeasuringPlane, HasAReceiverInTheMiddleOfEachCell) {
  const auto labels = labels_of();
  ASSERT_EQ(ids_of(labels), "P-1-1 P-1-2 P-1-3 P-2-1 P-2-2 P-2-3 ");
  for (const Label& label : labels) EXPECT_EQ(label.normal, (Vec3{0, 0, 1})) << "x crossed with y";
  EXPECT_EQ(labels[0].position, (Vec3{1.5, 1.5, 0.8}));
  EXPECT_EQ(labels[1].position, (Vec3{2.5, 1.5, 0.8}));
  EXPECT_EQ(labels[5].position, (Vec3{3.5, 2.5, 0.8}));
}

TEST(MeasuringPlane, MayStandAndTiltAndHaveCountsAndANormal) {
  const auto standing = labels_of(R"([{"id": "P", "type": "small", "origin": [4, 1, 0.5],
    "axes": [[0, 1, 0], [0, 0, 1]], "size": [4, 2], "counts": [2, 4]}])"_json);
  ASSERT_EQ(standing.size(), 8u);
  EXPECT_EQ(standing[0].position, (Vec3{4, 2, 0.75}));
  EXPECT_EQ(standing[1].position, (Vec3{4, 4, 0.75}));
  EXPECT_EQ(standing[0].normal, (Vec3{1, 0, 0}));
  const auto tilted = labels_of(R"([{"id": "P", "type": "small", "origin": [4, 1, 0.5], "normal": [0, 0, 3],
    "axes": [[1, 0, 0], [0, 0.8, 0.6]], "size": [1, 1], "counts": [1, 1]}])"_json);
  ASSERT_EQ(tilted.size(), 1u);
  EXPECT_NEAR(length(tilted[0].position - Vec3{4.5, 1.4, 0.8}), 0, 1e-12);
  EXPECT_EQ(tilted[0].normal, (Vec3{0, 0, 1}));
}

TEST(MeasuringPlane, ComesAfterOtherLabelsAndIsListedInTheResolvedStore) {
  Json json = sample_store();
  const std::size_t others = scene_of(json).labels.size();
  json["measuring_planes"] = horizontal;
  const Store store = read(json);
  DeviceSources sources;
  const Scene scene = make_scene(store, &sources);
  ASSERT_EQ(scene.labels.size(), others + 6);
  EXPECT_EQ(scene.labels[others].id, "P-1-1");
  EXPECT_EQ(sources.labels.back(), "store.json: measuring_planes[0]");
  const Json resolved = Json::parse(expect_same_scene(store));
  EXPECT_FALSE(resolved.contains("measuring_planes"));
  EXPECT_EQ(resolved["labels"].back()["id"], "P-2-3");
  const Scene same = scene_of(resolved);
  EXPECT_TRUE(scene.labels.back().is_receiver);
  EXPECT_TRUE(same.labels.back().is_receiver);
  EXPECT_FALSE(same.labels.front().is_receiver);
}

TEST(MeasuringPlane, HasReceiversThatAreAtNoFixture) {
  Json json = sample_store();
  const Scene others = scene_of(json);
  const Vec3 label = others.labels.front().position;
  json["measuring_planes"] = horizontal;
  json["measuring_planes"][0].update({{"origin", {label.x, label.y, label.z}}, {"size", {0.02, 0.02}}});
  const Store store = read(json);
  const Scene scene = make_scene(store);
  const Scene again = make_scene(read_text(resolved_store_json(store, scene)));
  EXPECT_TRUE(others.labels.front().place.is_known());
  for (const Scene* one : {&scene, &again}) EXPECT_FALSE(one->labels.back().place.is_known());
}

TEST(MeasuringPlane, HasItsReceiversOnceInAState) {
  Json json = store_with_planes();
  json["variation"] = R"({"label_sensitivity_db": 1})"_json;
  const Store store = read(json);
  const Scene scene = make_scene(store);
  const Scene state = make_scene(StoreStates(store, scene, 1).state(0));
  ASSERT_EQ(state.labels.size(), 6u);
  EXPECT_EQ(state.labels[5].position, scene.labels[5].position);
  EXPECT_NE(state.labels[5].relative_sensitivity, 1) << "the state has its own";
}

// Receivers count before they are allocated.
TEST(MeasuringPlane, CountsInTheMemoryOfTheScene) {
  Json json = store_with_planes();
  json["measuring_planes"][0]["spacing"] = 0.0025;
  constexpr std::size_t memory = 100'000'000;
  const Store store = parse_store(json.dump(), "store.json", {}, {false, memory});
  expect_input_error([&] { make_scene(store); }, "measuring_planes[0]",
                     "the store up to here requires about ");
}

}  // namespace
}  // namespace shelfbeam::test
