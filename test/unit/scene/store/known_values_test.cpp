#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/build/decisive_values.hpp"
#include "shelfbeam/scene/build/draft.hpp"
#include "shelfbeam/scene/light_keys.hpp"
#include "shelfbeam/scene/store/value_marks.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

using test::Json;
using test::scene_of;
using test::TempFolder;
using testing::ElementsAre;

// The shop with which the planner begins, and a gondola of its catalogue.
Json new_shop() {
  Json store = Json::parse(starter_store(), nullptr, true, true);
  const Json catalogue = Json::parse(starter_catalogue(), nullptr, true, true);
  store.erase("catalogues");
  store["materials"].update(catalogue["materials"]);
  store["presets"] = catalogue["presets"];
  store["fixtures"] =
      Json::parse(R"([{"preset": "gondola 1.25 m, double, 1.6 m high", "id": "A{n}", "at": [2, 2],
                                       "repeat": {"count": 12, "step": 1.25}}])");
  return store;
}

std::string name_of(const DecisiveValue& value) {
  return value.of.empty() ? std::string(to_text(value.kind))
                          : fmt::format("{} {}", to_text(value.kind), value.of);
}

std::vector<std::string> with(ValueState state, const Scene& scene) {
  std::vector<std::string> names;
  for (const DecisiveValue& value : scene.values)
    if (value.state == state) names.push_back(name_of(value));
  return names;
}

ValueState state_of(const std::string& name, const Scene& scene) {
  for (const DecisiveValue& value : scene.values)
    if (name_of(value) == name) return value.state;
  ADD_FAILURE() << name << " is not in the list";
  return ValueState::given;
}

// The store in which a person has confirmed everything.
Json confirmed(Json store, const std::filesystem::path& folder = {}) {
  const LengthUnit unit = test::read_text(store.dump(), folder).unit;
  for (const DecisiveValue& value : scene_of(store, folder).values)
    store["confirmed"][Json::json_pointer(mark_pointer(value))] = mark_json(value, unit);
  return store;
}

TEST(KnownValues, OfANewShopAreAssumedTheMostInfluentialFirst) {
  const Scene scene = scene_of(new_shop());
  EXPECT_THAT(with(ValueState::assumed, scene),
              ElementsAre("threshold standard", "power ceiling", "responsivity standard", "height",
                          "reflectance floor", "reflectance ceiling", "reflectance plaster",
                          "reflectance steel", "reflectance carton"));
  EXPECT_EQ(scene.values.size(), 9U);
  EXPECT_EQ(scene.values[0].amount, 0.007);
  EXPECT_DOUBLE_EQ(scene.values[1].amount, power(scene.transceiver_types[0].emission));
}

TEST(KnownValues, AreGivenOnceTheyDifferFromTheStarter) {
  const std::map<std::string, std::pair<const char*, Json>> changes{
      {"threshold standard", {"/label_types/standard/threshold", 0.02}},
      {"responsivity standard",
       {"/label_types/standard/responsivity", {{"type", "cosine_power"}, {"exponent", 2}}}},
      {"power ceiling", {"/transceiver_types/ceiling/emission/peak", 1.5}},
      {"height", {"/room/size/2", 3.6}},
      {"reflectance floor", {"/materials/floor/reflectance", 0.45}},
      {"reflectance plaster", {"/materials/plaster/reflectance", "plaster"}},
  };
  Json all = new_shop();
  for (const auto& [name, change] : changes) {
    Json store = new_shop();
    store[Json::json_pointer(change.first)] = all[Json::json_pointer(change.first)] = change.second;
    const Scene scene = scene_of(store);
    EXPECT_THAT(with(ValueState::given, scene), ElementsAre(name));
  }
  EXPECT_EQ(with(ValueState::given, scene_of(all)).size(), changes.size());
}

