#include "serve/live/shop.hpp"

#include <cstring>

#include "shelfbeam/base/error.hpp"

#include "unit/serve/live/examples.hpp"

namespace shelfbeam::serve {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// What a page keeps of the devices, changed by frames as a page does.
class Devices {
 public:
  void take(const std::string& frame) {
    std::uint32_t size = 0;
    std::memcpy(&size, frame.data(), sizeof(size));
    const Json header = Json::parse(frame.substr(4, size));
    const std::size_t from = header["about"]["from"], remove = header["about"]["remove"];
    ASSERT_LE(from + remove, all_.size());
    std::vector<std::string> fresh(header["arrays"][2]["count"].get<std::size_t>());
    std::size_t at = 4 + size;
    for (const Json& array : header["arrays"]) {
      const std::size_t bytes = array["type"] == "u8" ? 1 : 4;
      const std::size_t each =
          bytes * array["count"].get<std::size_t>() / std::max<std::size_t>(1, fresh.size());
      for (std::string& device : fresh) device += frame.substr(at, each), at += each;
    }
    EXPECT_EQ(at, frame.size());
    const auto begin = all_.begin() + static_cast<std::ptrdiff_t>(from);
    all_.insert(all_.erase(begin, begin + static_cast<std::ptrdiff_t>(remove)), fresh.begin(), fresh.end());
  }
  bool operator==(const Devices&) const = default;

 private:
  std::vector<std::string> all_;
};

// What a page shows.
struct Page {
  std::map<std::string, Json> parts;
  Devices labels, units;

