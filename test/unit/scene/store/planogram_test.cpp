#include "shelfbeam/base/file.hpp"
#include "shelfbeam/math/warp.hpp"

#include "support/testing.hpp"
#include "unit/scene/store/list_store.hpp"

namespace shelfbeam::test {
namespace {

TEST(FixtureLabels, StandByCountAtPositionsOnHooksAndOnTop) {
  const auto labels_of = [](const Json& fixture) {
    const Scene scene = scene_of(store_with(fixture));
    return std::vector(scene.labels.begin(), scene.labels.end() - 1);  // without the one of the store itself
  };
  const auto on_boards = [&](const char* labels) {
    Json fixture = shelves({{"id", "A"}, {"at", {5, 5}}, {"length", 3}});
    fixture["labels"] = Json::parse(labels);
    return labels_of(fixture);
  };
  const auto counted =
      on_boards(R"({"type": "small", "count": 3, "hook": 0.25, "level_types": {"2": "large"}})");
  ASSERT_EQ(counted.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(length(counted[k].position - Vec3{5.5 + static_cast<double>(k % 3), 4.75, k < 3 ? 0.4 : 0.9}),
                0, 1e-12);
    EXPECT_EQ(counted[k].type.value, k < 3 ? 0u : 1u);
  }
  EXPECT_EQ(counted[4].id, "A-front-2-2");
  const auto placed = on_boards(R"({"type": "small", "positions": [0.1, 0.2, 2.9]})");
  ASSERT_EQ(placed.size(), 6u);
  EXPECT_NEAR(placed[2].position.x, 7.9, 1e-12);
  const auto rim = labels_of(R"({"type": "freezer", "id": "F", "at": [5, 5], "length": 2, "depth": 0.8,
    "height": 0.9, "material": "steel",
    "labels": {"type": "small", "count": 2, "faces": ["front"], "on_top": true}})"_json);
  ASSERT_EQ(rim.size(), 2u);
  EXPECT_NEAR(length(rim[0].position - Vec3{5.5, 5.03, 0.91}), 0, 1e-12);
  EXPECT_EQ(rim[0].normal, (Vec3{0, 0, 1}));
}

// test/data/refused/labels.jsonc has the faults of planograms.
class Planogram : public testing::Test {
 protected:
  Scene scene(const std::string& csv) const {
    folder.write("p.csv", csv);
    return scene_of(store, folder.path());
  }
  std::vector<Label> labels(const std::string& csv) const { return scene(csv).labels; }

