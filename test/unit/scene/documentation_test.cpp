#include "support/documentation.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/file.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

using test::fenced_blocks;
using test::Json;

std::vector<std::string> ids_of(const Scene& scene) {
  std::vector<std::string> ids;
  for (const Label& label : scene.labels) ids.push_back(label.id);
  return ids;
}

const std::string index_page = "store.md";
const std::vector<std::string> pages_of_types{"store/materials.md", "store/label_types.md",
                                              "store/transceiver_types.md"};

// The pages that describe the store file, relative to docs/formats.
std::vector<std::string> store_pages() {
  std::vector<std::string> pages{index_page};
  for (const auto& entry : std::filesystem::directory_iterator(SHELFBEAM_SOURCE_DIR "/docs/formats/store"))
    pages.push_back("store/" + entry.path().filename().string());
  return pages;
}

std::string example_store() {
  return fenced_blocks(index_page, "jsonc").at(0);
}

// The tests below read all examples.
TEST(Documentation, EveryExampleIsTested) {
  std::map<std::string, std::size_t> stores, tables;
  for (const std::string& page : store_pages()) {
    if (const auto blocks = fenced_blocks(page, "jsonc"); !blocks.empty()) stores[page] = blocks.size();
    if (const auto blocks = fenced_blocks(page, "csv"); !blocks.empty()) tables[page] = blocks.size();
  }
  std::map<std::string, std::size_t> tested{{index_page, 1}};
  for (const std::string& page : pages_of_types) tested[page] = 1;
  tested["store/variation.md"] = tested["store/fixtures.md"] = tested["store/drawing.md"] = 1;
  tested["store/room.md"] = tested["store/values.md"] = 2;
  tested["store/transceivers.md"] = 3;
  tested["store/labels.md"] = 4;
  EXPECT_EQ(stores, tested);
  EXPECT_EQ(tables, (std::map<std::string, std::size_t>{{"store/csv.md", 2}, {"store/labels.md", 2}}));
}

TEST(Documentation, ExampleOfTheStoreFileIsAccepted) {
  const Scene scene = make_scene(test::read_text(example_store()));
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front().sentence;
  const auto ids = ids_of(scene);
  ASSERT_EQ(ids.size(), 2u * 3 * 5 + 4 + 1);
  EXPECT_EQ(ids.front(), "A1-front-1-1");
  EXPECT_EQ(ids[29], "A1-back-3-5");
  EXPECT_EQ(ids.back(), "poster");
  EXPECT_EQ(scene.type_of(scene.labels[0]).requirement(), 0.025);
  // 7 x 5 of the grid without the two at (4, 4) and (4, 5), plus the listed one, which is installed.
  ASSERT_EQ(scene.transceivers.size(), 7u * 5 - 2 + 1);
  EXPECT_TRUE(scene.transceivers.back().installed);
  EXPECT_EQ(scene.transceivers.back().id, "till");
}

// The example store file with the types of fragments.
Store with_types(const std::vector<std::string>& fragments) {
  Json store = Json::parse(example_store(), nullptr, true, true);
  for (const std::string& fragment : fragments) {
    const Json types = Json::parse(fragment, nullptr, true, true);
    for (const auto& [section, members] : types.items()) store[section].update(members);
  }
  return test::read_text(store.dump(), SHELFBEAM_SOURCE_DIR "/data/photometry");
}

TEST(Documentation, ExamplesOfTypesAreAccepted) {
  std::vector<std::string> fragments;
  fragments.reserve(pages_of_types.size());
  for (const std::string& page : pages_of_types) fragments.push_back(fenced_blocks(page, "jsonc").at(0));
  const Store store = with_types(fragments);
  EXPECT_EQ(store.materials.size(), 4u + 6);
  ASSERT_EQ(store.label_types.size(), 1u + 3);
  ASSERT_EQ(store.transceiver_types.size(), 1u + 3);
  const Emission& aisle = store.transceiver_types[1].emission;
  EXPECT_NEAR(store.label_types[1].threshold, mean_intensity(aisle, 0) / 36, 1e-15);
  const Store measured = with_types({"{" + fenced_blocks("photometry.md", "jsonc").at(0) + "}"});
  ASSERT_EQ(measured.transceiver_types.size(), 1u + 2);
  EXPECT_NEAR(power(measured.transceiver_types[2].emission), 0.8, 1e-14);
}