  void take(const ShopChanges& changes) {
    for (const Json& part : changes.parts["set"]) parts[part["key"]] = part;
    for (const Json& key : changes.parts["remove"]) EXPECT_EQ(parts.erase(key), 1U);
    if (changes.labels) labels.take(*changes.labels);
    if (changes.units) units.take(*changes.units);
  }
  bool operator==(const Page&) const = default;
};

Page page_of(const Shop& shop) {
  Page page;
  for (const Json& part : shop.parts()) page.parts[part["key"]] = part;
  if (shop.label_count() > 0) page.labels.take(shop.labels(1));
  if (shop.unit_count() > 0) page.units.take(shop.units(1));
  return page;
}

TEST(Shop, HasThePartsOfTheStore) {
  EditedShop shop("market-hall");
  const ShopChanges changes = shop.update(read_file(example("market-hall")));
  EXPECT_EQ(changes.parts["set"], shop.parts());
  EXPECT_THAT(changes.parts["remove"], IsEmpty());
  EXPECT_THAT(shop.problems(), IsEmpty());
  std::map<std::string, std::size_t> kinds;
  for (const Json& part : shop.parts()) {
    ++kinds[part["kind"]];
    EXPECT_TRUE(shop.json().contains(Json::json_pointer(part["path"]))) << part;
    EXPECT_EQ(part["locked"].is_null(), part["key"].get<std::string>().find('#') == std::string::npos);
    if (part["kind"] != "wall") continue;
    const Json& wall = shop.json()[Json::json_pointer(part["path"])];
    EXPECT_EQ(part.value("holes", Json::array()).size(), wall.value("openings", Json::array()).size())
        << part;
  }
  EXPECT_EQ(kinds["room"], 1U);
  EXPECT_EQ(kinds["faces"], shop.store["transceivers"]["on"].size()) << "of candidates";
  for (const char* kind : {"fixture", "zone", "wall"}) EXPECT_GT(kinds[kind], 0U) << kind;
  EXPECT_EQ(shop.label_count(), 343U);
  EXPECT_EQ(shop.unit_count(), 94U);
}

// A page that applies every change shows the same as a page that is opened at the end.
TEST(Shop, ChangesAddUp) {
  EditedShop shop;
  Page page;
  page.take(shop.update());
  std::mt19937 random(51);
  const auto number = [&](std::size_t below) {
    return std::uniform_int_distribution<std::size_t>(0, below - 1)(random);
  };
  Json& fixtures = shop.store["fixtures"];
  const Json original = fixtures;
  std::size_t differences = 0;
  for (int edit = 0; edit < 30; ++edit) {
    const std::size_t k = number(fixtures.size());
    switch (number(5)) {
      case 0:
        if (fixtures[k].contains("at")) fixtures[k]["at"][0] = 0.01 * static_cast<double>(number(1000));
        break;
      case 1:
        fixtures.erase(k);
        break;
      case 2:
        fixtures.insert(fixtures.begin() + static_cast<std::ptrdiff_t>(k), original[number(original.size())]);
        break;
      case 3:
        fixtures[k]["material"] = "no such material";
        break;
      default:
        fixtures = original;
    }
    page.take(shop.update());
    const Page fresh = page_of(shop);
    ASSERT_EQ(page.parts, fresh.parts);
    ASSERT_TRUE(page == fresh) << edit;
    // Elements with problems keep their last outlines; all other parts are those of the text alone.
    EditedShop other;
    other.update(shop.store.dump());
    for (const Json& part : other.parts())
      if (!part.contains("unfinished")) {
        ASSERT_EQ(page.parts[part["key"]], part);
      }
    differences += other.problems().empty() ? 0 : 1;
  }
  EXPECT_GT(differences, 5U) << "half-drawn shops are among them";
}

TEST(Shop, KeepsTheLastOutlineOfAnElementWithProblems) {
  EditedShop shop;
  Json& freezer = shop.store["fixtures"][8];
  shop.update();
  const Json before = shop.part("fixtures/8");
  ASSERT_EQ(before["id"], "F1");
  ASSERT_FALSE(before.contains("unfinished"));
  freezer["length"] = -3;
  shop.update();
  EXPECT_EQ(shop.problems()[0]["pointer"], "/fixtures/8/length");
  Json kept = before;
  kept["unfinished"] = true;
  EXPECT_EQ(shop.part("fixtures/8"), kept);
  // It follows its place, and is kept over further edits.
  freezer["at"][0] = freezer["at"][0].get<double>() + 2;
  shop.update();
  const Json moved = shop.part("fixtures/8");
  for (const char* corner : {"/outline/0", "/footing/at"}) {
    const Json::json_pointer at(corner);
    EXPECT_NEAR(moved[at][0].get<double>(), before[at][0].get<double>() + 2, 1e-9) << corner;
    EXPECT_EQ(moved[at][1], before[at][1]) << corner;
  }
  shop.store["fixtures"].erase(8);
  shop.update();
  EXPECT_THAT(shop.problems(), IsEmpty());
  EXPECT_NE(shop.part("fixtures/8")["id"], "F1");
}

TEST(Shop, ShowsAFixtureThatNeverHadAnOutline) {
  EditedShop shop;
  Json& fixtures = shop.store["fixtures"];
  fixtures[8]["length"] = -3;
  fixtures.push_back({{"type", "box"}, {"id", "new"}});
  fixtures.push_back(7);
  shop.update();
  const Json square = shop.part("fixtures/8");
  EXPECT_EQ(square["outline"], Json::parse("[[6, 14.2], [7, 14.2], [7, 15.2], [6, 15.2]]"));
  EXPECT_EQ(square["unfinished"], true);
  EXPECT_EQ(shop.part(fmt::format("fixtures/{}", fixtures.size() - 2))["outline"][0], (Json{12.5, 9.0}));
  EXPECT_EQ(shop.part(fmt::format("fixtures/{}", fixtures.size() - 1))["id"], "");
}

TEST(Shop, KnowsTheFixturesBehindOneThatIsWrong) {
  EditedShop shop;
  shop.store = Json::parse(R"({"materials": {"w": {"type": "lambertian", "reflectance": 0.5}}, "fixtures": [
      {"type": "box", "id": "a", "at": [1, 1, 0], "size": [1, 1, 1], "material": "w"},
      {"type": "box", "id": "a", "at": [2, 2, 0], "size": [1, 1, 1], "material": "w"},
      {"type": "box", "id": "b", "at": [3, 3, 0], "size": [1, 1, 1], "material": "w"},
      {"type": "box", "id": "c", "at": [4, 4, 0], "size": [1, 1, 1], "material": "none"}]})");
  shop.update();
  EXPECT_FALSE(shop.problems().empty());
  for (const Json& part : shop.parts()) EXPECT_EQ(part["footing"]["at"], part["outline"][0]) << part;
  EXPECT_TRUE(shop.parts().back()["unfinished"].get<bool>());
  EXPECT_EQ(shop.parts().size(), 4U);
}

TEST(Shop, KnowsTheCopyWithAProblem) {
  EditedShop shop;
  shop.store["fixtures"][0]["id"] = "A2-west";
  shop.update();
  ASSERT_EQ(shop.part("fixtures/4#2")["id"], "A2-west");
  ASSERT_FALSE(shop.problems().empty());
  EXPECT_EQ(shop.problems()[0]["pointer"], "/fixtures/4");
  EXPECT_EQ(shop.problems()[0]["key"], "fixtures/4#2");
  Json other{{"path", "fixtures[4] (copy 'A3-west')"}}, whole{{"path", "fixtures[4].repeat"}};
  shop.locate(other);
  EXPECT_EQ(other["key"], "fixtures/4#3");
  shop.locate(whole);
  EXPECT_FALSE(whole.contains("key"));
}

