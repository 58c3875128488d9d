#include "shelfbeam/base/fields/problems.hpp"
#include "shelfbeam/math/warp.hpp"

#include "support/testing.hpp"
#include "unit/scene/mistakes.hpp"
#include "unit/scene/sample_store.hpp"

// The reader reports every problem of a store, and no consequence of one as a further problem.

namespace shelfbeam::test {
namespace {

std::vector<std::string> paths_of(const Json& store) {
  Problems problems("store.json");
  parse_store(store.dump(), "store.json", SHELFBEAM_SOURCE_DIR "/data/photometry", {}, &problems);
  std::vector<std::string> paths;
  for (const Finding& problem : problems.all()) {
    EXPECT_TRUE(problem.sentence.starts_with("store.json: ")) << problem.sentence;
    paths.push_back(problem.path);
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(AllProblems, OfStoresWithUpTo20PlantedMistakes) {
  ASSERT_EQ(paths_of(sample_store()), std::vector<std::string>());
  std::mt19937 random(49);
  std::map<std::string, int> times;
  for (int k = 0; k < 500; ++k) {
    std::vector<Json> planted = mistakes();
    std::shuffle(planted.begin(), planted.end(), random);
    planted.resize(1 + static_cast<std::size_t>(k) % 20);
    Json store = sample_store();
    std::vector<std::string> expected;
    for (const Json& mistake : planted) {
      const std::string pointer = mistake[0];
      store[Json::json_pointer(pointer)] = mistake[1];
      expected.push_back(mistake[2]);
      ++times[pointer];
    }
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(paths_of(store), expected) << store.dump(1);
  }
  EXPECT_EQ(times.size(), mistakes().size()) << "each of them was planted";
}

TEST(AllProblems, OfTheRulesOfAMaterial) {
  Json store = sample_store();
  store["materials"]["chrome"] = {
      {"type", "conductor"},         {"eta", 0},       {"k", 0}, {"roughness", 0.2}, {"distribution", "ggx"},
      {"masking", "smith_rational"}, {"colour", "red"}};
  store["materials"]["foil"] = {
      {"type", "conductor"}, {"eta", 1}, {"k", 1}, {"masking", "smith"}, {"sampling", "all"}};
  EXPECT_EQ(paths_of(store),
            (std::vector<std::string>{"materials.chrome", "materials.chrome", "materials.chrome.masking",
                                      "materials.foil.masking", "materials.foil.sampling"}));
}

// Rules that tie the parts of a room together apply to all parts without a problem of their own.
TEST(AllProblems, OfThePartsOfARoom) {
  Json store = sample_store();
  const auto zone = [](const char* id, double x) {
    return Json{{"id", id}, {"polygon", {{x, 1}, {x + 1, 1}, {x + 1, 2}}}, {"height", 2.5}};
  };
  store["room"]["zones"] = {zone("room", 0), zone("low", 1), zone("low", 2), zone("high", 7.5),
                            zone("last", 1)};
  store["room"]["zones"][4]["height"] = "high";
  store["room"]["inner_walls"] = {{{"id", "W"}, {"from", {5, 0}}, {"to", {5, 0}}}};
  EXPECT_EQ(paths_of(store),
            (std::vector<std::string>{"room.inner_walls[0].to", "room.zones[0].id", "room.zones[2].id",
                                      "room.zones[3].polygon", "room.zones[4].height"}));
  store["room"].erase("zones");
  const auto opening = [](double at) { return Json{{"at", at}, {"width", 1}, {"top", 2}}; };
  store["room"]["inner_walls"].push_back({{"id", "V"}, {"from", {5, 1}}, {"to", {5, 5}}});
  store["room"]["inner_walls"][1]["openings"] = {opening(0), opening(0.5), opening(3.5)};
  EXPECT_EQ(paths_of(store),
            (std::vector<std::string>{"room.inner_walls[0].to", "room.inner_walls[1].openings[1]",
                                      "room.inner_walls[1].openings[2]"}));
  store["room"]["outline"] = {{0, 0}, {1, 0}, {0, 1}};
  EXPECT_EQ(paths_of(store),
            (std::vector<std::string>{"room.inner_walls[0].to", "room.inner_walls[1].openings[1]",
                                      "room.inner_walls[1].openings[2]", "room.outline"}))
      << "the rules of a wall hold in any room";
}

TEST(AllProblems, OfHolesAndWallsByNumber) {
  Json store = sample_store();
  Json& room = store["room"];
  room = {{"outline", {{0, 0}, {8, 0}, {8, 6}, {0, 6}}},
          {"height", 3},
          {"floor", "tile"},
          {"ceiling", "white"},
          {"walls", "white"}};
  ASSERT_EQ(paths_of(store), std::vector<std::string>());
  room["holes"] = {{{20, 1}, {21, 1}, {21, 2}}, {{30, 1}, {31, 1}, {31, 2}}};
  room["wall_materials"] = {{"7", "white"}, {"9", "white"}};
  EXPECT_EQ(paths_of(store), (std::vector<std::string>{"room.holes[0]", "room.holes[1]",
                                                       "room.wall_materials.7", "room.wall_materials.9"}));
}

// A limit on all parts together is reported once.
TEST(AllProblems, OfTooManyCornersAreOne) {
  Json store = sample_store();
  for (int k = 0; k < 120; ++k) {
    const int column = k % 25, row = k / 25;
    Json polygon = Json::array();
    for (int c = 0; c < 200; ++c) {
      const double angle = 2 * pi * c / 200;
      polygon.push_back(
          {0.2 + 0.19 * column + 0.05 * std::cos(angle), 0.2 + 0.1 * row + 0.04 * std::sin(angle)});
    }
    store["room"]["zones"].push_back({{"id", std::to_string(k)}, {"polygon", polygon}, {"height", 2.5}});
  }
  EXPECT_EQ(paths_of(store).size(), 1U);
}

// What depends on an element with a problem has none of its own.
TEST(AllProblems, AreNoneOfTheReferencesToAnElementWithAProblem) {
  Json store = sample_store();
  store["materials"] = 7;
  EXPECT_EQ(paths_of(store), std::vector<std::string>{"materials"});
  store = sample_store();
  store["fixtures"][0]["length"] = -1;
  store["fixtures"].push_back({{"type", "freezer"},
                               {"id", "next"},
                               {"against", {{"fixture", store["fixtures"][0]["id"]}, {"side", "left"}}},
                               {"length", 1},
                               {"depth", 1},
                               {"height", 1},
                               {"material", "white"}});
  EXPECT_EQ(paths_of(store), std::vector<std::string>{"fixtures[0].length"});
  store["fixtures"].back()["against"]["fixture"] = "no such fixture";
  EXPECT_EQ(paths_of(store),
            (std::vector<std::string>{
                "fixtures[0].length",
                "fixtures[" + std::to_string(store["fixtures"].size() - 1) + "].against.fixture"}));
}

// With codes and values, for programs.
TEST(AllProblems, HaveCodesAndValues) {
  Json store = sample_store();
  store["fixtures"][1]["stocking"] = 3;
  store["labels"][0]["type"] = "none";
  Problems problems("store.json");
  parse_store(store.dump(), "store.json", SHELFBEAM_SOURCE_DIR "/data/photometry", {}, &problems);
  ASSERT_EQ(problems.all().size(), 2u);
  EXPECT_EQ(problems.all()[0].code, FindingCode::outside_limits);
  EXPECT_EQ(problems.all()[0].values, (FindingValues{3.0, 0.0, 1.0}));
  EXPECT_EQ(problems.all()[1].code, FindingCode::unknown_name);
  EXPECT_EQ(problems.all()[1].values, FindingValues{"none"});
}

TEST(Ignore, CountsTheWarningsOfAnElement) {
  Json store = sample_store();
  const auto read = [&] { return scene_of(store, SHELFBEAM_SOURCE_DIR "/data/photometry"); };
  const std::size_t usual = read().warnings.size();
  store["labels"][0]["position"] = {7.25, 0.25, 1};  // in the box
  const Scene warned = read();
  ASSERT_EQ(warned.warnings.size(), usual + 1);
  const auto found = std::ranges::find(warned.warnings, FindingCode::label_inside_fixture, &Finding::code);
  ASSERT_NE(found, warned.warnings.end());
  EXPECT_EQ(found->path, "labels[0]");
  EXPECT_EQ(warned.ignored_warnings, 0u);
  store["labels"][0]["ignore"] = {"label_inside_fixture"};
  EXPECT_EQ(read().warnings.size(), usual);
  EXPECT_EQ(read().ignored_warnings, 1u);
  store["labels"][0]["ignore"] = {"label_in_mid_air"};
  EXPECT_EQ(read().warnings.size(), usual + 1) << "another code";
  store["labels"][0].erase("ignore");
  store["ignore"] = {"label_inside_fixture"};
  EXPECT_EQ(read().ignored_warnings, 1u) << "for the whole store";
  store["ignore"] = {"label_inside_fixtures"};
  EXPECT_EQ(paths_of(store), std::vector<std::string>{""});
}

}  // namespace
}  // namespace shelfbeam::test
