#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/file.hpp"
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
    {"type": "cylinder", "id": "B", "at": [2, 2], "radius": 0.3, "top": 2, "material": "steel"},
    {"type": "box", "id": "T", "min": [8, 1, 0], "max": [9, 3, 1], "material": "steel"},
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
           {"1,T,below,1,0.5", "is 'below'; use a face of the fixture: front, back, left, right, top"},
           {"1,A,top,1,0.5", "is 'top'; use a face of the fixture: front"},
           {"1,T,front,2,0.5", "use a whole number from 1 to 1"},
           {"1,T,left,1,2.5", "the edge extends from 0 to 2 m"},
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

TEST(Planogram, HasOtherLinesAboveItsColumnsAndUnitsInItsCells) {
  const TempFolder folder;
  Json store =
      store_with(R"([{"type": "gondola", "id": "A", "at": [5, 5], "length": 3, "depth": 0.9, "height": 1.8,
    "material": "steel", "shelves": [0.4, 0.9], "faces": ["front"]}])");
  store["labels"] = Json::array();
  store["planogram"] = {{"file", "p.csv"}, {"type", "small"}};
  for (const std::string rows :
       {"1;A;front;1;0,25 m;20 cm", "1;A;front;1;25 cm;200mm", "1;A;front;1;0,25;0,2"}) {
    folder.write("p.csv",
                 "Shop, of two\nDate;01.02.2026\n\narticle;fixture;face;level;x;hook\n" + rows + "\n");
    const Scene scene = make_scene(read(store, folder.path()));
    ASSERT_EQ(scene.labels.size(), 1U);
    EXPECT_NEAR(length(scene.labels[0].position - Vec3{5.25, 4.8, 0.4}), 0, 1e-12) << rows;
  }
  folder.write("p.csv", "Shop\narticle;fixture;face;level;x\n1;A;front;1;25 kg\n");
  test::expect_input_error([&] { read(store, folder.path()); }, std::string_view("p.csv: line 3, field 5"));
}

// The table of a spreadsheet, with the program's names of columns and words of faces.
std::string field_table(const std::string& name) {
  std::string text = read_file(std::string(SHELFBEAM_SOURCE_DIR "/test/data/field4/") + name);
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"EAN", "article"},
                                                        {"Regal", "fixture"},
                                                        {"Seite", "face"},
                                                        {"Boden (von oben)", "level"},
                                                        {"Boden", "level"},
                                                        {"vorne", "front"}})
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  return text;
}

TEST(Planogram, CountsAsItsFileDoes) {
  const TempFolder folder;
  Json store = store_with("[]");
  for (std::size_t f = 0; f < 3; ++f) {
    Json gondola = Json::parse(
        R"({"type": "gondola", "at": [5, 2], "length": 3, "depth": 0.9, "height": 1.8, "material": "steel",
            "shelves": [0.4, 0.9, 1.4], "faces": ["front"]})");
    gondola["id"] = "A" + std::to_string(f + 1);
    gondola["at"][1] = 2 + 2 * f;
    store["fixtures"].push_back(gondola);
  }
  store["labels"] = Json::array();
  // `keys` of the planogram besides its file and type.
  const auto labels = [&](const std::string& text, Json keys) {
    folder.write("p.csv", text);
    keys["file"] = "p.csv";
    keys["type"] = "small";
    store["planogram"] = std::move(keys);
    std::vector<Vec3> places;
    for (const Label& label : make_scene(read(store, folder.path())).labels) places.push_back(label.position);
    return places;
  };
  const auto from_bottom = labels(
      "article,fixture,face,level,position\n1,A1,front,3,1\n2,A1,front,2,1\n3,A1,front,1,1\n"
      "4,A1,front,3,2\n5,A1,front,2,2\n6,A1,front,1,2\n",
      Json::object());
  const std::string from_top = field_table("boards_from_top.csv");
  const auto first = [](const std::vector<Vec3>& all) { return std::vector(all.begin(), all.begin() + 6); };
  EXPECT_EQ(first(labels(from_top, {{"from_top", true}})), from_bottom);
  EXPECT_NE(first(labels(from_top, Json::object())), from_bottom);

  const std::string merged = field_table("merged_cells.csv"), from_zero = field_table("places_from_zero.csv");
  folder.write("p.csv", merged);
  test::expect_input_error([&] { labels(merged, Json::object()); },
                           std::string_view("p.csv: line 3, field 3: names the unknown fixture ''"),
                           std::string_view("set 'fill_down' of 'planogram' if cells were merged"));
  test::expect_input_error([&] { labels(from_zero, Json::object()); },
                           std::string_view("use a whole number from 1 to 1000, or set 'first_position'"));
  const auto filled = labels(merged, {{"fill_down", true}});
  EXPECT_EQ(filled.size(), 18U);
  const auto sorted = [](std::vector<Vec3> places) {
    std::ranges::sort(places, {}, [](const Vec3& p) { return std::tuple(p.y, p.z, p.x); });
    return places;
  };
  EXPECT_EQ(sorted(filled), sorted(labels(from_zero, {{"first_position", 0}})));

  const std::string ground = "article,fixture,face,level,position\n1,A1,front,0,1\n2,A1,front,2,1\n";
  test::expect_input_error([&] { labels(ground, Json::object()); },
                           std::string_view("use a whole number from 1 to 3, or correct 'first_level'"));
  const auto grounded = labels(ground, {{"first_level", 0}});
  EXPECT_NEAR(grounded[0].z, 0.4, 1e-12);
  EXPECT_NEAR(grounded[1].z, 1.4, 1e-12);
  EXPECT_NEAR(labels(ground, {{"first_level", 0}, {"from_top", true}})[0].z, 1.4, 1e-12);
}

