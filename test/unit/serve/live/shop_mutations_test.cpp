#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json_parser.hpp"

#include "serve/live/shop.hpp"
#include "unit/serve/live/examples.hpp"

namespace shelfbeam::serve {
namespace {

using test::example;
using test::example_json;
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
    const std::string pointer = "/fixtures/" + std::to_string(k);
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
    const Json whole = example_json(name);
    Shop shop(example(name));
    for (int k = 0; k < count; ++k) {
      Json store = whole;
      for (std::size_t m = 0; m <= below(3, random); ++m) mutate(store, random);
      SCOPED_TRACE(testing::Message() << name << " " << k);
      ASSERT_NO_THROW(shop.update(store.dump(), 1)) << store.dump();
      for (const Finding& problem : shop.draft().problems)
        EXPECT_EQ(problem.sentence.find("cannot be shown"), std::string::npos) << problem.sentence;
      ASSERT_NO_THROW(use(shop)) << store.dump();
    }
  }
}

TEST(ShopMutations, AreShown) {
  expect_any_store_is_shown(40, 1);
}

TEST(LongShopMutations, AreShown) {
  expect_any_store_is_shown(400, 2);
}

TEST(Shop, ShowsWhatCannotBeResolvedAsAProblem) {
  Shop shop(example("grocery"));
  shop.update(R"({"fixtures": [{"type": "box", "id": "a{n}", "at": [0, 0, 0], "size": [1, 1, 1],
                                "material": "w", "repeat": {"count": 10000, "step": [0.001, 0]}},
                               {"type": "box", "id": "b{n}", "at": [0, 0, 0], "size": [1, 1, 1],
                                "material": "w", "repeat": {"count": 10000, "step": [0.001, 0]}}],
                  "materials": {"w": {"type": "lambertian", "reflectance": 0.5}}})",
              1);
  const std::vector<std::string> problems = sentences(shop.draft().problems);
  EXPECT_TRUE(std::any_of(problems.begin(), problems.end(), [](const std::string& sentence) {
    return sentence.find("fixtures[1]: makes 20,000 fixtures") != std::string::npos;
  }));
  EXPECT_EQ(shop.parts().size(), 10'001U) << "with a square for the second";
}

TEST(Shop, KnowsTheFixturesBehindOneThatIsWrong) {
  Shop shop(example("grocery"));
  shop.update(R"({"materials": {"w": {"type": "lambertian", "reflectance": 0.5}}, "fixtures": [
      {"type": "box", "id": "a", "at": [1, 1, 0], "size": [1, 1, 1], "material": "w"},
      {"type": "box", "id": "a", "at": [2, 2, 0], "size": [1, 1, 1], "material": "w"},
      {"type": "box", "id": "b", "at": [3, 3, 0], "size": [1, 1, 1], "material": "w"},
      {"type": "box", "id": "c", "at": [4, 4, 0], "size": [1, 1, 1], "material": "none"}]})",
              1);
  for (const Json& part : shop.parts()) EXPECT_EQ(part["footing"]["at"], part["outline"][0]) << part;
  EXPECT_TRUE(shop.parts().back()["unfinished"].get<bool>());
  EXPECT_EQ(shop.parts().size(), 4U);
}

// Both the limits of candidates and of memory leave out these candidates alone.
TEST(Shop, ShowsAShopWithNarrowSpacings) {
  Shop shop(example("market-hall"));
  Json store = example_json("market-hall");
  shop.update(store.dump(), 1);
  const std::size_t parts = shop.parts().size(), units = shop.unit_count();
  store["transceivers"]["areas"][0]["spacing"] = 0.001;
  shop.update(store.dump(), 2);
  EXPECT_THAT(sentences(shop.draft().problems), testing::SizeIs(1));
  EXPECT_EQ(shop.parts().size(), parts);
  EXPECT_LT(shop.unit_count(), units);
  EXPECT_GT(shop.unit_count(), 0U);
  store["transceivers"]["areas"][0]["spacing"] = 1;
  store["transceivers"]["grids"] = {
      {{"type", "dome"}, {"min", {1, 1}}, {"max", {9, 9}}, {"spacing", 0.01}, {"z", 2.5}}};
  shop.update(store.dump(), 3);
  EXPECT_THAT(sentences(shop.draft().problems), testing::Contains(testing::HasSubstr("requires about")));
  EXPECT_EQ(shop.parts().size(), parts + 1);
  EXPECT_GT(shop.unit_count(), 0U);
}

