#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/scene/store/list_store.hpp"

namespace shelfbeam {
namespace {

using test::Json;
using test::read;
using test::store_with;
using test::TempFolder;

std::vector<Label> labels_of(const std::string& labels, const std::string& fixture) {
  const Scene scene = make_scene(read(store_with("[{" + fixture + R"(, "labels": )" + labels + "}]")));
  return {scene.labels.begin(), scene.labels.end() - 1};  // without the one of the store itself
}

TEST(FixtureLabels, StandByCountAtPositionsOnHooksAndOnTop) {
  const std::string shelf =
      R"("type": "gondola", "id": "A", "at": [5, 5], "length": 3, "depth": 0.9, "height": 1.8,
    "material": "steel", "shelves": [0.4, 0.9], "faces": ["front"])";
  const auto counted =
      labels_of(R"({"type": "small", "count": 3, "hook": 0.25, "level_types": {"2": "large"}})", shelf);
  ASSERT_EQ(counted.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(length(counted[k].position - Vec3{5.5 + static_cast<double>(k % 3), 4.75, k < 3 ? 0.4 : 0.9}),
                0, 1e-12);
    EXPECT_EQ(counted[k].type.value, k < 3 ? 0u : 1u);
  }
  EXPECT_EQ(counted[4].id, "A-front-2-2");
  const auto placed = labels_of(R"({"type": "small", "positions": [0.1, 0.2, 2.9]})", shelf);
  ASSERT_EQ(placed.size(), 6u);
  EXPECT_NEAR(placed[2].position.x, 7.9, 1e-12);
  const auto rim =
      labels_of(R"({"type": "small", "count": 2, "faces": ["front"], "on_top": true})",
                R"("type": "freezer", "id": "F", "at": [5, 5], "length": 2, "depth": 0.8, "height": 0.9,
                             "material": "steel")");
  ASSERT_EQ(rim.size(), 2u);
  EXPECT_NEAR(length(rim[0].position - Vec3{5.5, 5.03, 0.91}), 0, 1e-12);
  EXPECT_EQ(rim[0].normal, (Vec3{0, 0, 1}));
}

TEST(FixtureLabels, RefuseFaultsWithTheirPlace) {
  const std::string shelf =
      R"("type": "gondola", "id": "A", "at": [5, 5], "length": 3, "depth": 0.9, "height": 1.8,
    "material": "steel", "shelves": [0.4, 0.9])";
  for (const auto& [labels, message] : std::vector<std::pair<const char*, const char*>>{
           {R"({"type": "small"})", "labels: must have one of 'spacing', 'count' and 'positions'"},
           {R"({"type": "small", "count": 2, "spacing": 1})", "labels: must have one of"},
           {R"({"type": "small", "positions": [0.1, 3.1]})",
            "labels.positions[1]: is beyond the edge of 3 m"},
           {R"({"type": "small", "count": 2, "level_types": {"3": "large"}})",
            "labels.level_types: names level 3, but the fixture has 2"},
           {R"({"type": "small", "count": 2, "level_types": {"low": "large"}})",
            "labels.level_types.low: is not the number of a level"},
           {R"({"type": "small", "count": 2, "on_top": true})", "labels: has the unknown key 'on_top'"},
           {R"({"type": "small", "count": 2, "level_types": {"1": "large", "01": "small"}})",
            "labels.level_types.01: "}})
    test::expect_input_error([&, &json = labels] { labels_of(json, shelf); }, std::string_view(message));
}

TEST(Planogram, RefusesFaultsWithTheirLine) {
  const TempFolder folder;
  Json store =
      store_with(R"([{"type": "gondola", "id": "A", "at": [5, 5], "length": 3, "depth": 0.9, "height": 1.8,
    "material": "steel", "shelves": [0.4, 0.9], "faces": ["front"]},
    {"type": "box", "id": "B", "min": [1, 1, 0], "max": [2, 2, 1], "material": "steel"},
    {"type": "gondola", "id": "D", "at": [5, 9], "length": 3, "depth": 0.9, "height": 1.8, "material": "steel",
     "shelves": []}])");
  store["planogram"] = {{"file", "p.csv"}, {"type", "small"}};
  for (const auto& [row, message] : std::vector<std::pair<std::string, const char*>>{
           {"1,C,front,1,0.5", "names the unknown fixture 'C'"},
           {"1,B,front,1,0.5", "names a fixture without boards"},
           {"1,A,back,1,0.5", "is 'back'; use a face of the fixture: front"},
           {"1,D,front,1,0.5", "names a fixture without boards"},
           {"1,A,front,3,0.5", "use a whole number from 1 to 2"},
           {"1,A,front,1.5,0.5", "use a whole number from 1 to 2"},
           {"1,A,front,1,3.5", "the edge extends from 0 to 3 m"},
           {"1,A,front,1", "5 are expected"}}) {
    folder.write("p.csv", "article,fixture,face,level,x,facings\n0,A,front,2,0,3\n" + row + "\n");
    test::expect_input_error([&] { read(store, folder.path()); }, std::string_view("p.csv: line 3"),
                             std::string_view(message));
  }
  folder.write("p.csv", "article,fixture,level,x\n");
  test::expect_input_error([&] { read(store, folder.path()); }, std::string_view("has no column 'face'"));
  folder.write("p.csv", "article,fixture,face,level,x,level\n");
  test::expect_input_error([&] { read(store, folder.path()); },
                           std::string_view("has several columns 'level'"));
  folder.write("p.csv", "article,fixture,face,level,x,type\n1,A,front,1,1,huge\n");
  test::expect_input_error([&] { read(store, folder.path()); },
                           std::string_view("p.csv: line 2: names the unknown label type 'huge'"));
}

