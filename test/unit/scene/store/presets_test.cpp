#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/store/completed_fixture.hpp"

#include "support/expect_input_error.hpp"
#include "support/processor_time.hpp"
#include "support/temp_folder.hpp"
#include "unit/scene/store/list_store.hpp"

namespace shelfbeam {
namespace {

using test::fixtures_of;
using test::Json;
using test::read;
using test::run_of_shelves;
using test::store_with;
using test::TempFolder;

TEST(Presets, AreCompletedFromCataloguesAndOtherPresets) {
  TempFolder folder;
  folder.write("chain.json", R"({ "materials": { "red": { "type": "lambertian", "reflectance": 0.3 } },
    "presets": { "base": { "type": "gondola", "depth": 0.9, "height": 1.8, "material": "red", "shelves": [0.4, 0.9],
                           "labels": { "type": "small", "spacing": 0.5 } },
                 "run": { "preset": "base", "length": 1.33, "labels": { "spacing": 0.33 } } } })");
  Json store = store_with(R"([{"preset": "run", "id": "A", "at": [2, 3], "height": 1.6}])");
  store["catalogues"] = {"chain.json"};
  const Json written =
      store_with(R"([{"type": "gondola", "id": "A", "at": [2, 3], "length": 1.33, "depth": 0.9,
    "height": 1.6, "material": "red", "shelves": [0.4, 0.9], "labels": {"type": "small", "spacing": 0.33}}])");
  Json plain = written;
  plain["materials"]["red"] = {{"type", "lambertian"}, {"reflectance", 0.3}};
  EXPECT_EQ(fixtures_of(read(store, folder.path())), fixtures_of(read(plain)));
  EXPECT_EQ(make_scene(read(store, folder.path())).labels.size(), make_scene(read(plain)).labels.size());
}

// A chain in millimetres, a shop in metres.
TEST(Presets, HaveTheUnitOfTheirFile) {
  TempFolder folder;
  folder.write("chain.json", R"({ "units": "mm", "presets": { "run": {
    "type": "gondola", "length": 1330, "depth": 900, "height": 1800, "material": "steel", "shelves": [400, 900],
    "faces": ["front"], "labels": {"type": "small", "spacing": 500} } } })");
  Json store = store_with(R"([{"preset": "run", "id": "A{n}", "at": [2, 3], "height": 1.6,
                               "repeat": {"count": 2, "step": 1.33}}])");
  store["catalogues"] = {"chain.json"};
  const std::string base = run_of_shelves;
  const Json written =
      store_with("[{" + base + R"(, "id": "A{n}", "at": [2, 3], "repeat": {"count": 2, "step": 1.33}}])");
  Json lower = written;
  lower["fixtures"][0]["height"] = 1.6;
  EXPECT_EQ(fixtures_of(read(store, folder.path())), fixtures_of(read(lower)));
  EXPECT_NE(fixtures_of(read(store, folder.path())), fixtures_of(read(written)));
}

TEST(Presets, AlternativesAndNullRemoveKeys) {
  Json store =
      store_with(R"([{"preset": "run", "id": "A", "at": [2, 3], "doors": null, "labels": {"count": 2}},
                              {"preset": "block", "id": "B", "at": [8, 8, 0], "size": [1, 1, 1]},
                              {"preset": "run", "id": "C", "at": [20, 3], "labels": null}])");
  store["presets"]["run"] = Json::parse("{" + std::string(run_of_shelves) + R"(, "doors": "door"})");
  store["presets"]["block"] =
      Json::parse(R"({"type": "box", "material": "steel", "min": [1, 1, 0], "max": [2, 2, 1]})");
  const Store complete = read(store);
  const auto& shelves = std::get<Gondola>(complete.fixtures[0].value);
  EXPECT_FALSE(shelves.doors);
  EXPECT_EQ(shelves.labels->count, 2);
  EXPECT_EQ(shelves.labels->spacing, 0);
  EXPECT_EQ(std::get<Box>(complete.fixtures[1].value).max, (Vec3{9, 9, 1}));
  EXPECT_FALSE(std::get<Gondola>(complete.fixtures[2].value).labels);

  store["fixtures"][0]["goods"] = nullptr;
  test::expect_input_error(
      [&] { read(store); },
      std::string_view("fixtures[0].goods: removes a key that no preset of the fixture has"));
}

