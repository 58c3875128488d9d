#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/store/completed_fixture.hpp"

#include "support/processor_time.hpp"
#include "support/testing.hpp"
#include "unit/scene/store/list_store.hpp"

namespace shelfbeam::test {
namespace {

TEST(Presets, AreCompletedFromCataloguesAndOtherPresets) {
  TempFolder folder;
  folder.write("chain.json", R"({ "materials": { "red": { "type": "lambertian", "reflectance": 0.3 } },
    "presets": { "base": { "type": "gondola", "depth": 0.9, "height": 1.8, "material": "red", "shelves": [0.4, 0.9],
                           "labels": { "type": "small", "spacing": 0.5 } },
                 "run": { "preset": "base", "length": 1.33, "labels": { "spacing": 0.33 } } } })");
  Json store = store_with(R"([{"preset": "run", "id": "A", "at": [2, 3], "height": 1.6}])"_json);
  store["catalogues"] = {"chain.json"};
  Json plain = store_with(shelves(R"({"id": "A", "at": [2, 3], "height": 1.6, "material": "red",
    "faces": null, "labels": {"spacing": 0.33}})"_json));
  plain["materials"]["red"] = {{"type", "lambertian"}, {"reflectance", 0.3}};
  EXPECT_EQ(fixtures_of(read(store, folder.path())), fixtures_of(read(plain)));
  EXPECT_EQ(scene_of(store, folder.path()).labels.size(), scene_of(plain).labels.size());
}

// A chain in millimetres, a shop in metres.
TEST(Presets, HaveTheUnitOfTheirFile) {
  TempFolder folder;
  folder.write("chain.json", R"({ "units": "mm", "presets": { "run": {
    "type": "gondola", "length": 1330, "depth": 900, "height": 1800, "material": "steel", "shelves": [400, 900],
    "faces": ["front"], "labels": {"type": "small", "spacing": 500} } } })");
  Json store = store_with(R"([{"preset": "run", "id": "A{n}", "at": [2, 3], "height": 1.6,
                               "repeat": {"count": 2, "step": 1.33}}])"_json);
  store["catalogues"] = {"chain.json"};
  const auto written = [](double height) {
    return fixtures_of(read(store_with(shelves(
        {{"id", "A{n}"}, {"at", {2, 3}}, {"height", height}, {"repeat", {{"count", 2}, {"step", 1.33}}}}))));
  };
  EXPECT_EQ(fixtures_of(read(store, folder.path())), written(1.6));
  EXPECT_NE(fixtures_of(read(store, folder.path())), written(1.8));
}

TEST(Presets, AlternativesAndNullRemoveKeys) {
  Json store =
      store_with(R"([{"preset": "run", "id": "A", "at": [2, 3], "doors": null, "labels": {"count": 2}},
                              {"preset": "block", "id": "B", "at": [8, 8, 0], "size": [1, 1, 1]},
                              {"preset": "run", "id": "C", "at": [20, 3], "labels": null}])"_json);
  store["presets"]["run"] = shelves({{"doors", "door"}});
  store["presets"]["block"] =
      R"({"type": "box", "material": "steel", "min": [1, 1, 0], "max": [2, 2, 1]})"_json;
  const Store complete = read(store);
  const auto& shelves = std::get<Gondola>(complete.fixtures[0].value);
  EXPECT_FALSE(shelves.doors);
  EXPECT_EQ(shelves.labels->count, 2);
  EXPECT_EQ(shelves.labels->spacing, 0);
  EXPECT_EQ(std::get<Box>(complete.fixtures[1].value).max, (Vec3{9, 9, 1}));
  EXPECT_FALSE(std::get<Gondola>(complete.fixtures[2].value).labels);
}

// Each fixture has a copy of the values of its preset.
TEST(Presets, LimitsTheValuesOfAllFixtures) {
  Json store = store_with(Json::array());
  store["presets"]["long"] = shelves();
  store["presets"]["long"]["labels"] = {{"type", "small"}, {"positions", std::vector<double>(1000, 0.5)}};
  store["presets"]["longer"] = {{"preset", "long"}, {"rotation_deg", 90}};
  for (int k = 0; k < 5000; ++k)
    store["fixtures"].push_back({{"preset", "longer"}, {"id", std::to_string(k)}, {"at", {1, 1}}});
  const ProcessorTime time;
  expect_input_error([&] { read(store); },
                     "].preset: takes more than 5,000,000 values from presets, together with");
  EXPECT_LT(time.seconds(), 1);
}

// Objects with many keys are searched with a table.
TEST(Presets, RemoveAndReplaceSomeOfManyKeys) {
  Json store = store_with(R"([{"preset": "above", "id": "A"}])"_json);
  Json& presets = store["presets"];
  presets["below"] = R"({"type": "mesh", "at": [1, 1, 0], "file": "a.obj", "materials": {}})"_json;
  presets["above"] = R"({"preset": "below", "materials": {}})"_json;
  Json expected;
  for (int k = 0; k < 200; ++k) {
    const std::string key = std::to_string(k);
    presets["below"]["materials"][key] = "steel";
    if (k % 2 == 0) presets["above"]["materials"][key] = k % 4 == 0 ? Json() : Json("wood");
    if (k % 4 != 0) expected[key] = k % 2 == 0 ? "wood" : "steel";
  }
  expected["new"] = presets["above"]["materials"]["new"] = "glass";
  const JsonCursor document = JsonCursor::parse(store.dump(), "store.json");
  EXPECT_EQ(completed_fixture(document, {}, 0).whole.json["materials"], expected);
  presets["above"]["materials"]["none"] = nullptr;
  expect_input_error([&] { completed_fixture(JsonCursor::parse(store.dump(), "store.json"), {}, 0); },
                     "removes a key that no preset of the fixture has");
}

TEST(Presets, RefusesLongChainsOfPresets) {
  Json store = store_with(R"([{"preset": "0", "id": "A"}])"_json);
  for (int k = 0; k < 200; ++k) store["presets"][std::to_string(k)] = {{"preset", std::to_string(k + 1)}};
  expect_input_error([&] { read(store); }, "presets.99.preset: is the end of a chain of 100 presets");
}

}  // namespace
}  // namespace shelfbeam::test
