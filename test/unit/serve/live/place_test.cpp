#include "serve/live/place.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace shelfbeam::serve {
namespace {

TEST(Place, PointersNameTheDeepestElement) {
  const auto store = nlohmann::ordered_json::parse(
      R"({"fixtures": [{"labels": {"spacing": 1}}], "materials": {"a.b": {"eta": 1}, "a": {}, "x/y~z": {}}})");
  EXPECT_EQ(pointer_of("fixtures[0].labels.spacing", store), "/fixtures/0/labels/spacing");
  EXPECT_EQ(pointer_of("fixtures[0].depth", store), "/fixtures/0");
  EXPECT_EQ(pointer_of("fixtures[7]", store), "/fixtures");
  EXPECT_EQ(pointer_of("materials.a.b.eta", store), "/materials/a.b/eta");
  EXPECT_EQ(pointer_of("materials.a.c", store), "/materials/a");
  EXPECT_EQ(pointer_of("materials.x/y~z", store), "/materials/x~1y~0z");
  for (const char* path :
       {"", "labels.csv:5", "[0]", "fixtures[", "fixtures[x]", "fixtures[99999999999999999999]"})
    EXPECT_TRUE(pointer_of(path, store).empty() || pointer_of(path, store) == "/fixtures") << path;
}

TEST(Place, OfResolvedElements) {
  const auto pointer = [](const std::string& where) { return entry_of(where, "my.shop.json"); };
  EXPECT_EQ(pointer("my.shop.json: fixtures[3]"), "/fixtures/3");
  EXPECT_EQ(pointer("my.shop.json: room.inner_walls[0]"), "/room/inner_walls/0");
  EXPECT_EQ(pointer("labels.csv:5"), "");
  EXPECT_EQ(pointer("my.shop.json: fixtures[3].labels[1] (copy 'A (2)')"), "/fixtures/3/labels/1");
  EXPECT_EQ(pointer("my.shop.json: fixtures[3] (preset 'run') (copy 'A1')"), "/fixtures/3");
}

}  // namespace
}  // namespace shelfbeam::serve
