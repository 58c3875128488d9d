#include "support/documentation.hpp"

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

#include "support/testing.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {
namespace {

const std::string index_page = "store.md";
const std::vector<std::string> pages_of_types{"store/materials.md", "store/label_types.md",
                                              "store/transceiver_types.md"};

// An example of a page.
Json block(const std::string& page, std::size_t number = 0) {
  return Json::parse(fenced_blocks(page, "jsonc").at(number), nullptr, true, true);
}

// The tests below read all examples.
TEST(Documentation, EveryExampleIsTested) {
  std::vector<std::string> pages{index_page};
  for (const auto& entry : std::filesystem::directory_iterator(SHELFBEAM_SOURCE_DIR "/docs/formats/store"))
    pages.push_back("store/" + entry.path().filename().string());
  std::map<std::string, std::size_t> stores, tables;
  for (const std::string& page : pages) {
    if (const auto blocks = fenced_blocks(page, "jsonc"); !blocks.empty()) stores[page] = blocks.size();
    if (const auto blocks = fenced_blocks(page, "csv"); !blocks.empty()) tables[page] = blocks.size();
  }
  std::map<std::string, std::size_t> tested{
      {index_page, 1},      {"store/variation.md", 1}, {"store/fixtures.md", 1},     {"store/drawing.md", 1},
      {"store/room.md", 2}, {"store/values.md", 2},    {"store/transceivers.md", 3}, {"store/labels.md", 4}};
  for (const std::string& page : pages_of_types) tested[page] = 1;
  EXPECT_EQ(stores, tested);
  EXPECT_EQ(tables, (std::map<std::string, std::size_t>{{"store/csv.md", 2}, {"store/labels.md", 2}}));
}

// The examples are parts of the first one, a whole store.
class Examples : public testing::Test {
 protected:
  Scene scene() const { return scene_of(store, folder.path()); }