TEST(Planogram, ComesFromSpreadsheets) {
  const TempFolder folder;
  Json store =
      store_with(R"([{"type": "gondola", "id": "A", "at": [5, 5], "length": 3, "depth": 0.9, "height": 1.8,
    "material": "steel", "shelves": [0.4, 0.9], "faces": ["front"]}])");
  store["labels"] = Json::array();
  store["planogram"] = {{"file", "p.csv"}, {"type", "small"}};
  const auto warnings = [&](const std::string& text) {
    folder.write("p.csv", text);
    return sentences(make_scene(read(store, folder.path())).warnings);
  };
  const std::string plain = "article,fixture,face,level,position\n1,A,front,2,1\n2,A,front,2,2\n";
  const std::vector<std::string> usual = warnings(plain);
  EXPECT_EQ(warnings("Article;FIXTURE;Face;Level;Position\r\n1;A;Front;2;1\r\n2;A;FRONT;2;2\r\n"), usual);
  const std::vector<std::string> changed =
      warnings("article,fixture,face,level,position\n\"4,00638E+12\",A,front,2,1\n#REF!,A,front,2,2\n");
  ASSERT_EQ(changed.size(), usual.size() + 1);
  EXPECT_NE(changed[0].find(
                "p.csv: has ids that look as if a spreadsheet has changed them: '4,00638E+12' in line 2, "
                "'#REF!' in line 3;"),
            std::string::npos)
      << changed[0];
  folder.write("p.csv", "artikle,fixture,face,level,position\n1,A,front,2,1\n");
  test::expect_input_error([&] { read(store, folder.path()); }, std::string_view("has no column 'article'"),
                           std::string_view("rename 'artikle' if it is meant"));
  folder.write("p.csv", "article,Article,fixture,face,level,position\n1,1,A,front,2,1\n");
  test::expect_input_error([&] { read(store, folder.path()); },
                           std::string_view("several columns 'article'"));
}

TEST(Planogram, LabelsHaveTheirTypeHookAndTilt) {
  const TempFolder folder;
  Json store =
      store_with(R"([{"type": "gondola", "id": "A", "at": [5, 5], "length": 3, "depth": 0.9, "height": 1.8,
    "material": "steel", "shelves": [0.4, 0.9], "faces": ["front"]}])");
  store["labels"] = Json::array();
  store["planogram"] = {{"file", "p.csv"}, {"type", "small"}, {"hook", 0.2}, {"tilt_deg", 30}};
  folder.write("p.csv", "article,fixture,face,level,x,type\n1,A,front,2,1,large\n2,A,front,2,2,\n");
  const Scene scene = make_scene(read(store, folder.path()));
  ASSERT_EQ(scene.labels.size(), 2U);
  EXPECT_EQ(scene.label_types[scene.labels[0].type.value].name, "large");
  EXPECT_EQ(scene.label_types[scene.labels[1].type.value].name, "small");
  EXPECT_NEAR(length(scene.labels[0].position - Vec3{6, 4.8, 0.9}), 0, 1e-12);
  EXPECT_NEAR(length(scene.labels[0].normal - Vec3{0, -std::cos(radians(30)), 0.5}), 0, 1e-12);
}

TEST(Planogram, CountsInTheMemoryOfTheScene) {
  const TempFolder folder;
  std::string rows = "article,fixture,face,level,x\n";
  for (int k = 0; k < 150'000; ++k) rows += std::to_string(k) + ",A,front,1,0.5\n";
  folder.write("p.csv", rows);
  Json store =
      store_with(R"([{"type": "gondola", "id": "A", "at": [5, 5], "length": 3, "depth": 0.9, "height": 1.8,
    "material": "steel", "shelves": [0.4]}])");
  store["planogram"] = {{"file", "p.csv"}, {"type", "small"}};
  constexpr std::size_t memory = 100'000'000;
  test::expect_input_error([&] { parse_store(store.dump(), "store.json", folder.path(), {false, memory}); },
                           std::string_view("p.csv: line "),
                           std::string_view("the store up to here requires about 0.1 GB"));
}

}  // namespace
}  // namespace shelfbeam