TEST(KnownValues, OfCopiesUnderOtherNamesAreAssumed) {
  Json store = new_shop();
  store["materials"]["my floor"] = store["materials"]["floor"];
  store["room"]["floor"] = "my floor";
  store["label_types"]["mine"] = store["label_types"]["standard"];
  store["transceiver_types"]["mine"] = store["transceiver_types"]["ceiling"];
  for (Json& area : store["transceivers"]["areas"]) area["type"] = "mine";
  for (Json& preset : store["presets"])
    if (preset.contains("labels") && preset["labels"].is_object()) preset["labels"]["type"] = "mine";
  const Scene scene = scene_of(store);
  EXPECT_EQ(state_of("reflectance my floor", scene), ValueState::assumed);
  EXPECT_EQ(state_of("threshold mine", scene), ValueState::assumed);
  EXPECT_EQ(state_of("power mine", scene), ValueState::assumed);
}

TEST(KnownValues, ConfirmationsLapseAndReturn) {
  const Json store = new_shop(), all = confirmed(store);
  const Scene plain = scene_of(store), scene = scene_of(all);
  EXPECT_EQ(with(ValueState::confirmed, scene).size(), plain.values.size());
  // Each on its own, and with another value.
  for (const DecisiveValue& value : plain.values) {
    const Json::json_pointer pointer(mark_pointer(value));
    Json one = store;
    one["confirmed"][pointer] = all["confirmed"][pointer];
    EXPECT_THAT(with(ValueState::confirmed, scene_of(one)), ElementsAre(name_of(value)));
  }
  Json changed = all;
  changed["label_types"]["standard"]["threshold"] = 0.0071;
  EXPECT_EQ(state_of("threshold standard", scene_of(changed)), ValueState::given);
  changed["label_types"]["standard"]["threshold"] = 0.007;
  EXPECT_EQ(state_of("threshold standard", scene_of(changed)), ValueState::confirmed);
  changed = all;
  changed["room"]["size"][2] = 3.6;
  EXPECT_EQ(state_of("height", scene_of(changed)), ValueState::given);
  EXPECT_EQ(state_of("power ceiling", scene_of(changed)), ValueState::confirmed) << "the others stay";
  changed["label_types"].erase("standard");
  changed["label_types"]["other"] = {{"threshold", 0.1}};
  for (Json& preset : changed["presets"])
    if (preset.contains("labels") && preset["labels"].is_object()) preset["labels"]["type"] = "other";
  EXPECT_EQ(state_of("threshold other", scene_of(changed)), ValueState::given) << "a mark of a removed type";
}

TEST(KnownValues, AreOutsideAllHashes) {
  Json store = new_shop();
  const Scene plain = scene_of(store);
  const auto expect_same = [&](const Json& marked) {
    const Scene scene = scene_of(marked);
    EXPECT_EQ(scene.store_hash, plain.store_hash);
    EXPECT_EQ(light_keys(scene).light_hash, light_keys(plain).light_hash);
    EXPECT_EQ(light_keys(scene).labels, light_keys(plain).labels);
    EXPECT_EQ(light_keys(scene).transceivers, light_keys(plain).transceivers);
  };
  expect_same(confirmed(store));
  Json marked = confirmed(store);
  marked["assumed"] = marked["confirmed"];
  expect_same(marked);
  for (const char* source : {"datasheet", "measured", "assumption", "example"}) {
    marked["source"] = source;
    marked["label_types"]["standard"].update(
        {{"source", source}, {"name", "ESL"}, {"order_number", "1"}, {"price", 8}});
    marked["transceiver_types"]["ceiling"].update({{"source", source}, {"name", "a \"name\""}});
    expect_same(marked);
  }
  marked["label_types"]["standard"]["safety_factor"] = 1.5;
  EXPECT_NE(scene_of(marked).store_hash, plain.store_hash) << "the control";
}

TEST(KnownValues, OfTheResolvedStoreAreTheSame) {
  Json store = new_shop();
  store["label_types"]["standard"]["threshold"] = {{"hears", "ceiling"}, {"at_m", 6}, {"angle_deg", 45}};
  store["transceiver_types"]["ceiling"].update({{"cost", 40}, {"source", "assumption"}});
  store["materials"]["plaster"]["reflectance"] = 0.82;
  store["confirmed"] = {{"materials", {{"floor", {{"reflectance", 0.5}}}}}, {"room", {{"height", 3.5}}}};
  const auto states = [](const Scene& scene) {
    std::vector<std::string> all;
    for (const DecisiveValue& value : scene.values)
      all.push_back(
          fmt::format("{} {} {} {}", name_of(value), to_text(value.state), value.value, value.amount));
    return all;
  };
  for (const char* source : {"", "datasheet", "example"}) {
    if (*source != 0) store["source"] = source;
    const Store read = test::read_text(store.dump());
    const Scene scene = make_scene(read);
    const std::string text = resolved_store_json(read, scene);
    const Store again = test::read_text(text);
    const Scene resolved = make_scene(again);
    EXPECT_EQ(states(resolved), states(scene)) << source;
    EXPECT_EQ(resolved.store_hash, scene.store_hash);
    EXPECT_EQ(resolved_store_json(again, resolved), text);
  }
}

