#include "shelfbeam/plan/difference/store_changes.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {
namespace {

using Json = nlohmann::ordered_json;
using Kind = StoreChangeKind;

Json store_file() {
  return Json::parse(R"({
    "name": "Kiosk", "currency": "EUR",
    "room": { "size": [8, 6, 3], "floor": "m", "ceiling": "m", "walls": "m" },
    "materials": { "m": { "type": "lambertian", "reflectance": 0.3 } },
    "label_types": { "standard": { "threshold": 0.03 } },
    "transceiver_types": { "ceiling": { "emission": { "type": "sin2theta", "peak": 1 }, "cost": 100 } },
    "fixtures": [ { "type": "gondola", "id": "A", "at": [2, 2.5], "length": 4, "depth": 0.9, "height": 1.8,
                    "material": "m", "shelves": [0.5, 1.2] } ],
    "labels": [ { "id": "door", "position": [0.1, 3, 1.5], "normal": [1, 0, 0], "type": "standard" },
                { "id": "till", "position": [0.1, 4, 1.5], "normal": [1, 0, 0], "type": "standard" } ],
    "transceivers": { "list": [ { "id": "T1", "position": [1, 1, 2.9], "type": "ceiling" },
                                { "id": "T2", "position": [5, 5, 2.9], "type": "ceiling" } ] }
  })");
}

std::string resolved(const Json& file) {
  const Store store = parse_store(file.dump(), "store.json", ".");
  return resolved_store_json(store, make_scene(store));
}

std::vector<StoreChange> changes_of(const Json& changed) {
  return store_changes(resolved(store_file()), resolved(changed));
}

struct Case {
  std::string name;
  std::function<void(Json&)> edit;
  StorePart part;
  Kind kind;
  std::string before_id, after_id;
  std::vector<ValueChange> values;
};

TEST(StoreChanges, LeaveOutTheUnitsOfEarlierPlans) {
  Json changed = store_file();
  changed["transceivers"]["selected"] = {"T1"};
  EXPECT_TRUE(changes_of(changed).empty());
  changed["transceivers"]["pinned"] = {"T1"};
  EXPECT_EQ(changes_of(changed).size(), 1U);
}

TEST(StoreChanges, FindEveryKindOfChange) {
  const auto cases = std::vector<Case>{{"name",
                                        [](Json& s) { s["name"] = "Shop"; },
                                        StorePart::shop,
                                        Kind::changed,
                                        "",
                                        "",
                                        {{"name", R"("Kiosk")", R"("Shop")"}}},
                                       {"currency",
                                        [](Json& s) { s.erase("currency"); },
                                        StorePart::shop,
                                        Kind::changed,
                                        "",
                                        "",
                                        {{"currency", R"("EUR")", ""}}},
                                       {"language",
                                        [](Json& s) { s["language"] = "de"; },
                                        StorePart::shop,
                                        Kind::changed,
                                        "",
                                        "",
                                        {{"language", "", R"("de")"}}},
                                       {"wavelength",
                                        [](Json& s) { s["wavelength_nm"] = 850; },
                                        StorePart::shop,
                                        Kind::changed,
                                        "",
                                        "",
                                        {{"wavelength_nm", "940.0", "850.0"}}},
                                       {"room",
                                        [](Json& s) { s["room"]["size"][2] = 3.5; },
                                        StorePart::room,
                                        Kind::changed,
                                        "",
                                        "",
                                        {{"size", "[8.0,6.0,3.0]", "[8.0,6.0,3.5]"}}},
                                       {"reflectance",
                                        [](Json& s) { s["materials"]["m"]["reflectance"] = 0.4; },
                                        StorePart::materials,
                                        Kind::changed,
                                        "m",
                                        "m",
                                        {{"reflectance", "0.3", "0.4"}}},
                                       {"threshold",
                                        [](Json& s) { s["label_types"]["standard"]["threshold"] = 0.02; },
                                        StorePart::label_types,
                                        Kind::changed,
                                        "standard",
                                        "standard",
                                        {{"threshold", "0.03", "0.02"}}},
                                       {"price",
                                        [](Json& s) { s["transceiver_types"]["ceiling"]["cost"] = 90; },
                                        StorePart::transceiver_types,
                                        Kind::changed,
                                        "ceiling",
                                        "ceiling",
                                        {{"cost", "100.0", "90.0"}}},
                                       {"fixture moved",
                                        [](Json& s) { s["fixtures"][0]["at"][0] = 2.5; },
                                        StorePart::fixtures,
                                        Kind::moved,
                                        "A",
                                        "A",
                                        {{"at", "[2.0,2.5]", "[2.5,2.5]"}}},
                                       {"fixture longer",
                                        [](Json& s) { s["fixtures"][0]["length"] = 3; },
                                        StorePart::fixtures,
                                        Kind::changed,
                                        "A",
                                        "A",
                                        {{"length", "4.0", "3.0"}}},
                                       {"fixture renamed",
                                        [](Json& s) { s["fixtures"][0]["id"] = "B"; },
                                        StorePart::fixtures,
                                        Kind::renamed,
                                        "A",
                                        "B",
                                        {}},
                                       {"fixture removed",
                                        [](Json& s) { s["fixtures"].clear(); },
                                        StorePart::fixtures,
                                        Kind::removed,
                                        "A",
                                        "",
                                        {}},
                                       {"label moved",
                                        [](Json& s) { s["labels"][0]["position"][1] = 2; },
                                        StorePart::labels,
                                        Kind::moved,
                                        "door",
                                        "door",
                                        {{"position", "[0.1,3.0,1.5]", "[0.1,2.0,1.5]"}}},
                                       {"label renamed",
                                        [](Json& s) { s["labels"][0]["id"] = "gate"; },
                                        StorePart::labels,
                                        Kind::renamed,
                                        "door",
                                        "gate",
                                        {}},
                                       {"label removed",
                                        [](Json& s) { s["labels"].erase(0); },
                                        StorePart::labels,
                                        Kind::removed,
                                        "door",
                                        "",
                                        {}},
                                       {"candidate turned",
                                        [](Json& s) { s["transceivers"]["list"][0]["axis"] = {0, 1, 0}; },
                                        StorePart::transceivers,
                                        Kind::moved,
                                        "T1",
                                        "T1",
                                        {{"axis", "[0.0,0.0,-1.0]", "[0.0,1.0,0.0]"}}},
                                       {"candidate removed",
                                        [](Json& s) { s["transceivers"]["list"].erase(1); },
                                        StorePart::transceivers,
                                        Kind::removed,
                                        "T2",
                                        "",
                                        {}},
                                       {"installed",
                                        [](Json& s) { s["transceivers"]["installed"] = {"T2"}; },
                                        StorePart::transceivers,
                                        Kind::changed,
                                        "T2",
                                        "T2",
                                        {{"installed", "", "true"}}}};
  for (const Case& one : cases) {
    Json changed = store_file();
    one.edit(changed);
    const StoreChange expected{one.part, one.kind, one.before_id, one.after_id, one.values};
    const std::vector<StoreChange> found = changes_of(changed);
    EXPECT_EQ(found, std::vector<StoreChange>{expected}) << one.name << ", " << found.size() << " found";

    // The other way round.
    StoreChange back = expected;
    std::swap(back.before_id, back.after_id);
    for (ValueChange& value : back.values) std::swap(value.before, value.after);
    if (back.kind == Kind::removed) back.kind = Kind::added;
    EXPECT_EQ(store_changes(resolved(changed), resolved(store_file())), std::vector<StoreChange>{back})
        << one.name;
  }
}