TEST(Presets, RefusesFaultsOfPresetsThatNoFixtureUses) {
  for (const auto& [presets, message] : std::vector<std::pair<const char*, const char*>>{
           {R"({"a": {"preset": "a"}})", "store.json: presets.a.preset: refers to itself: a -> a"},
           {R"({"a": {"preset": "b"}, "b": {"preset": "c"}, "c": {"preset": "b"}})",
            "store.json: presets.c.preset: refers to itself: a -> b -> c -> b"},
           {R"({"run": {"preset": "rum"}})", "presets.run.preset: names the unknown preset 'rum'"},
           {R"({"a": {"lenght": 3}})", "presets.a: has the unknown key 'lenght'; did you mean 'length'?"}}) {
    Json store = store_with("[]");
    store["presets"] = Json::parse(presets);
    test::expect_input_error([&] { read(store); }, std::string_view(message));
  }
}

// A fault of a preset is found where a fixture uses it. The message names both.
TEST(Presets, NamesThePresetThatHasTheFault) {
  TempFolder folder;
  for (const auto& [base, message] : std::vector<std::pair<const char*, std::string>>{
           {R"("height": -1)", "store.json: fixtures[0].height (preset 'base' of FILE): is -1"},
           {R"("height": 1.8, "shelves": [0.4, 2])",
            "store.json: fixtures[0].shelves[1] (preset 'base' of FILE): is at 2 m"},
           {R"("height": 1.8, "shelves": [0.4], "labels": {"type": "small", "spacing": 0})",
            "store.json: fixtures[0].labels.spacing (preset 'base' of FILE): is 0"},
           {R"("height": 1.8, "radius": 1)",
            "store.json: fixtures[0] (preset 'base' of FILE): has the unknown key 'radius'"},
           {R"("height": 1.8, "shelves": [0.4], "labels": {"type": "small", "count": 2})",
            "store.json: fixtures[0].depth (preset 'run'): is 0.05 m, below 0.1 m"},
           {R"("height": 1.8)", "store.json: fixtures[0] (preset 'run'): is missing the key 'shelves'"}}) {
    const auto file = folder.write("chain.json", std::string(R"({"presets": {"base": {"type": "gondola",
      "material": "steel", )") + base + "}}}");
    Json store = store_with(R"([{"preset": "run", "id": "A", "at": [2, 3], "length": 2}])");
    store["catalogues"] = {"chain.json"};
    store["presets"] = {{"run",
                         {{"preset", "base"},
                          {"depth", message.find("depth") == std::string::npos ? 0.5 : 0.05},
                          {"length", 1}}}};
    std::string expected = message;
    if (const auto at = expected.find("FILE"); at != std::string::npos)
      expected.replace(at, 4, file.string());
    test::expect_input_error([&] { read(store, folder.path()); }, std::string_view(expected));
  }
}

// Each fixture has a copy of the values of its preset.
TEST(Presets, LimitsTheValuesOfAllFixtures) {
  Json store = store_with("[]");
  store["presets"]["long"] = Json::parse(std::string("{") + run_of_shelves + "}");
  store["presets"]["long"]["labels"] = {{"type", "small"}, {"positions", std::vector<double>(1000, 0.5)}};
  store["presets"]["longer"] = {{"preset", "long"}, {"rotation_deg", 90}};
  for (int k = 0; k < 5000; ++k)
    store["fixtures"].push_back({{"preset", "longer"}, {"id", std::to_string(k)}, {"at", {1, 1}}});
  const test::ProcessorTime time;
  test::expect_input_error(
      [&] { read(store); },
      std::string_view("].preset: takes more than 5,000,000 values from presets, together with"));
  EXPECT_LT(time.seconds(), 1);
}

// Objects with many keys are searched with a table.
TEST(Presets, RemoveAndReplaceSomeOfManyKeys) {
  Json store = store_with(R"([{"preset": "above", "id": "A"}])");
  Json& presets = store["presets"];
  presets["below"] = Json::parse(R"({"type": "mesh", "at": [1, 1, 0], "file": "a.obj", "materials": {}})");
  presets["above"] = Json::parse(R"({"preset": "below", "materials": {}})");
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
  test::expect_input_error([&] { completed_fixture(JsonCursor::parse(store.dump(), "store.json"), {}, 0); },
                           std::string_view("removes a key that no preset of the fixture has"));
}

TEST(Presets, RefusesLongChainsOfPresets) {
  Json store = store_with(R"([{"preset": "0", "id": "A"}])");
  for (int k = 0; k < 200; ++k) store["presets"][std::to_string(k)] = {{"preset", std::to_string(k + 1)}};
  test::expect_input_error([&] { read(store); },
                           std::string_view("presets.99.preset: is the end of a chain of 100 presets"));
}

}  // namespace
}  // namespace shelfbeam