TEST(Shop, DescribesDevicesAndFixtures) {
  EditedShop shop;
  shop.update();
  const Json label = shop.label(0), unit = shop.unit(0);
  EXPECT_TRUE(label["path"].get<std::string>().starts_with("/fixtures/")) << label;
  EXPECT_TRUE(unit["path"].get<std::string>().starts_with("/transceivers/")) << unit;
  const Json hits = shop.find(label["id"]);
  ASSERT_FALSE(hits.empty());
  EXPECT_EQ(hits[0]["kind"], "label");
  EXPECT_EQ(hits[0]["index"], 0);
  EXPECT_LE(shop.find("").size(), 50U);
  const Json details = shop.details("/fixtures/0");
  EXPECT_EQ(details["effective"]["type"], details["resolved"]["type"]);
  EXPECT_EQ(details["inherited"]["length"], details["effective"]["length"]);
  EXPECT_FALSE(details["inherited"].contains("id"));
  const Json presets = shop.presets();
  EXPECT_EQ(presets["end"]["effective"]["type"], "gondola") << "a key of its own preset";
  EXPECT_EQ(presets["end"]["effective"]["length"], 0.9);
  EXPECT_TRUE(presets["end"]["units"].empty());
  for (const char* wrong : {"/fixtures/999", "/fixtures/x", "/fixtures/", "/room", ""})
    EXPECT_THROW(shop.details(wrong), InputError) << wrong;
  shop.update(R"({"fixtures": [{"preset": "none", "id": "a"}]})");
  EXPECT_THROW(shop.details("/fixtures/0"), InputError) << "of a store without presets";
}

TEST(Shop, HasTheSurfacesForTheView) {
  EditedShop shop;
  shop.update();
  const std::string frame = shop.scene(1);
  EXPECT_NE(frame.find("\"mesh_triangle\""), std::string::npos);
  EXPECT_GT(frame.size(), 90'000U);
}

TEST(Shop, ShowsWhatCannotBeResolvedAsAProblem) {
  EditedShop shop;
  shop.update(R"({"fixtures": [{"type": "box", "id": "a{n}", "at": [0, 0, 0], "size": [1, 1, 1],
                                "material": "w", "repeat": {"count": 10000, "step": [0.001, 0]}},
                               {"type": "box", "id": "b{n}", "at": [0, 0, 0], "size": [1, 1, 1],
                                "material": "w", "repeat": {"count": 10000, "step": [0.001, 0]}}],
                  "materials": {"w": {"type": "lambertian", "reflectance": 0.5}}})");
  EXPECT_THAT(sentences(shop.draft().problems), Contains(HasSubstr("fixtures[1]: makes 20,000 fixtures")));
  EXPECT_EQ(shop.parts().size(), 10'001U) << "with a square for the second";
}

// Both the limits of candidates and of memory leave out these candidates alone.
TEST(Shop, ShowsAShopWithNarrowSpacings) {
  EditedShop shop("market-hall");
  shop.update();
  const std::size_t parts = shop.parts().size(), units = shop.unit_count();
  shop.store["transceivers"]["areas"][0]["spacing"] = 0.001;
  shop.update();
  EXPECT_THAT(sentences(shop.draft().problems), SizeIs(1));
  EXPECT_EQ(shop.parts().size(), parts);
  EXPECT_LT(shop.unit_count(), units);
  EXPECT_GT(shop.unit_count(), 0U);
  shop.store["transceivers"]["areas"][0]["spacing"] = 1;
  shop.store["transceivers"]["grids"] = {
      {{"type", "dome"}, {"min", {1, 1}}, {"max", {9, 9}}, {"spacing", 0.01}, {"z", 2.5}}};
  shop.update();
  EXPECT_THAT(sentences(shop.draft().problems), Contains(HasSubstr("requires about")));
  EXPECT_EQ(shop.parts().size(), parts + 1);
  EXPECT_GT(shop.unit_count(), 0U);
}

TEST(Shop, ShowsTheUnitsOfAShopWithManyProblems) {
  EditedShop shop;
  shop.update();
  const std::size_t units = shop.unit_count();
  for (int k = 0; k < 150; ++k) {
    shop.store["fixtures"].push_back({{"type", "box"},
                                      {"id", fmt::format("new-{}", k)},
                                      {"at", {1, 1, 0}},
                                      {"size", {1, 1, 1}},
                                      {"material", "none"}});
    shop.store["transceivers"]["list"].push_back(  // outside the room
        {{"id", fmt::format("far-{}", k)}, {"position", {-5, k, 3}}, {"type", "ceiling"}});
  }
  shop.update();
  EXPECT_EQ(shop.unit_count(), units + 150);
  EXPECT_THAT(sentences(shop.draft().problems), SizeIs(testing::Ge(100)));
}

