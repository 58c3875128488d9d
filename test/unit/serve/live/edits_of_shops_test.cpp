// Tests edits that the server makes: fixtures with places of their own, and units.

#include "serve/live/dissolve.hpp"
#include "serve/live/shop.hpp"
#include "serve/live/unit_edits.hpp"
#include "unit/serve/live/examples.hpp"
#include "unit/serve/testing.hpp"

namespace shelfbeam::serve {
namespace {

std::map<std::string, Vec3> labels_of(const Shop& shop) {
  std::map<std::string, Vec3> places;
  for (const Label& label : shop.draft().scene.labels) places[label.id] = label.position;
  return places;
}

// Fixtures with places of their own stand where the copies stood.
TEST(Dissolved, FixturesAreWhereTheyWere) {
  int dissolved = 0;
  for (const char* name : {"grocery", "market-hall", "chiller", "supermarket"}) {
    const fs::path file = example(name);
    Shop shop(file);
    std::string text = read_file(file);
    shop.update(text, 1);
    const auto expected = labels_of(shop);
    for (std::size_t k = 0; k < shop.json()["fixtures"].size(); ++k) {
      const std::string pointer = "/fixtures/" + std::to_string(k);
      const Json whole = shop.details(pointer)["effective"];
      if (!whole.contains("repeat") && !whole.contains("against")) {
        EXPECT_THROW(shop.dissolved(pointer), InputError);
        continue;
      }
      ++dissolved;
      text = edited(text, shop.dissolved(pointer)).text;
      EXPECT_EQ(text.find("{\n      \""), std::string::npos)
          << "is in the layout of its neighbours: " << text;
      shop.update(text, 1);
      ASSERT_TRUE(shop.problems().empty()) << name << ' ' << pointer << ' ' << shop.problems();
    }
    const auto found = labels_of(shop);
    ASSERT_EQ(found.size(), expected.size()) << name;
    for (const auto& [id, position] : expected) {
      ASSERT_TRUE(found.contains(id)) << id;
      EXPECT_NEAR(length(found.at(id) - position), 0, 1e-8) << id;
    }
    for (const Json& part : shop.parts()) EXPECT_TRUE(part["locked"].is_null());
  }
  EXPECT_GT(dissolved, 10);
}

// A row of a catalogue in mm in a store in m, with comments around.
TEST(Dissolved, KeepsCommentsAndSizes) {
  const TempFolder folder;
  write_file(folder.path() / "catalogue.json", R"({"units": "mm", "presets": {
      "row": {"type": "gondola", "length": 2000, "depth": 900, "height": 1800, "shelves": [300, 900],
              "rotation_deg": 90, "material": "w", "goods": "w", "stocking": 0.5, "repeat": {"count": 2, "step": [3000, 0]}}}})");
  const std::string before = R"({"catalogues": ["catalogue.json"], "room": {"size": [20, 15, 4]},
  "materials": {"w": {"type": "lambertian", "reflectance": 0.5}},
  "fixtures": [
    // the north aisle
    {"preset": "row", "id": "A{n}", "at": [2, 5]},  // as built
    {"preset": "row", "id": "B{n}", "at": [2, 9]}
  ]})";
  Shop shop(folder.path() / "store.json");
  shop.update(before, 1);
  const Json problems = shop.problems();  // the store has no labels, for example
  const Json parts = shop.parts();
  const std::string after = edited(before, shop.dissolved("/fixtures/0")).text;
  EXPECT_NE(after.find("    // the north aisle\n    {"), std::string::npos) << after;
  EXPECT_NE(after.find("// as built\n"), std::string::npos) << after;
  shop.update(after, 2);
  EXPECT_EQ(shop.problems(), problems) << after;
  const auto outlines = [](const Json& list) {
    std::map<std::string, Json> all;
    for (const Json& part : list) all[part["id"].get<std::string>()] = {part["outline"], part["height"]};
    return all;
  };
  EXPECT_EQ(outlines(shop.parts()), outlines(parts));
  EXPECT_EQ(shop.json()["fixtures"][1]["length"], 2);
  EXPECT_EQ(shop.json()["fixtures"][1]["rotation_deg"], 90);
}

