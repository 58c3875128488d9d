#include "serve/live/dissolve.hpp"

#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

#include "serve/live/shop.hpp"
#include "support/temp_folder.hpp"
#include "unit/serve/live/examples.hpp"

namespace shelfbeam::serve {
namespace {

namespace fs = std::filesystem;

std::map<std::string, Vec3> labels_of(const Shop& shop) {
  std::map<std::string, Vec3> places;
  for (const Label& label : shop.draft().scene.labels) places[label.id] = label.position;
  return places;
}

// Fixtures with places of their own stand where the copies stood.
TEST(Dissolved, FixturesAreWhereTheyWere) {
  int dissolved = 0;
  for (const char* name : {"grocery", "market-hall", "chiller", "supermarket"}) {
    const fs::path file = test::example(name);
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
  const test::TempFolder folder;
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

}  // namespace
}  // namespace shelfbeam::serve