TEST(KnownValues, OfTypesWithOddNamesAreMarkedByTheirNames) {
  for (const char* name : {"29", "0", "-", "900000000", "a/b~c", " \"x\""}) {
    Json store = new_shop();
    store["transceiver_types"][name] = store["transceiver_types"]["ceiling"];
    for (Json& area : store["transceivers"]["areas"]) area["type"] = name;
    const Scene scene = scene_of(store);
    const std::string text = resolved_store_json(test::read_text(store.dump()), scene);
    EXPECT_EQ(Json::parse(text)["assumed"]["transceiver_types"].items().begin().key(), name);
    EXPECT_EQ(state_of(fmt::format("power {}", name), make_scene(test::read_text(text))),
              ValueState::assumed);
  }
}

TEST(KnownValues, ThresholdByRangeIsAsWellKnownAsThePower) {
  Json store = new_shop();
  store["label_types"]["standard"]["threshold"] = {{"hears", "ceiling"}, {"at_m", 6}, {"angle_deg", 45}};
  EXPECT_EQ(state_of("threshold standard", scene_of(store)), ValueState::assumed);
  store["transceiver_types"]["ceiling"]["emission"]["peak"] = 2;
  EXPECT_EQ(state_of("threshold standard", scene_of(store)), ValueState::given);
  Json all = confirmed(store);
  EXPECT_EQ(state_of("threshold standard", scene_of(all)), ValueState::confirmed);
  all["confirmed"]["transceiver_types"].erase("ceiling");
  EXPECT_EQ(state_of("threshold standard", scene_of(all)), ValueState::given);
  all = confirmed(store);
  all["transceiver_types"]["ceiling"]["emission"]["peak"] = 3;
  EXPECT_EQ(state_of("threshold standard", scene_of(all)), ValueState::given) << "its signal has changed";
}

TEST(KnownValues, HeightIsConfirmedInTheUnitOfTheFile) {
  Json store = new_shop();
  store["units"] = "cm";
  store["room"]["size"] = {2000, 1500, 412.3};
  store["fixtures"][0].update({{"at", {200, 200}}, {"repeat", {{"count", 3}, {"step", 125}}}});
  for (Json& area : store["transceivers"]["areas"]) area.update({{"spacing", 120}, {"below_ceiling", 2}});
  for (Json& preset : store["presets"]) {
    for (const char* key : {"length", "depth", "height"})
      if (preset.contains(key)) preset[key] = preset[key].get<double>() * 100;
    if (preset.contains("shelves"))
      for (Json& shelf : preset["shelves"]) shelf = shelf.get<double>() * 100;
    if (preset.contains("labels") && preset["labels"].is_object() && preset["labels"].contains("spacing"))
      preset["labels"]["spacing"] = preset["labels"]["spacing"].get<double>() * 100;
  }
  const Json all = confirmed(store);
  EXPECT_NEAR(all["confirmed"]["room"]["height"].get<double>(), 412.3, 1e-9);
  EXPECT_EQ(state_of("height", scene_of(all)), ValueState::confirmed);
  store["room"] = Json::parse(R"({"outline": [[0, 0], [2000, 0], [2000, 1500], [0, 1500]], "floor": "floor",
    "height": [[0, 0, 300], [2000, 0, 300], [0, 1500, 400]], "ceiling": "ceiling", "walls": "plaster"})");
  EXPECT_EQ(state_of("height", scene_of(store)), ValueState::given);
  EXPECT_EQ(state_of("height", scene_of(confirmed(store))), ValueState::confirmed);
}