constexpr auto head = R"({
  "units": "cm",
  "room": {"size": [1000, 600, 300], "floor": "p", "ceiling": "p", "walls": "p"},
  "materials": {"p": {"type": "lambertian", "reflectance": 0.5}},
  "label_types": {"l": {"threshold": 1}},
  "transceiver_types": {"t": {"emission": {"type": "sin2theta", "peak": 1}},
                        "narrow": {"emission": {"type": "sin2theta", "peak": 2}}},
  "labels": [{"id": "L", "position": [100, 100, 100], "normal": [0, 1, 0], "type": "l"}])";

// A store whose text follows the edits.
class UnitEdits : public testing::Test {
 protected:
  explicit UnitEdits(const std::string& transceivers = R"(,
  "transceivers": {
    "grids": [{"type": "t", "min": [100, 100], "max": [500, 100], "spacing": 100, "z": 290}],
    "list": [
      {"id": "A", "type": "t", "position": [200, 300, 290]},  // by the door
      {"id": "B", "type": "t", "position": [300, 300, 290], "axis": [0, 1, -1]}
    ],
    "selected": ["A", "G1-2-1"], "excluded": ["G1-5-*"], "installed": ["B"], "keep_out": [{"min": [900, 500], "max": [1000, 600]}]
  }
})")
      : shop_(folder_.path() / "store.json"), text_(head + transceivers) {
    shop_.update(text_, 1);
  }

  std::size_t index(const std::string& id) const {
    for (std::size_t k = 0; k < shop_.unit_count(); ++k)
      if (shop_.unit(k)["id"] == id) return k;
    ADD_FAILURE() << id;
    return 0;
  }
  std::string act(const Json& request) {
    const UnitEdit edit = unit_edit(request, shop_.json(), shop_.draft());
    const std::string before = text_;
    text_ = edited(text_, edit.ops).text;
    shop_.update(text_, 1);
    EXPECT_TRUE(shop_.problems().empty()) << shop_.problems() << text_;
    std::vector<EditOp> inverse;  // undo gives the text before
    for (auto op = edit.ops.rbegin(); op != edit.ops.rend(); ++op)
      inverse.push_back({op->path, op->after, op->before});
    EXPECT_EQ(Json::parse(edited(text_, inverse).text, nullptr, true, true),
              Json::parse(before, nullptr, true, true));
    return edit.ids.empty() ? "" : edit.ids.back();
  }
  std::string mark(const std::string& action, const std::string& id, bool on) {
    return act({{"action", action}, {"index", index(id)}, {"on", on}});
  }
  const Json& units() const { return shop_.json()["transceivers"]; }

  TempFolder folder_;
  Shop shop_;
  std::string text_;
};

TEST_F(UnitEdits, PlaceAUnitThatIsPinned) {
  EXPECT_EQ(act({{"action", "place"}, {"type", "narrow"}, {"position", {1.23456789, 2, 2.95}}}), "U1");
  EXPECT_EQ(units()["list"][2],
            Json::parse(R"({"id": "U1", "type": "narrow", "position": [123.46, 200, 295]})"));
  EXPECT_EQ(units()["pinned"], Json({"U1"}));
  EXPECT_EQ(act({{"action", "place"},
                 {"type", "t"},
                 {"position", {3, 2, 2.95}},
                 {"axis", {0, 3, -4}},
                 {"roll_deg", 30},
                 {"as", "installed"}}),
            "U2");
  EXPECT_EQ(units()["list"][3]["axis"], Json({0, 0.6, -0.8}));
  EXPECT_EQ(units()["list"][3]["roll_deg"], 30);
  EXPECT_EQ(units()["installed"], Json({"B", "U2"}));
}

TEST_F(UnitEdits, TakeAnAxisOfAnyLength) {
  for (const double scale : {1e200, 1e-170}) {
    act({{"action", "change"}, {"index", index("A")}, {"axis", {0, 3 * scale, -4 * scale}}});
    EXPECT_EQ(units()["list"][0]["axis"], Json({0, 0.6, -0.8})) << scale;
    act({{"action", "change"}, {"index", index("A")}, {"axis", {0, 0, -scale}}});
    EXPECT_FALSE(units()["list"][0].contains("axis")) << scale;
  }
}

