#include "support/documentation.hpp"

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

TEST(Documentation, ExampleOfTheStoreFileIsAccepted) {
  const auto examples = fenced_blocks("store.md", "jsonc");
  ASSERT_EQ(examples.size(), 2u);
  const Scene scene = make_scene(test::read_text(examples[0]));
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
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

// The example store file with the types of a fragment.
Store with_types(const std::string& fragment) {
  Json store = Json::parse(fenced_blocks("store.md", "jsonc")[0], nullptr, true, true);
  const Json types = Json::parse(fragment, nullptr, true, true);
  for (const auto& [section, members] : types.items()) store[section].update(members);
  return test::read_text(store.dump(), SHELFBEAM_SOURCE_DIR "/data/photometry");
}

TEST(Documentation, ExamplesOfTypesAreAccepted) {
  const Store store = with_types(fenced_blocks("store.md", "jsonc").at(1));
  EXPECT_EQ(store.materials.size(), 4u + 6);
  ASSERT_EQ(store.label_types.size(), 1u + 3);
  ASSERT_EQ(store.transceiver_types.size(), 1u + 3);
  const Emission& aisle = store.transceiver_types[1].emission;
  EXPECT_NEAR(store.label_types[1].threshold, mean_intensity(aisle, 0) / 36, 1e-15);
  const Store measured = with_types("{" + fenced_blocks("photometry.md", "jsonc").at(0) + "}");
  ASSERT_EQ(measured.transceiver_types.size(), 1u + 2);
  EXPECT_NEAR(power(measured.transceiver_types[2].emission), 0.8, 1e-14);
}

TEST(Documentation, CsvExamplesAreAccepted) {
  const auto files = fenced_blocks("store.md", "csv");
  ASSERT_EQ(files.size(), 2u);
  const test::TempFolder folder;
  folder.write("labels.csv", files[0]);
  folder.write("units.csv", files[1]);
  Json store = Json::parse(fenced_blocks("store.md", "jsonc")[0], nullptr, true, true);
  store["labels"] = {{"csv", "labels.csv"}};
  store["transceivers"]["list"] = {{"csv", "units.csv"}};
  const Scene scene = test::scene_of(store, folder.path());
  EXPECT_EQ(ids_of(scene).back(), "stand, left");
  EXPECT_EQ(scene.transceivers.back().id, "till");
}

TEST(Documentation, ErrorsAreAsShown) {
  const std::string page = read_file(SHELFBEAM_SOURCE_DIR "/docs/formats/store.md");
  Json store = Json::parse(fenced_blocks("store.md", "jsonc")[0], nullptr, true, true);
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

}  // namespace
}  // namespace shelfbeam