  Json store = planogram_store();
  Json& keys = store["planogram"];
  TempFolder folder;
};

TEST_F(Planogram, ComesFromSpreadsheets) {
  const auto warnings = [&](const std::string& text) { return sentences(scene(text).warnings); };
  const std::string plain = "article,fixture,face,level,position\n1,A,front,2,1\n2,A,front,2,2\n";
  const std::vector<std::string> usual = warnings(plain);
  EXPECT_EQ(warnings("Article;FIXTURE;Face;Level;Position\r\n1;A;Front;2;1\r\n2;A;FRONT;2;2\r\n"), usual);
  const std::vector<std::string> changed =
      warnings("article,fixture,face,level,position\n\"4,00638E+12\",A,front,2,1\n#REF!,A,front,2,2\n");
  ASSERT_EQ(changed.size(), usual.size() + 1);
  EXPECT_THAT(changed[0], testing::HasSubstr("p.csv: has ids that look as if a spreadsheet has changed them: "
                                             "'4,00638E+12' in line 2, '#REF!' in line 3;"));
}

TEST_F(Planogram, HasOtherLinesAboveItsColumnsAndUnitsInItsCells) {
  for (const std::string rows :
       {"1;A;front;1;0,25 m;20 cm", "1;A;front;1;25 cm;200mm", "1;A;front;1;0,25;0,2"}) {
    const auto one =
        labels("Shop, of two\nDate;01.02.2026\n\narticle;fixture;face;level;x;hook\n" + rows + "\n");
    ASSERT_EQ(one.size(), 1U);
    EXPECT_NEAR(length(one[0].position - Vec3{5.25, 4.8, 0.4}), 0, 1e-12) << rows;
  }
}

// The table of a spreadsheet, with the program's names of columns and words of faces.
std::string field_table(const std::string& name) {
  std::string text = read_file(std::string(SHELFBEAM_SOURCE_DIR "/test/data/field4/") + name);
  for (const auto& [from, to] : {std::pair{"EAN", "article"},
                                 {"Regal", "fixture"},
                                 {"Seite", "face"},
                                 {"Boden (von oben)", "level"},
                                 {"Boden", "level"},
                                 {"vorne", "front"}})
    for (std::size_t at; (at = text.find(from)) != std::string::npos;)
      text.replace(at, std::string_view(from).size(), to);
  return text;
}

TEST_F(Planogram, CountsAsItsFileDoes) {
  store["fixtures"].clear();
  for (int f = 1; f <= 3; ++f)
    store["fixtures"].push_back(shelves({{"id", fmt::format("A{}", f)},
                                         {"at", {5, 2 * f}},
                                         {"length", 3},
                                         {"shelves", {0.4, 0.9, 1.4}},
                                         {"labels", nullptr}}));
  // `more` keys of the planogram besides its file and type.
  const auto places = [&](const std::string& csv, const Json& more = Json::object()) {
    keys = {{"file", "p.csv"}, {"type", "small"}};
    keys.update(more);
    std::vector<Vec3> found;
    for (const Label& label : labels(csv)) found.push_back(label.position);
    return found;
  };
  const auto from_bottom = places(
      "article,fixture,face,level,position\n1,A1,front,3,1\n2,A1,front,2,1\n3,A1,front,1,1\n"
      "4,A1,front,3,2\n5,A1,front,2,2\n6,A1,front,1,2\n");
  const std::string from_top = field_table("boards_from_top.csv");
  const auto first = [](const std::vector<Vec3>& all) { return std::vector(all.begin(), all.begin() + 6); };
  EXPECT_EQ(first(places(from_top, {{"from_top", true}})), from_bottom);
  EXPECT_NE(first(places(from_top)), from_bottom);

  const std::string merged = field_table("merged_cells.csv"), from_zero = field_table("places_from_zero.csv");
  expect_input_error([&] { places(merged); }, "p.csv: line 3, field 3: names the unknown fixture ''",
                     "set 'fill_down' of 'planogram' if cells were merged");
  expect_input_error([&] { places(from_zero); },
                     "use a whole number from 1 to 1000, or set 'first_position'");
  const auto filled = places(merged, {{"fill_down", true}});
  EXPECT_EQ(filled.size(), 18U);
  const auto sorted = [](std::vector<Vec3> all) {
    std::ranges::sort(all, {}, [](const Vec3& p) { return std::tuple(p.y, p.z, p.x); });
    return all;
  };
  EXPECT_EQ(sorted(filled), sorted(places(from_zero, {{"first_position", 0}})));

  const std::string ground = "article,fixture,face,level,position\n1,A1,front,0,1\n2,A1,front,2,1\n";
  expect_input_error([&] { places(ground); }, "use a whole number from 1 to 3, or correct 'first_level'");
  const auto grounded = places(ground, {{"first_level", 0}});
  EXPECT_NEAR(grounded[0].z, 0.4, 1e-12);
  EXPECT_NEAR(grounded[1].z, 1.4, 1e-12);
  EXPECT_NEAR(places(ground, {{"first_level", 0}, {"from_top", true}})[0].z, 1.4, 1e-12);
}

TEST_F(Planogram, NamesItsEncoding) {
  store["fixtures"][0]["id"] = "Kühlregal";
  const std::string csv = "article,fixture,face,level,x\n1,K\xFChlregal,front,1,0.5\n";
  const std::vector<Finding> guessed = scene(csv).warnings;
  const auto found = std::ranges::find(guessed, FindingCode::text_encoding, &Finding::code);
  ASSERT_NE(found, guessed.end());
  EXPECT_EQ(found->values, (FindingValues{"windows-1252", "Kühlregal"}));
  keys["encoding"] = "windows-1252";
  EXPECT_EQ(std::ranges::count(scene(csv).warnings, FindingCode::text_encoding, &Finding::code), 0);
  keys["encoding"] = "windows-1251";
  expect_input_error([&] { scene(csv); }, "names the unknown fixture 'Kьhlregal'");
  keys["encoding"] = "shift_jis";
  expect_input_error([&] { scene("article,fixture,face,level,x\n1,K\xFC\xFFhlregal,front,1,0.5\n"); },
                     "p.csv: is not UTF-8, nor shift_jis; ");
}

TEST_F(Planogram, LabelsHaveTheStyleOfRecordFixtureOrPlanogram) {
  store["fixtures"].push_back(shelves({{"id", "A2"}, {"at", {5, 9}}, {"length", 3}, {"labels", nullptr}}));
  store["fixtures"].push_back(shelves({{"id", "B"}, {"at", {5, 13}}, {"length", 3}, {"labels", nullptr}}));
  keys.update(R"({"hook": 0.2, "tilt_deg": 30, "fixtures": [{"fixtures": "A*", "hook": 0.1},
    {"fixtures": "A2", "type": "large", "tilt_deg": -30}]})"_json);
  const auto all = labels(
      "article,fixture,face,level,x,type,hook,tilt_deg\n1,A,front,2,1,large,0.3,0\n2,A,front,2,1,,,\n"
      "3,A2,front,2,1,\n4,A2,front,2,1,small,,60\n5,B,front,2,1,large\n6,B,front,2,2,\n");
  ASSERT_EQ(all.size(), 6U);
  const auto expect = [&](std::size_t k, double hook, double tilt_deg, std::uint32_t type, const Vec2& edge) {
    const double tilt = radians(tilt_deg);
    EXPECT_NEAR(length(all[k].position - Vec3{edge[0], edge[1] - hook, 0.9}), 0, 1e-12) << k;
    EXPECT_NEAR(length(all[k].normal - Vec3{0, -std::cos(tilt), std::sin(tilt)}), 0, 1e-12) << k;
    EXPECT_EQ(all[k].type.value, type) << k;
  };
  expect(0, 0.3, 0, 1, {6, 5});
  expect(1, 0.1, 30, 0, {6, 5});
  expect(2, 0.1, -30, 1, {6, 9});
  expect(3, 0.1, 60, 0, {6, 9});
  expect(4, 0.2, 30, 1, {6, 13});
  expect(5, 0.2, 30, 0, {7, 13});
}