TEST(KnownValues, OfTablesAreConfirmedByTheirContent) {
  Json store = new_shop();
  Json& emission = store["transceiver_types"]["ceiling"]["emission"];
  emission = {{"type", "table"}, {"theta_deg", Json::array()}, {"intensity", Json::array()}};
  for (int k = 0; k <= 90; ++k) {
    emission["theta_deg"].push_back(k);
    emission["intensity"].push_back(1 + 0.001 * k);
  }
  Json all = confirmed(store);
  EXPECT_LT(all["confirmed"].dump().size(), 1000U);
  EXPECT_EQ(state_of("power ceiling", scene_of(all)), ValueState::confirmed);
  all["transceiver_types"]["ceiling"]["emission"]["intensity"][90] = 1.2;
  EXPECT_EQ(state_of("power ceiling", scene_of(all)), ValueState::given);
}

TEST(KnownValues, OfAPriceOnlyIfThereIsOne) {
  Json store = new_shop();
  store["currency"] = "EUR";
  EXPECT_EQ(scene_of(store).currency, "") << "a missing price is no price";
  EXPECT_EQ(scene_of(store).values.size(), 9U);
  store["transceiver_types"]["ceiling"]["cost"] = 1;
  EXPECT_EQ(state_of("price ceiling", scene_of(store)), ValueState::given);
  EXPECT_EQ(scene_of(store).currency, "EUR");
  store.erase("currency");
  EXPECT_EQ(scene_of(store).values.size(), 9U) << "the default";
  store["transceiver_types"]["ceiling"]["cost"] = 120;
  EXPECT_EQ(state_of("price ceiling", scene_of(store)), ValueState::given);
  EXPECT_EQ(state_of("price ceiling", scene_of(confirmed(store))), ValueState::confirmed);
}

TEST(KnownValues, OfADraftAreThoseOfTheShop) {
  const Json all = confirmed(new_shop());
  const Draft draft = read_draft(JsonCursor::parse(all.dump(), "store.json"), {}, SceneDetail::outlines);
  ASSERT_TRUE(draft.problems.empty());
  const auto states = [](const std::vector<DecisiveValue>& values) {
    std::string names;
    for (const DecisiveValue& value : values) names.append(name_of(value)).append(value.value).append("\n");
    return names;
  };
  EXPECT_EQ(states(draft.scene.values), states(scene_of(all).values));
  EXPECT_EQ(with(ValueState::confirmed, draft.scene).size(), draft.scene.values.size());
}

class Products : public testing::Test {
 protected:
  Products() : store_(new_shop()) {
    store_["catalogues"] = {"vendor.json"};
    store_["label_types"] = {{"standard", {{"product", "ESL 29"}, {"safety_factor", 1.25}}}};
    store_["transceiver_types"] = {{"ceiling", {{"product", "CT 3"}}}};
    catalogue_ = Json::parse(R"({
      "label_types": { "ESL 29": { "threshold": 0.012, "source": "datasheet", "order_number": "E-29", "price": 7.5,
                                   "responsivity": { "type": "cosine_power", "exponent": 1.5 } } },
      "transceiver_types": { "CT 3": { "emission": { "type": "lambertian", "flux": 2 }, "cost": 90, "radius": 0.05,
                                       "source": "assumption", "order_number": "CT-3" } } })");
  }
  Scene scene() const {
    folder_.write("vendor.json", catalogue_.dump());
    return scene_of(store_, folder_.path());
  }

  Json store_, catalogue_;
  TempFolder folder_;
};

TEST_F(Products, GiveTheirValuesAndTheirName) {
  const Scene made = scene();
  const LabelType& label = *std::ranges::find(made.label_types, "standard", &LabelType::name);
  const TransceiverType& unit = *std::ranges::find(made.transceiver_types, "ceiling", &TransceiverType::name);
  EXPECT_EQ(label.threshold, 0.012);
  EXPECT_EQ(label.safety_factor, 1.25);
  EXPECT_EQ(label.origin.name, "ESL 29");
  EXPECT_EQ(label.order_number, "E-29");
  EXPECT_EQ(label.price, 7.5);
  EXPECT_EQ(unit.cost, 90);
  EXPECT_EQ(unit.radius, 0.05);
  EXPECT_EQ(unit.order_number, "CT-3");
  EXPECT_EQ(unit.origin.name, "CT 3");
}