TEST(Planogram, NamesItsEncoding) {
  const TempFolder folder;
  Json store =
      store_with(R"([{"type": "gondola", "id": "K\u00FChlregal", "at": [5, 5], "length": 3, "depth": 0.9,
    "height": 1.8, "material": "steel", "shelves": [0.4, 0.9], "faces": ["front"]}])");
  store["labels"] = Json::array();
  store["planogram"] = {{"file", "p.csv"}, {"type", "small"}};
  folder.write("p.csv", "article,fixture,face,level,x\n1,K\xFChlregal,front,1,0.5\n");
  const auto warnings = [&] { return make_scene(read(store, folder.path())).warnings; };
  const std::vector<Finding> guessed = warnings();
  const auto found = std::ranges::find(guessed, FindingCode::text_encoding, &Finding::code);
  ASSERT_NE(found, guessed.end());
  EXPECT_EQ(found->values, (FindingValues{"windows-1252", "Kühlregal"}));
  store["planogram"]["encoding"] = "windows-1252";
  EXPECT_EQ(std::ranges::count(warnings(), FindingCode::text_encoding, &Finding::code), 0);
  store["planogram"]["encoding"] = "windows-1251";
  test::expect_input_error(warnings, std::string_view("names the unknown fixture 'Kьhlregal'"));
  store["planogram"]["encoding"] = "shift_jis";
  folder.write("p.csv", "article,fixture,face,level,x\n1,K\xFC\xFFhlregal,front,1,0.5\n");
  test::expect_input_error(warnings, std::string_view("p.csv: is not UTF-8, nor shift_jis; "));
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

TEST(Planogram, LabelsHaveTheStyleOfRecordFixtureOrPlanogram) {
  const TempFolder folder;
  const char* const shelf =
      R"("type": "gondola", "length": 3, "depth": 0.9, "height": 1.8, "material": "steel",
    "shelves": [0.4, 0.9], "faces": ["front"])";
  Json store = store_with(std::string("[{\"id\": \"A1\", \"at\": [5, 5], ") + shelf +
                          "}, {\"id\": \"A2\", \"at\": [5, 9], " + shelf + "}]");
  store["labels"] = Json::array();
  store["planogram"] = {{"file", "p.csv"}, {"type", "small"}, {"hook", 0.2}, {"tilt_deg", 30}};
  store["planogram"]["fixtures"] = Json::parse(R"([{"fixtures": "A?", "hook": 0.1},
    {"fixtures": "A2", "type": "large", "tilt_deg": -30}])");
  const auto labels = [&] { return make_scene(read(store, folder.path())).labels; };
  folder.write(
      "p.csv",
      "article,fixture,face,level,x,type,hook,tilt_deg\n1,A1,front,2,1,large,0.3,0\n2,A1,front,2,1,,,\n"
      "3,A2,front,2,1,\n4,A2,front,2,1,small,,60\n");
  const auto expect = [&](const Label& label, double hook, double tilt_deg, std::uint32_t type, double y) {
    EXPECT_NEAR(length(label.position - Vec3{6, y - hook, 0.9}), 0, 1e-12) << label.id;
    EXPECT_NEAR(length(label.normal - Vec3{0, -std::cos(radians(tilt_deg)), std::sin(radians(tilt_deg))}), 0,
                1e-12)
        << label.id;
    EXPECT_EQ(label.type.value, type) << label.id;
  };
  const std::vector<Label> all = labels();
  ASSERT_EQ(all.size(), 4U);
  expect(all[0], 0.3, 0, 1, 5);
  expect(all[1], 0.1, 30, 0, 5);
  expect(all[2], 0.1, -30, 1, 9);
  expect(all[3], 0.1, 60, 0, 9);
  for (const auto& [row, message] : std::vector<std::pair<const char*, const char*>>{
           {"1,A1,front,2,1,,2000,", "p.csv: line 2, field 7: is 2000 m; use 0.001 m to 1000 m"},
           {"1,A1,front,2,1,,0,", "field 7: is 0 m"},
           {"1,A1,front,2,1,,,90", "p.csv: line 2, field 8: is 90; use a value from -89 to 89"},
           {"1,A1,front,2,1,,x,", "field 7: "}}) {
    folder.write("p.csv", std::string("article,fixture,face,level,x,type,hook,tilt_deg\n") + row + "\n");
    test::expect_input_error(labels, std::string_view(message));
  }
  folder.write("p.csv", "article,fixture,face,level,x\n1,A1,front,2,1\n");
  store["planogram"]["fixtures"] =
      Json::parse(R"([{"fixtures": "A*", "hook": 0.1}, {"fixtures": "B*", "hook": 0.1}])");
  test::expect_input_error(labels, std::string_view("planogram.fixtures[1].fixtures: matches no fixture"));
  store["planogram"]["fixtures"] = Json::parse(R"([{"fixtures": "A*", "hook": 0}])");
  test::expect_input_error(labels, std::string_view("planogram.fixtures[0].hook: is 0"));
  store["planogram"]["fixtures"] = Json::parse(R"([{"fixtures": "A1", "tilt_deg": 0}, {"fixtures": "A*"}])");
  test::expect_input_error(labels,
                           std::string_view("planogram.fixtures[1]: has no effect without 'type', 'hook' or "
                                            "'tilt_deg'; add one of them, or remove it"));
}