TEST(Shop, ShowsTheCandidatesOfAShopWithManyProblems) {
  Shop shop(example("grocery"));
  Json store = example_json("grocery");
  shop.update(store.dump(), 1);
  const std::size_t units = shop.unit_count();
  for (int k = 0; k < 150; ++k)
    store["fixtures"].push_back({{"type", "box"},
                                 {"id", "new-" + std::to_string(k)},
                                 {"at", {1, 1, 0}},
                                 {"size", {1, 1, 1}},
                                 {"material", "none"}});
  shop.update(store.dump(), 2);
  EXPECT_EQ(shop.unit_count(), units);
}

TEST(Shop, ShowsUnitsOutsideTheRoom) {
  Shop shop(example("grocery"));
  Json store = example_json("grocery");
  shop.update(store.dump(), 1);
  const std::size_t units = shop.unit_count();
  for (int k = 0; k < 300; ++k)
    store["transceivers"]["list"].push_back(
        {{"id", "far-" + std::to_string(k)}, {"position", {-5, k, 3}}, {"type", "ceiling"}});
  shop.update(store.dump(), 2);
  EXPECT_EQ(shop.unit_count(), units + 300);
  EXPECT_THAT(sentences(shop.draft().problems), testing::SizeIs(testing::Ge(100)));
}

// A preset's name stands in the locations of messages.
TEST(Shop, LocksNoFixtureBecauseOfTheNameOfItsPreset) {
  Shop shop(example("grocery"));
  Json store = example_json("grocery");
  store["presets"]["a (copy 1"] = store["presets"]["row"];
  store["fixtures"][0]["preset"] = "a (copy 1";
  shop.update(store.dump(), 1);
  EXPECT_THAT(shop.draft().problems, testing::IsEmpty());
  const Json parts = shop.parts();
  const auto first =
      std::ranges::find(parts, Json("/fixtures/0"), [](const Json& part) { return part["path"]; });
  ASSERT_NE(first, parts.end());
  EXPECT_TRUE((*first)["locked"].is_null()) << *first;
}

TEST(Shop, RefusesDetailsOfAPresetThatIsMissing) {
  Shop shop(example("grocery"));
  shop.update(R"({"fixtures": [{"id": "a", "preset": "row", "at": [1, 1]}]})", 1);
  EXPECT_THROW(shop.details("/fixtures/0"), InputError);
}

TEST(Shop, OutlinesTheFacesOfCandidates) {
  Shop shop(example("market-hall"));
  const Json store = example_json("market-hall");
  shop.update(store.dump(), 1);
  const Json parts = shop.parts();
  EXPECT_EQ(static_cast<std::size_t>(
                std::ranges::count(parts, Json("faces"), [](const Json& part) { return part["kind"]; })),
            store["transceivers"]["on"].size());
}

TEST(Shop, OutlinesFixturesByAWallThatIsMissing) {
  Shop shop(example("grocery"));
  Json store = example_json("grocery");
  for (const Json& wall : {Json(99), Json(-1), Json("x"), Json(0.5)}) {
    store["fixtures"] = Json::array(
        {{{"type", "gondola"}, {"id", "g"}, {"length", 2}, {"depth", 1}, {"against", {{"wall", wall}}}}});
    EXPECT_NO_THROW(shop.update(store.dump(), 1)) << wall;
    EXPECT_EQ(shop.draft().problems.empty(), false);
  }
  store.erase("room");
  EXPECT_NO_THROW(shop.update(store.dump(), 1));
}

}  // namespace
}  // namespace shelfbeam::serve