TEST(Documentation, ExamplesOfKnownValuesAreAccepted) {
  Json store = Json::parse(example_store(), nullptr, true, true);
  store.update(Json::parse(fenced_blocks("store/values.md", "jsonc").at(0), nullptr, true, true));
  EXPECT_EQ(test::read_text(store.dump()).marks.size(), 7u);
  const test::TempFolder folder;
  folder.write("vendor.json", R"({"label_types": {"ESL 29": {"threshold": 0.03, "source": "datasheet"}}})");
  store.update(Json::parse(fenced_blocks("store/values.md", "jsonc").at(1), nullptr, true, true));
  EXPECT_EQ(test::scene_of(store, folder.path()).label_types.back().requirement(), 0.03 * 1.25);
}

TEST(Documentation, CsvExamplesAreAccepted) {
  const auto files = fenced_blocks("store/csv.md", "csv");
  ASSERT_EQ(files.size(), 2u);
  const test::TempFolder folder;
  folder.write("labels.csv", files[0]);
  folder.write("units.csv", files[1]);
  Json store = Json::parse(example_store(), nullptr, true, true);
  store["labels"] = {{"csv", "labels.csv"}};
  store["transceivers"]["list"] = {{"csv", "units.csv"}};
  const Scene scene = test::scene_of(store, folder.path());
  EXPECT_EQ(ids_of(scene).back(), "stand, left");
  EXPECT_EQ(scene.transceivers.back().id, "till");
}

TEST(Documentation, ExampleOfARoomIsAccepted) {
  Json store = Json::parse(example_store(), nullptr, true, true);
  store["materials"]["glass"] = {{"type", "thin_dielectric"}, {"ior", 1.5}};
  store["room"] = Json::parse(fenced_blocks("store/room.md", "jsonc").at(0), nullptr, true, true);
  store["fixtures"] = Json::array();
  const Scene scene = test::scene_of(store);
  EXPECT_EQ(scene.room->upper(), (Vec3{20, 14, 3.2}));
  EXPECT_EQ(scene.fixtures.size(), 1u) << "the inner wall";
  store["room"] = Json::parse(fenced_blocks("store/room.md", "jsonc").at(1), nullptr, true, true);
  const RoomShape with_openings = *test::scene_of(store).room;
  ASSERT_EQ(with_openings.openings.size(), 2u);
  EXPECT_NEAR(with_openings.openings[1].first.at + with_openings.openings[1].length(), 10.6, 1e-12);
}

TEST(Documentation, ExampleOfFixturesIsAccepted) {
  Json store = Json::parse(example_store(), nullptr, true, true);
  const Json part = Json::parse(fenced_blocks("store/fixtures.md", "jsonc").at(0), nullptr, true, true);
  for (const auto& [key, value] : part.items()) store[key] = value;
  const Scene scene = test::scene_of(store);
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front().sentence;
  std::string ids;
  for (const FixtureOutline& fixture : scene.fixtures) ids += fixture.id + " ";
  EXPECT_EQ(ids, "W1 W2 W3 A1 A2 A-end ");
  // The wall y = 6 runs from (8, 6) to (0, 6).
  EXPECT_NEAR(scene.fixtures[0].footprint[2][0], 7.9, 1e-12);
  EXPECT_NEAR(scene.fixtures[2].footprint[3][0], 7.9 - 3 * 1.33, 1e-9);
}

TEST(Documentation, ExampleOfMountsIsAccepted) {
  Json store = Json::parse(example_store(), nullptr, true, true);
  store["transceivers"] =
      Json::parse(fenced_blocks("store/transceivers.md", "jsonc").at(0), nullptr, true, true);
  const Scene scene = test::scene_of(store);
  std::set<std::string> ids;
  for (const Transceiver& unit : scene.transceivers) ids.insert(unit.id);
  for (const char* id : {"A1-1-1/a1", "A1-5-4/a2", "R1-1", "R1-13", "column-2/a2"})
    EXPECT_TRUE(ids.contains(id)) << id;
  EXPECT_FALSE(ids.contains("A1-3-3/a1")) << "over the counter";
}

TEST(Documentation, ExampleOfGivenUnitsIsAccepted) {
  Json store = Json::parse(example_store(), nullptr, true, true);
  store["transceivers"] =
      Json::parse(fenced_blocks("store/transceivers.md", "jsonc").at(1), nullptr, true, true);
  const Scene scene = test::scene_of(store);
  const auto pinned = std::find_if(scene.transceivers.begin(), scene.transceivers.end(),
                                   [](const Transceiver& unit) { return unit.pinned; });
  ASSERT_NE(pinned, scene.transceivers.end());
  EXPECT_EQ(pinned->id, "G1-3-2");
  EXPECT_EQ(scene.excluded.size(), 4u);
}