// A preset's name stands in the locations of messages.
TEST(Shop, LocksNoFixtureBecauseOfTheNameOfItsPreset) {
  EditedShop shop;
  shop.store["presets"]["a (copy 1"] = shop.store["presets"]["row"];
  shop.store["fixtures"][0]["preset"] = "a (copy 1";
  shop.update();
  EXPECT_THAT(shop.draft().problems, IsEmpty());
  const Json first = shop.part("fixtures/0");
  ASSERT_FALSE(first.is_null());
  EXPECT_TRUE(first["locked"].is_null()) << first;
}

TEST(Shop, UprightMeasuringPlanesAreAsHighAsTheirTop) {
  EditedShop shop;
  shop.store["measuring_planes"] = {{{"id", "P"},
                                     {"type", "standard"},
                                     {"origin", {12, 9, 0.5}},
                                     {"axes", {{1, 0, 0}, {0, 0, 1}}},
                                     {"size", {1, 2}},
                                     {"spacing", 1}}};
  shop.update();
  const Json plane = shop.part("measuring_planes/0");
  ASSERT_FALSE(plane.is_null());
  EXPECT_DOUBLE_EQ(plane["height"].get<double>(), 2.5);
}

TEST(Shop, OutlinesFixturesByAWallThatIsMissing) {
  EditedShop shop;
  for (const Json& wall : {Json(99), Json(-1), Json("x"), Json(0.5)}) {
    shop.store["fixtures"] = Json::array(
        {{{"type", "gondola"}, {"id", "g"}, {"length", 2}, {"depth", 1}, {"against", {{"wall", wall}}}}});
    EXPECT_NO_THROW(shop.update()) << wall;
    EXPECT_FALSE(shop.draft().problems.empty());
  }
  shop.store.erase("room");
  EXPECT_NO_THROW(shop.update());
}

using Random = std::mt19937_64;

std::size_t below(std::size_t count, Random& random) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

// All values below the document itself.
std::vector<Json*> values_of(Json& json) {
  std::vector<Json*> all;
  if (!json.is_structured()) return all;
  for (Json& value : json) {
    all.push_back(&value);
    const std::vector<Json*> deeper = values_of(value);
    all.insert(all.end(), deeper.begin(), deeper.end());
  }
  return all;
}

// Gives one value another kind or size, or that of another place.
void mutate(Json& store, Random& random) {
  static const std::array<Json, 15> values{nullptr,       true,           -1,        0,   1,  99,
                                           1e9,           -0.5,           0.01,      "x", "", "{n}",
                                           Json::array(), Json::object(), Json{0, 0}};
  const std::vector<Json*> all = values_of(store);
  Json& one = *all[below(all.size(), random)];
  const std::size_t choice = below(values.size() + 6, random);
  if (choice < values.size()) {
    one = values[choice];
  } else if (choice < values.size() + 3) {
    one = Json(*all[below(all.size(), random)]);
  } else if (one.is_structured() && !one.empty()) {
    auto gone = one.begin();
    std::advance(gone, below(one.size(), random));
    one.erase(gone);
  }
}

void use(const Shop& shop) {
  std::set<std::string> keys;
  for (const Json& part : shop.parts()) EXPECT_TRUE(keys.insert(part["key"].get<std::string>()).second);
  const auto fixtures = shop.json().find("fixtures");
  const std::size_t count = fixtures == shop.json().end() ? 0 : fixtures->size();
  for (std::size_t k = 0; k <= count; ++k) {
    const std::string pointer = fmt::format("/fixtures/{}", k);
    try {
      shop.details(pointer);
      shop.dissolved(pointer);
    } catch (const InputError&) {  // has problems, or is not there
    }
  }
  for (std::size_t k = 0; k < shop.label_count(); k += 97) shop.label(k);
  for (std::size_t k = 0; k < shop.unit_count(); k += 97) shop.unit(k);
  shop.problems();
  shop.names();
  shop.find("a");
  try {
    shop.scene(1);
  } catch (const InputError&) {  // exceeds the memory
  }
}

void expect_any_store_is_shown(int count, std::uint64_t seed) {
  Random random(seed);
  for (const char* name : {"grocery", "chiller", "market-hall"}) {
    EditedShop shop(name);
    const Json whole = shop.store;
    for (int k = 0; k < count; ++k) {
      shop.store = whole;
      for (std::size_t m = 0; m <= below(3, random); ++m) mutate(shop.store, random);
      SCOPED_TRACE(testing::Message() << name << " " << k);
      ASSERT_NO_THROW(shop.update()) << shop.store.dump();
      for (const Finding& problem : shop.draft().problems)
        EXPECT_EQ(problem.sentence.find("cannot be shown"), std::string::npos) << problem.sentence;
      ASSERT_NO_THROW(use(shop)) << shop.store.dump();
    }
  }
}

TEST(ShopMutations, AreShown) {
  expect_any_store_is_shown(12, 1);
}

TEST(LongShopMutations, AreShown) {
  expect_any_store_is_shown(400, 2);
}

}  // namespace
}  // namespace shelfbeam::serve