TEST_F(Planogram, LabelsStandOnBoxes) {
  store["fixtures"] = R"([
    {"type": "box", "id": "T", "at": [5, 5, 0], "size": [1.2, 0.8, 0.75], "rotation_deg": 90, "material": "steel"},
    {"type": "box", "id": "low", "min": [8, 8, 0.1], "max": [10, 9, 0.16], "material": "steel"}])"_json;
  keys.update({{"hook", 0.02}, {"tilt_deg", 30}});
  const auto all = labels(
      "article,fixture,face,level,x,y,hook,tilt_deg\n1,T,front,1,0.3,,,\n2,T,left,1,0.2,,0.05,0\n"
      "3,T,top,1,0.3,,,\n4,T,Top,1,0.3,0.1,,45\n5,low,back,1,2,,,0\n");
  ASSERT_EQ(all.size(), 5U);
  const auto expect = [&](std::size_t k, const Vec3& position, const Vec3& normal, const LabelPlace& place) {
    EXPECT_NEAR(length(all[k].position - position), 0, 1e-12) << k;
    EXPECT_NEAR(length(all[k].normal - normalized(normal)), 0, 1e-12) << k;
    expect_place(all[k], place);
  };
  expect(0, {5.02, 5.3, 0.7}, {std::cos(radians(30)), 0, 0.5},
         {.fixture = "T", .face = Face::front, .along = 0.3});
  expect(1, {4.8, 4.95, 0.7}, {0, -1, 0}, {.fixture = "T", .face = Face::left, .along = 0.2});
  expect(2, {4.6, 5.3, 0.76}, {0, 0, 1}, {.fixture = "T", .on_top = true, .along = 0.3});
  expect(3, {4.9, 5.3, 0.76}, {1, 0, 1}, {.fixture = "T", .on_top = true, .along = 0.3});
  expect(4, {10, 9.02, 0.13}, {0, 1, 0}, {.fixture = "low", .face = Face::back, .along = 2});
  const auto spread = labels("article,fixture,face,level,position\n1,T,top,1,1\n2,T,top,1,3\n");
  EXPECT_NEAR(length(spread.at(1).position - Vec3{4.6, 6, 0.76}), 0, 1e-12);
}

TEST_F(Planogram, CountsInTheMemoryOfTheScene) {
  std::string rows = "article,fixture,face,level,x\n";
  for (int k = 0; k < 150'000; ++k) rows += std::to_string(k) + ",A,front,1,0.5\n";
  folder.write("p.csv", rows);
  constexpr std::size_t memory = 100'000'000;
  expect_input_error([&] { parse_store(store.dump(), "store.json", folder.path(), {false, memory}); },
                     "p.csv: line ", "the store up to here requires about 0.1 GB");
}

}  // namespace
}  // namespace shelfbeam::test