TEST(Documentation, ExampleOfSelectedUnitsIsAccepted) {
  Json store = Json::parse(example_store(), nullptr, true, true);
  store["transceivers"] =
      Json::parse(fenced_blocks("store/transceivers.md", "jsonc").at(2), nullptr, true, true);
  std::vector<std::string> chosen;
  for (const Transceiver& unit : test::scene_of(store).transceivers)
    if (unit.is_chosen()) chosen.push_back(unit.id);
  EXPECT_EQ(chosen, (std::vector<std::string>{"G1-3-2", "by the door"}));
}

TEST(Documentation, ExampleOfADrawingIsAcceptedAndChangesNoHash) {
  Json store = Json::parse(example_store(), nullptr, true, true);
  const std::string before = test::scene_of(store).store_hash;
  const Json part = Json::parse(fenced_blocks("store/drawing.md", "jsonc").at(0), nullptr, true, true);
  store["drawing"] = part["drawing"];
  EXPECT_EQ(test::scene_of(store).store_hash, before);
  store["drawing"]["scale"]["length"] = 0;
  test::expect_input_error([&] { test::scene_of(store); }, "store.json: drawing.scale.length");
}

TEST(Documentation, ExampleOfVariationIsAccepted) {
  Json store = Json::parse(example_store(), nullptr, true, true);
  const Json part = Json::parse(fenced_blocks("store/variation.md", "jsonc").at(0), nullptr, true, true);
  store["variation"] = part["variation"];
  store["materials"]["clothes"] = {{"type", "lambertian"}, {"reflectance", 0.4}};
  const std::string message = [&] {
    try {
      test::scene_of(store);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  }();
  EXPECT_NE(message.find("doors[0].fixtures: matches no fixture with doors"), std::string::npos) << message;
  store["variation"].erase("doors");
  EXPECT_EQ(test::read_text(store.dump()).variation->boxes.size(), 2U);
}

TEST(Documentation, ExampleOfLabelsAtPlacesIsAccepted) {
  Json store = Json::parse(example_store(), nullptr, true, true);
  store["materials"]["pine"] = store["materials"]["white"];
  store["fixtures"] =
      Json::parse(fenced_blocks("store/labels.md", "jsonc").at(0), nullptr, true, true)["fixtures"];
  const auto ids = ids_of(test::scene_of(store));
  EXPECT_EQ(std::count(ids.begin(), ids.end(), "table 2-card"), 1);
}

TEST(Documentation, ExampleOfAMeasuringPlaneIsAccepted) {
  Json store = Json::parse(example_store(), nullptr, true, true);
  store.update(Json::parse(fenced_blocks("store/labels.md", "jsonc").at(3), nullptr, true, true));
  const auto ids = ids_of(test::scene_of(store));
  EXPECT_EQ(ids.size(), 2u * 3 * 5 + 4 + 1 + 16 * 12);
  EXPECT_EQ(ids.back(), "plane-12-16");
}

TEST(Documentation, ExampleOfAPlanogramIsAccepted) {
  const test::TempFolder folder;
  folder.write("planogram.csv", fenced_blocks("store/labels.md", "csv").at(0));
  Json store = Json::parse(example_store(), nullptr, true, true);
  store["planogram"] = {{"file", "planogram.csv"}, {"type", "standard"}};
  Scene scene = test::scene_of(store, folder.path());
  const auto find = [&](const std::string& id) {
    return std::find_if(scene.labels.begin(), scene.labels.end(),
                        [&](const Label& label) { return label.id == id; });
  };
  ASSERT_NE(find("4006381333931/2"), scene.labels.end());
  // Board 2 of A1, from (2, 2) to (6, 2), has two positions.
  EXPECT_EQ(find("4006381333931")->position, (Vec3{3, 1.99, 0.9}));
  EXPECT_EQ(find("4006381333948")->position, (Vec3{5, 1.99, 0.9}));
  EXPECT_NEAR(find("4006381333931/2")->position.y, 2.91, 1e-12);
  EXPECT_EQ(find("4006381333931/2")->normal, (Vec3{0, 1, 0}));
  store["planogram"] =
      Json::parse(fenced_blocks("store/labels.md", "jsonc").at(1), nullptr, true, true)["planogram"];
  store["fixtures"][1]["id"] = "F1";
  scene = test::scene_of(store, folder.path());
  EXPECT_EQ(find("4006381333931")->position, (Vec3{3, 1.75, 0.9}));
}

TEST(Documentation, ExampleOfAPlanogramWithSegmentsIsAccepted) {
  const test::TempFolder folder;
  folder.write("planogram.csv", fenced_blocks("store/labels.md", "csv").at(1));
  Json store = Json::parse(example_store(), nullptr, true, true);
  store["planogram"] =
      Json::parse(fenced_blocks("store/labels.md", "jsonc").at(2), nullptr, true, true)["planogram"];
  const Scene scene = test::scene_of(store, folder.path());
  const auto find = [&](const std::string& id) {
    return std::find_if(scene.labels.begin(), scene.labels.end(),
                        [&](const Label& label) { return label.id == id; });
  };
  // A1 extends from (2, 2) to (6, 2.9), so its segments are 2 m long, and the left end of its back is at x
  // = 6.
  const auto expect_at = [&](const char* id, const Vec3& position) {
    ASSERT_NE(find(id), scene.labels.end()) << id;
    EXPECT_NEAR(length(find(id)->position - position), 0, 1e-12) << id;
  };
  expect_at("4001686301265", {2 + 2.0 / 3, 1.99, 0.4});
  expect_at("4001686301272", {2 + 5.0 / 3, 1.99, 0.4});
  expect_at("4001686301289", {5, 1.99, 1.4});
  expect_at("4001686301296", {6 - 3.125, 2.91, 0.4});
  EXPECT_EQ(find("4001686301296")->description, "Pretzels");
}

TEST(Documentation, ErrorsAreAsShown) {
  const std::string page = read_file(SHELFBEAM_SOURCE_DIR "/docs/formats/store/errors.md");
  Json store = Json::parse(example_store(), nullptr, true, true);
  const auto expect_shown = [&](const Json& wrong) {
    const std::string message = test::input_error([&] { test::scene_of(wrong); });
    EXPECT_NE(page.find("error: " + message + "\n"), std::string::npos) << message;
  };
  Json wrong = store;
  wrong["fixtures"][0]["shelfs"] = wrong["fixtures"][0]["shelves"];
  expect_shown(wrong);
  wrong = store;
  wrong["materials"]["white"]["reflectance"] = 1.2;
  expect_shown(wrong);
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
  const std::vector<std::string> materials{"store/materials.md"}, label_types{"store/label_types.md"},
      transceiver_types{"store/transceiver_types.md"}, fixtures{"store/fixtures.md"},
      shelving{"store/fixtures.md", "store/labels.md", "store/variation.md"},
      transceivers{"store/transceivers.md", "store/variation.md"};
  const std::map<std::string, std::vector<std::string>> pages{
      {"planogram", {"store/labels.md"}},
      {"variation", {"store/variation.md"}},
      {"drawing", {"store/drawing.md"}},
      {"share_range", {"store/variation.md"}},
      {"number_of_people", {"store/variation.md"}},
      {"threshold", {"store/label_types.md"}},
      {"grid", transceivers},
      {"mount_area", transceivers},
      {"mount_rail", transceivers},
      {"mount_faces", transceivers},
      {"keep_out", transceivers},
      {"room", {"store/room.md"}},
      {"zones", {"store/room.md"}},
      {"inner_walls", {"store/room.md"}},
      {"openings", {"store/room.md"}},
      {"material", materials},
      {"smooth", materials},
      {"facets", materials},
      {"marks", {"store/values.md"}},
      {"label_type", label_types},
      {"responsivity", label_types},
      {"transceiver_type", transceiver_types},
      {"emission", transceiver_types},
      {"fixture", fixtures},
      {"whole_fixture", fixtures},
      {"repeat", fixtures},
      {"against", fixtures},
      {"prism", fixtures},
      {"cylinder", fixtures},
      {"panel", fixtures},
      {"gondola", shelving},
      {"freezer", shelving},
      {"box", fixtures},
      {"mesh", fixtures},
      {"label", {"store/labels.md", "store/variation.md"}},
      {"measuring_plane", {"store/labels.md"}},
      {"transceivers", transceivers},
      {"transceiver", transceivers},
      {"csv_file", {"store/csv.md"}}};
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
}  // namespace shelfbeam