TEST_F(Products, SayHowWellTheirValuesAreKnown) {
  EXPECT_THAT(with(ValueState::given, scene()), ElementsAre("threshold standard", "responsivity standard"));
  EXPECT_EQ(state_of("power ceiling", scene()), ValueState::assumed);
  EXPECT_EQ(state_of("price ceiling", scene()), ValueState::assumed);
  catalogue_["label_types"]["ESL 29"].erase("responsivity");
  EXPECT_EQ(state_of("responsivity standard", scene()), ValueState::assumed) << "a default";
  EXPECT_EQ(state_of("threshold standard", scene()), ValueState::given);
  store_["transceiver_types"]["ceiling"]["cost"] = 80;
  EXPECT_EQ(state_of("price ceiling", scene()), ValueState::given) << "a value of the store itself";
  EXPECT_EQ(state_of("power ceiling", scene()), ValueState::assumed);
  catalogue_["label_types"]["ESL 29"]["threshold"] = 0.007;
  EXPECT_EQ(state_of("threshold standard", scene()), ValueState::given)
      << "a datasheet may have the starter's";
  store_ = confirmed(store_, folder_.path());
  EXPECT_EQ(with(ValueState::confirmed, scene()).size(), scene().values.size());
  catalogue_["label_types"]["ESL 29"]["threshold"] = 0.008;
  EXPECT_EQ(state_of("threshold standard", scene()), ValueState::given)
      << "of a new edition of the catalogue";
}

TEST_F(Products, CanBeUsedWithoutATypeOfTheStore) {
  store_["label_types"].erase("standard");
  for (Json& preset : store_["presets"])
    if (preset.contains("labels") && preset["labels"].is_object()) preset["labels"]["type"] = "ESL 29";
  EXPECT_EQ(state_of("threshold ESL 29", scene()), ValueState::given);
}

TEST_F(Products, ThatAreWrongAreRefused) {
  const auto expect_refused = [&](const auto&... parts) {
    test::expect_input_error([&] { scene(); }, parts...);
  };
  store_["label_types"]["standard"]["product"] = "ESL 30";
  expect_refused("store.json: label_types.standard.product", "names the unknown product 'ESL 30'",
                 "'ESL 29'");
  store_["label_types"]["standard"]["product"] = "ESL 29";
  catalogue_["label_types"]["ESL 29"]["threshold"] = -1;
  expect_refused("vendor.json: label_types.ESL 29.threshold");
  catalogue_["label_types"]["ESL 29"]["threshold"] = 0.01;
  catalogue_["label_types"]["ESL 29"]["product"] = "other";
  expect_refused("vendor.json", "product");
  store_["catalogues"] = Json::array();
  store_["transceiver_types"]["ceiling"] = {{"emission", {{"type", "lambertian"}, {"flux", 2}}}};
  expect_refused("label_types.standard.product", "define it in 'label_types' of a catalogue");
}

TEST(Marks, ThatAreWrongAreRefused) {
  const auto expect_refused = [](const char* section, const Json& marks, const char* where) {
    Json store = new_shop();
    store[section] = marks;
    test::expect_input_error([&] { scene_of(store); }, fmt::format("store.json: {}", where));
  };
  expect_refused("confirmed", {{"label_type", Json::object()}}, "confirmed");
  expect_refused("confirmed", {{"label_types", {{"standard", {{"size", 1}}}}}},
                 "confirmed.label_types.standard");
  expect_refused("assumed", {{"label_types", {{"standard", {{"threshold", -1}}}}}},
                 "assumed.label_types.standard.threshold");
  expect_refused("confirmed", {{"materials", {{"floor", {{"reflectance", "plaster"}}}}}},
                 "confirmed.materials.floor.reflectance");
  expect_refused("confirmed", {{"transceiver_types", {{"ceiling", {{"emission", 4.2}}}}}},
                 "confirmed.transceiver_types.ceiling.emission");
  expect_refused("confirmed", {{"room", {{"height", 0}}}}, "confirmed.room.height");
  expect_refused("source", "guess", "source");
}

}  // namespace
}  // namespace shelfbeam
