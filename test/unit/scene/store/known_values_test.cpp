#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/build/decisive_values.hpp"
#include "shelfbeam/scene/build/draft.hpp"
#include "shelfbeam/scene/light_keys.hpp"
#include "shelfbeam/scene/store/value_marks.hpp"

#include "support/testing.hpp"
#include "unit/scene/same_scene.hpp"
#include "unit/scene/stores.hpp"

namespace shelfbeam::test {
namespace {

using testing::ElementsAre;

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

void use_label_type(Json& store, const char* type) {
  for (Json& preset : store["presets"])
    if (preset.contains("labels") && preset["labels"].is_object()) preset["labels"]["type"] = type;
}

// The store in which a person has confirmed everything.
Json confirmed(Json store, const std::filesystem::path& folder = {}) {
  const LengthUnit unit = read(store, folder).unit;
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
  const Json changes = R"([
    ["threshold standard", "/label_types/standard/threshold", 0.02],
    ["responsivity standard", "/label_types/standard/responsivity", {"type": "cosine_power", "exponent": 2}],
    ["power ceiling", "/transceiver_types/ceiling/emission/peak", 1.5],
    ["height", "/room/size/2", 3.6],
    ["reflectance floor", "/materials/floor/reflectance", 0.45],
    ["reflectance plaster", "/materials/plaster/reflectance", "plaster"]])"_json;
  Json all = new_shop();
  for (const Json& change : changes) {
    Json store = new_shop();
    const Json::json_pointer pointer(change[1].get<std::string>());
    store[pointer] = all[pointer] = change[2];
    EXPECT_THAT(with(ValueState::given, scene_of(store)), ElementsAre(change[0]));
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
  use_label_type(store, "mine");
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
  use_label_type(changed, "other");
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
    EXPECT_EQ(states(make_scene(read_text(expect_same_scene(read(store))))), states(scene_of(store)))
        << source;
  }
}

TEST(KnownValues, OfTypesWithOddNamesAreMarkedByTheirNames) {
  for (const char* name : {"29", "0", "-", "900000000", "a/b~c", " \"x\""}) {
    Json store = new_shop();
    store["transceiver_types"][name] = store["transceiver_types"]["ceiling"];
    for (Json& area : store["transceivers"]["areas"]) area["type"] = name;
    const std::string text = expect_same_scene(read(store));
    EXPECT_EQ(Json::parse(text)["assumed"]["transceiver_types"].items().begin().key(), name);
    EXPECT_EQ(state_of(fmt::format("power {}", name), make_scene(read_text(text))), ValueState::assumed);
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
  store["fixtures"] = Json::array();
  for (Json& area : store["transceivers"]["areas"]) area.update({{"spacing", 120}, {"below_ceiling", 2}});
  store["labels"] =
      R"([{"id": "L", "position": [100, 100, 100], "normal": [1, 0, 0], "type": "standard"}])"_json;
  const Json all = confirmed(store);
  EXPECT_NEAR(all["confirmed"]["room"]["height"].get<double>(), 412.3, 1e-9);
  EXPECT_EQ(state_of("height", scene_of(all)), ValueState::confirmed);
  store["room"] = R"({"outline": [[0, 0], [2000, 0], [2000, 1500], [0, 1500]], "floor": "floor",
    "height": [[0, 0, 300], [2000, 0, 300], [0, 1500, 400]], "ceiling": "ceiling", "walls": "plaster"})"_json;
  EXPECT_EQ(state_of("height", scene_of(store)), ValueState::given);
  EXPECT_EQ(state_of("height", scene_of(confirmed(store))), ValueState::confirmed);
}

TEST(KnownValues, OfTablesAreConfirmedByTheirContent) {
  Json store = new_shop();
  Json& emission = store["transceiver_types"]["ceiling"]["emission"];
  emission = {{"type", "table"}};
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
    catalogue_ = R"({
      "label_types": { "ESL 29": { "threshold": 0.012, "source": "datasheet", "order_number": "E-29", "price": 7.5,
                                   "responsivity": { "type": "cosine_power", "exponent": 1.5 } } },
      "transceiver_types": { "CT 3": { "emission": { "type": "lambertian", "flux": 2 }, "cost": 90, "radius": 0.05,
                                       "source": "assumption", "order_number": "CT-3" } } })"_json;
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
  use_label_type(store_, "ESL 29");
  EXPECT_EQ(state_of("threshold ESL 29", scene()), ValueState::given);
}

}  // namespace
}  // namespace shelfbeam::test