TEST(Planogram, LabelsStandOnBoxes) {
  const TempFolder folder;
  Json store = store_with(R"([
    {"type": "box", "id": "T", "at": [5, 5, 0], "size": [1.2, 0.8, 0.75], "rotation_deg": 90, "material": "steel"},
    {"type": "box", "id": "low", "min": [8, 8, 0.1], "max": [10, 9, 0.16], "material": "steel"}])");
  store["labels"] = Json::array();
  store["planogram"] = {{"file", "p.csv"}, {"type", "small"}, {"hook", 0.02}, {"tilt_deg", 30}};
  const auto labels = [&] { return make_scene(read(store, folder.path())).labels; };
  folder.write("p.csv",
               "article,fixture,face,level,x,y,hook,tilt_deg\n1,T,front,1,0.3,,,\n2,T,left,1,0.2,,0.05,0\n"
               "3,T,top,1,0.3,,,\n4,T,Top,1,0.3,0.1,,45\n5,low,back,1,2,,,0\n");
  const std::vector<Label> all = labels();
  ASSERT_EQ(all.size(), 5U);
  const auto expect = [&](std::size_t k, const Vec3& position, const Vec3& normal, const LabelPlace& place) {
    EXPECT_NEAR(length(all[k].position - position), 0, 1e-12) << k;
    EXPECT_NEAR(length(all[k].normal - normalized(normal)), 0, 1e-12) << k;
    EXPECT_EQ(all[k].place.fixture, place.fixture);
    EXPECT_EQ(all[k].place.face, place.face) << k;
    EXPECT_EQ(all[k].place.on_top, place.on_top) << k;
    EXPECT_EQ(all[k].place.board, 0) << k;
    EXPECT_NEAR(all[k].place.along, place.along, 1e-12) << k;
  };
  expect(0, {5.02, 5.3, 0.7}, {std::cos(radians(30)), 0, 0.5},
         {.fixture = "T", .face = Face::front, .along = 0.3});
  expect(1, {4.8, 4.95, 0.7}, {0, -1, 0}, {.fixture = "T", .face = Face::left, .along = 0.2});
  expect(2, {4.6, 5.3, 0.76}, {0, 0, 1}, {.fixture = "T", .on_top = true, .along = 0.3});
  expect(3, {4.9, 5.3, 0.76}, {1, 0, 1}, {.fixture = "T", .on_top = true, .along = 0.3});
  expect(4, {10, 9.02, 0.13}, {0, 1, 0}, {.fixture = "low", .face = Face::back, .along = 2});
  for (const auto& [row, message] : std::vector<std::pair<const char*, const char*>>{
           {"1,T,top,1,0.3,0.9,,", "p.csv: line 2, field 6: is 0.9 m; the top extends from 0 to 0.8 m"},
           {"1,T,top,1,1.3,,,", "p.csv: line 2, field 5: is 1.3 m"},
           {"1,T,top,2,0.3,,,", "p.csv: line 2, field 4: is 2; use a whole number from 1 to 1"},
           {"1,T,top,1,0.3,,0.1,", "field 7: does not apply to labels on the top; leave it empty"}}) {
    folder.write("p.csv", std::string("article,fixture,face,level,x,y,hook,tilt_deg\n") + row + "\n");
    test::expect_input_error(labels, std::string_view(message));
  }
  folder.write("p.csv", "article,fixture,face,level,position\n1,T,top,1,1\n2,T,top,1,3\n");
  EXPECT_NEAR(length(labels()[1].position - Vec3{4.6, 6, 0.76}), 0, 1e-12);
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