TEST(StoreChanges, AreNoneInEqualStores) {
  EXPECT_TRUE(changes_of(store_file()).empty());
  // Written in another way, in another order, or rounded.
  Json same = store_file();
  std::reverse(same["labels"].begin(), same["labels"].end());
  same["labels"][0]["position"][0] = 0.1 + 1e-12;
  same["fixtures"][0]["rotation_deg"] = 0;
  EXPECT_TRUE(changes_of(same).empty());
  same["labels"][0]["position"][0] = 0.1 + 1e-6;
  EXPECT_EQ(changes_of(same).size(), 1U) << "negative control";
}

// Lists of ids that this version does not know.
TEST(StoreChanges, TakeEveryListOfIdsForAKeyOfTheUnits) {
  Json before = Json::parse(resolved(store_file())), after = before;
  before["transceivers"]["pinned"] = {"T1"};
  after["transceivers"]["pinned"] = {"T2", "T9"};
  const std::vector<StoreChange> found = store_changes(before.dump(), after.dump());
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].values, (std::vector<ValueChange>{{"pinned", "true", ""}}));
  EXPECT_EQ(found[1].values, (std::vector<ValueChange>{{"pinned", "", "true"}}));
  EXPECT_EQ(found[2].after_id, "T9");
}

// Elements of lists with ids are compared by their ids.
TEST(StoreChanges, NameElementsWithinAnElement) {
  Json store = store_file();
  store["room"]["inner_walls"] = Json::parse(
      R"([{"id": "W1", "from": [6, 0], "to": [6, 2], "thickness": 0.2, "material": "m"},
          {"id": "W2", "from": [0, 5], "to": [2, 5], "thickness": 0.2, "material": "m"}])");
  Json changed = store;
  changed["room"]["inner_walls"].erase(0);
  changed["room"]["inner_walls"][0]["to"] = {3, 5};
  const std::vector<StoreChange> found = store_changes(resolved(store), resolved(changed));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].part, StorePart::room);
  std::vector<std::string> keys;
  for (const ValueChange& value : found[0].values) keys.push_back(value.key);
  EXPECT_EQ(keys, (std::vector<std::string>{"inner_walls[W1]", "inner_walls[W2].to"}));
}

}  // namespace
}  // namespace shelfbeam