  Json store = block(index_page);
  TempFolder folder;
};

TEST_F(Examples, OfTheStoreFile) {
  const Scene whole = scene();
  EXPECT_EQ(sentences(whole.warnings), std::vector<std::string>{});
  ASSERT_EQ(whole.labels.size(), 2u * 3 * 5 + 4 + 1);
  EXPECT_EQ(whole.labels.front().id, "A1-front-1-1");
  EXPECT_EQ(whole.labels[29].id, "A1-back-3-5");
  EXPECT_EQ(whole.labels.back().id, "poster");
  EXPECT_EQ(whole.type_of(whole.labels[0]).requirement(), 0.025);
  // 7 x 5 of the grid without the two at (4, 4) and (4, 5), plus the listed one, which is installed.
  ASSERT_EQ(whole.transceivers.size(), 7u * 5 - 2 + 1);
  EXPECT_TRUE(whole.transceivers.back().installed);
  EXPECT_EQ(whole.transceivers.back().id, "till");
}

TEST_F(Examples, OfTypes) {
  const auto with_types = [&](const std::vector<Json>& parts) {
    Json all = store;
    for (const Json& part : parts) all.merge_patch(part);
    return read(all, SHELFBEAM_SOURCE_DIR "/data/photometry");
  };
  std::vector<Json> parts;
  for (const std::string& page : pages_of_types) parts.push_back(block(page));
  const Store whole = with_types(parts);
  EXPECT_EQ(whole.materials.size(), 4u + 6);
  ASSERT_EQ(whole.label_types.size(), 1u + 3);
  ASSERT_EQ(whole.transceiver_types.size(), 1u + 3);
  const Emission& aisle = whole.transceiver_types[1].emission;
  EXPECT_NEAR(whole.label_types[1].threshold, mean_intensity(aisle, 0) / 36, 1e-15);
  const Store measured = with_types({Json::parse("{" + fenced_blocks("photometry.md", "jsonc").at(0) + "}")});
  ASSERT_EQ(measured.transceiver_types.size(), 1u + 2);
  EXPECT_NEAR(power(measured.transceiver_types[2].emission), 0.8, 1e-14);
}

TEST_F(Examples, OfKnownValues) {
  store.update(block("store/values.md"));
  EXPECT_EQ(read(store).marks.size(), 7u);
  folder.write("vendor.json", R"({"label_types": {"ESL 29": {"threshold": 0.03, "source": "datasheet"}}})");
  store.update(block("store/values.md", 1));
  EXPECT_EQ(scene().label_types.back().requirement(), 0.03 * 1.25);
}

TEST_F(Examples, OfListsInCsvFiles) {
  folder.write("labels.csv", fenced_blocks("store/csv.md", "csv").at(0));
  folder.write("units.csv", fenced_blocks("store/csv.md", "csv").at(1));
  store["labels"] = {{"csv", "labels.csv"}};
  store["transceivers"]["list"] = {{"csv", "units.csv"}};
  EXPECT_EQ(scene().labels.back().id, "stand, left");
  EXPECT_EQ(scene().transceivers.back().id, "till");
}

TEST_F(Examples, OfRooms) {
  store["materials"]["glass"] = {{"type", "thin_dielectric"}, {"ior", 1.5}};
  store["room"] = block("store/room.md");
  store["fixtures"] = Json::array();
  EXPECT_EQ(scene().room->upper(), (Vec3{20, 14, 3.2}));
  EXPECT_EQ(scene().fixtures.size(), 1u) << "the inner wall";
  store["room"] = block("store/room.md", 1);
  const RoomShape with_openings = *scene().room;
  ASSERT_EQ(with_openings.openings.size(), 2u);
  EXPECT_NEAR(with_openings.openings[1].first.at + with_openings.openings[1].length(), 10.6, 1e-12);
}

TEST_F(Examples, OfFixtures) {
  store.update(block("store/fixtures.md"));
  const Scene made = scene();
  EXPECT_EQ(sentences(made.warnings), std::vector<std::string>{});
  EXPECT_EQ(ids_of(made.fixtures), "W1 W2 W3 A1 A2 A-end ");
  // The wall y = 6 runs from (8, 6) to (0, 6).
  EXPECT_NEAR(made.fixtures[0].footprint[2][0], 7.9, 1e-12);
  EXPECT_NEAR(made.fixtures[2].footprint[3][0], 7.9 - 3 * 1.33, 1e-9);
}

TEST_F(Examples, OfTransceivers) {
  store["transceivers"] = block("store/transceivers.md", 0);
  const std::string ids = " " + ids_of(scene().transceivers);
  for (const char* id : {" A1-1-1/a1 ", " A1-5-4/a2 ", " R1-1 ", " R1-13 ", " column-2/a2 "})
    EXPECT_THAT(ids, testing::HasSubstr(id));
  EXPECT_THAT(ids, testing::Not(testing::HasSubstr("A1-3-3/a1"))) << "over the counter";

  store["transceivers"] = block("store/transceivers.md", 1);
  Scene given = scene();
  EXPECT_EQ(given.excluded.size(), 4u);
  std::erase_if(given.transceivers, [](const Transceiver& unit) { return !unit.pinned; });
  EXPECT_EQ(ids_of(given.transceivers), "G1-3-2 ");

  store["transceivers"] = block("store/transceivers.md", 2);
  std::vector<Transceiver> chosen = scene().transceivers;
  std::erase_if(chosen, [](const Transceiver& unit) { return !unit.is_chosen(); });
  EXPECT_EQ(ids_of(chosen), "G1-3-2 by the door ");
}

TEST_F(Examples, OfADrawingChangesNoHash) {
  const std::string before = scene().store_hash;
  store.update(block("store/drawing.md"));
  EXPECT_EQ(scene().store_hash, before);
}

TEST_F(Examples, OfAVariation) {
  store.update(block("store/variation.md"));
  store["materials"]["clothes"] = {{"type", "lambertian"}, {"reflectance", 0.4}};
  expect_input_error([&] { scene(); }, "doors[0].fixtures: matches no fixture with doors");
  store["variation"].erase("doors");
  EXPECT_EQ(read(store).variation->boxes.size(), 2U);
}

TEST_F(Examples, OfAMeasuringPlane) {
  store.update(block("store/labels.md", 3));
  EXPECT_EQ(scene().labels.size(), 2u * 3 * 5 + 4 + 1 + 16 * 12);
  EXPECT_EQ(scene().labels.back().id, "plane-12-16");
}

TEST_F(Examples, OfLabelsAtPlacesAndAPlanogram) {
  folder.write("planogram.csv", fenced_blocks("store/labels.md", "csv").at(0));
  store["planogram"] = {{"file", "planogram.csv"}, {"type", "standard"}};
  const std::vector<Label> labels = scene().labels;
  // Board 2 of A1, from (2, 2) to (6, 2), has two positions.
  EXPECT_EQ(by_id(labels, "4006381333931").position, (Vec3{3, 1.99, 0.9}));
  EXPECT_EQ(by_id(labels, "4006381333948").position, (Vec3{5, 1.99, 0.9}));
  EXPECT_NEAR(by_id(labels, "4006381333931/2").position.y, 2.91, 1e-12);
  EXPECT_EQ(by_id(labels, "4006381333931/2").normal, (Vec3{0, 1, 0}));
  store["planogram"] = block("store/labels.md", 1)["planogram"];
  store["fixtures"][1]["id"] = "F1";
  EXPECT_EQ(by_id(scene().labels, "4006381333931").position, (Vec3{3, 1.75, 0.9}));

  store.erase("planogram");
  store["materials"]["pine"] = store["materials"]["white"];
  store["fixtures"] = block("store/labels.md", 0)["fixtures"];
  EXPECT_THAT(ids_of(scene().labels), testing::HasSubstr(" table 2-card "));
}

TEST_F(Examples, OfAPlanogramWithSegments) {
  folder.write("planogram.csv", fenced_blocks("store/labels.md", "csv").at(1));
  store["planogram"] = block("store/labels.md", 2)["planogram"];
  const std::vector<Label> labels = scene().labels;
  // A1 extends from (2, 2) to (6, 2.9), so its segments are 2 m long, and the left end of its back is at x
  // = 6.
  for (const auto& [id, position] : std::map<std::string, Vec3>{{"4001686301265", {2 + 2.0 / 3, 1.99, 0.4}},
                                                                {"4001686301272", {2 + 5.0 / 3, 1.99, 0.4}},
                                                                {"4001686301289", {5, 1.99, 1.4}},
                                                                {"4001686301296", {6 - 3.125, 2.91, 0.4}}})
    EXPECT_NEAR(length(by_id(labels, id).position - position), 0, 1e-12) << id;
  EXPECT_EQ(by_id(labels, "4001686301296").description, "Pretzels");
}

TEST_F(Examples, OfErrors) {
  const std::string page = read_file(SHELFBEAM_SOURCE_DIR "/docs/formats/store/errors.md");
  Json misspelt = store;
  misspelt["fixtures"][0]["shelfs"] = misspelt["fixtures"][0]["shelves"];
  store["materials"]["white"]["reflectance"] = 1.2;
  for (const Json& wrong : {misspelt, store})
    EXPECT_THAT(page, testing::HasSubstr("error: " + input_error([&] { scene_of(wrong); }) + "\n"));
}

// The sentences and tables of a page, without its fenced blocks.
std::string prose(const std::string& page) {
  const std::string text = read_file(SHELFBEAM_SOURCE_DIR "/docs/formats/" + page);
  std::string found;
  std::size_t at = 0;
  for (std::size_t open; (open = text.find("```", at)) != std::string::npos;) {
    found += text.substr(at, open - at);
    at = text.find("```", open + 3) + 3;
  }
  return found + text.substr(at);
}

// The keys of all objects that a part of the schema describes, without parts that it refers to by name.
void collect_keys(const Json& schema, std::set<std::string>& keys) {
  if (!schema.is_structured()) return;
  if (schema.contains("properties"))
    for (const auto& [key, value] : schema["properties"].items())
      if (key != "ignore") keys.insert(key);
  for (const Json& part : schema) collect_keys(part, keys);
}

std::vector<std::string> undocumented(const Json& schema, const std::vector<std::string>& pages) {
  std::string text;
  for (const std::string& page : pages) text += prose(page);
  std::set<std::string> keys;
  collect_keys(schema, keys);
  std::vector<std::string> missing;
  for (const std::string& key : keys)
    if (text.find('`' + key + '`') == std::string::npos && text.find('"' + key + "\":") == std::string::npos)
      missing.push_back(key);
  return missing;
}

TEST(Documentation, EveryKeyOfTheSchemaIsOnItsPage) {
  // The parts of the schema, by the pages that describe their keys.
  const std::vector<std::pair<std::string, std::vector<std::string>>> described{
      {"planogram measuring_plane", {"labels"}},
      {"label", {"labels", "variation"}},
      {"variation share_range number_of_people", {"variation"}},
      {"drawing", {"drawing"}},
      {"grid mount_area mount_rail mount_faces keep_out transceivers transceiver",
       {"transceivers", "variation"}},
      {"room zones inner_walls openings", {"room"}},
      {"material smooth facets", {"materials"}},
      {"marks", {"values"}},
      {"label_type threshold responsivity", {"label_types"}},
      {"transceiver_type emission", {"transceiver_types"}},
      {"fixture whole_fixture repeat against prism cylinder panel box mesh", {"fixtures"}},
      {"gondola freezer", {"fixtures", "labels", "variation"}},
      {"csv_file", {"csv"}}};
  std::map<std::string, std::vector<std::string>> pages;
  for (const auto& [names, stems] : described)
    for (const std::string_view name : split(names, ' '))
      for (const std::string& stem : stems) pages[std::string(name)].push_back("store/" + stem + ".md");
  Json schema = Json::parse(read_file(SHELFBEAM_SOURCE_DIR "/data/store.schema.json"));
  const std::vector<std::string> none;
  for (const auto& [name, part] : schema["$defs"].items()) {
    std::set<std::string> keys;
    collect_keys(part, keys);
    if (keys.empty()) continue;
    ASSERT_TRUE(pages.contains(name)) << "name the page of " << name << " in this test";
    EXPECT_EQ(undocumented(part, pages.at(name)), none) << name;
  }
  schema.erase("$defs");
  EXPECT_EQ(undocumented(schema, {index_page}), none);
  schema["properties"]["no_such_key"] = Json::object();
  EXPECT_EQ(undocumented(schema, {index_page}), std::vector<std::string>{"no_such_key"});
}

}  // namespace
}  // namespace shelfbeam::test
