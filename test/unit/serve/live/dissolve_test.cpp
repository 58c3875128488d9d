#include "serve/live/dissolve.hpp"

#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

#include "serve/live/shop.hpp"

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
    const fs::path file = fs::path(SHELFBEAM_SOURCE_DIR "/examples") / name / "store.json";
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

}  // namespace
}  // namespace shelfbeam::serve