TEST_F(UnitEdits, MoveAUnitOfTheListAndPinIt) {
  EXPECT_EQ(act({{"action", "change"}, {"index", index("A")}, {"position", {2.5, 3, 2.9}}}), "A");
  EXPECT_EQ(units()["list"][0]["position"], Json({250, 300, 290}));
  EXPECT_EQ(units()["pinned"], Json({"A"}));
  EXPECT_EQ(units()["selected"], Json({"A", "G1-2-1"}));
  EXPECT_NE(text_.find("// by the door"), std::string::npos);
  act({{"action", "change"}, {"index", index("B")}, {"type", "narrow"}, {"axis", {0, 0, -1}}});
  EXPECT_FALSE(units()["list"][1].contains("axis"));
  EXPECT_EQ(units()["list"][1]["type"], "narrow");
  EXPECT_EQ(units()["pinned"], Json({"A"})) << "an installed unit stays so";
}

TEST_F(UnitEdits, MoveACandidateIntoTheList) {
  EXPECT_EQ(act({{"action", "change"}, {"index", index("G1-2-1")}, {"position", {2.2, 1.1, 2.9}}}), "U1");
  EXPECT_EQ(units()["list"][2]["position"], Json({220, 110, 290}));
  EXPECT_EQ(units()["selected"], Json({"A"})) << "the candidate is off the plan";
  EXPECT_EQ(units()["pinned"], Json({"U1"}));
}

TEST_F(UnitEdits, MarkUnits) {
  mark("switch", "G1-1-1", true);
  EXPECT_EQ(units()["selected"], Json({"A", "G1-2-1", "G1-1-1"}));
  mark("pin", "G1-1-1", true);
  EXPECT_EQ(units()["pinned"], Json({"G1-1-1"}));
  mark("exclude", "G1-1-1", true);
  EXPECT_EQ(units()["excluded"], Json({"G1-5-*", "G1-1-1"}));
  EXPECT_EQ(units()["pinned"], Json::array());
  EXPECT_EQ(units()["selected"], Json({"A", "G1-2-1"}));
  mark("pin", "G1-1-1", true);
  EXPECT_EQ(units()["excluded"], Json({"G1-5-*"}));
  mark("install", "G1-1-1", true);
  EXPECT_EQ(units()["installed"], Json({"B", "G1-1-1"}));
  EXPECT_EQ(units()["pinned"], Json::array());
  mark("switch", "G1-1-1", false);
  EXPECT_EQ(units()["installed"], Json({"B"}));
  EXPECT_EQ(act({{"action", "remove"}, {"index", index("A")}}), "A");
  EXPECT_EQ(units()["list"].size(), 1U);
  EXPECT_EQ(units()["selected"], Json({"G1-2-1"}));
}

TEST_F(UnitEdits, ChangeSeveralInOneStep) {
  act({{"action", "pin"},
       {"each", {{{"index", index("A")}, {"on", true}}, {{"index", index("G1-1-1")}, {"on", true}}}}});
  EXPECT_EQ(units()["pinned"], Json({"A", "G1-1-1"}));
  act({{"action", "change"},
       {"each",
        {{{"index", index("G1-1-1")}, {"roll_deg", 90}}, {{"index", index("G1-2-1")}, {"roll_deg", 90}}}}});
  EXPECT_EQ(units()["pinned"], Json({"A", "U1", "U2"}));
  act({{"action", "remove"},
       {"each", {{{"index", index("A")}}, {{"index", index("U1")}}, {{"index", index("B")}}}}});
  EXPECT_EQ(units()["list"].size(), 1U);
  EXPECT_EQ(units()["list"][0]["id"], "U2");
}

TEST_F(UnitEdits, RefuseWhatAPatternDecides) {
  expect_input_error([&] { mark("pin", "G1-5-1", true); }, "G1-5-1", "excluded by the pattern");
  expect_input_error([&] { act({{"action", "place"}, {"type", "t"}, {"position", {9.5, 5.5, 2.9}}}); },
                     "keep-out area");
  EXPECT_THROW(act({{"action", "place"}, {"type", "other"}, {"position", {1, 2, 2.95}}}), InputError);
  EXPECT_THROW(act({{"action", "change"}, {"index", 99}}), InputError);
  EXPECT_THROW(act({{"action", "dance"}, {"index", 0}, {"on", true}}), InputError);
}

class UnitEditsOfAnEmptyShop : public UnitEdits {
 protected:
  UnitEditsOfAnEmptyShop() : UnitEdits("}") {}
};

TEST_F(UnitEditsOfAnEmptyShop, AddTheFirstUnit) {
  EXPECT_EQ(act({{"action", "place"}, {"type", "t"}, {"position", {1, 2, 2.95}}}), "U1");
  EXPECT_EQ(units()["list"].size(), 1U);
}

}  // namespace
}  // namespace shelfbeam::serve
