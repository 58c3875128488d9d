#include "serve/live/file_facts.hpp"

#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

#include "support/temp_folder.hpp"

namespace shelfbeam::serve {
namespace {

namespace fs = std::filesystem;

using test::TempFolder;

const fs::path chiller = SHELFBEAM_SOURCE_DIR "/examples/chiller";

nlohmann::ordered_json facts(const fs::path& folder, const std::string& name) {
  return facts_of_file(folder, name, {.allow_links = false});
}

TEST(FileFacts, OfAProfileAreItsShape) {
  const auto photometry = facts(chiller, "batwing.ies")["photometry"];
  EXPECT_EQ(photometry["type"], "ies");
  ASSERT_EQ(photometry["planes"].size(), 4U);
  double largest = 0;
  for (const auto& plane : photometry["planes"]) {
    EXPECT_EQ(plane.size(), 37U);
    for (const double value : plane) largest = std::max(largest, value);
    EXPECT_EQ(plane[0], photometry["planes"][0][0]) << "the axis is in all planes";
  }
  EXPECT_LE(largest, 1);
  EXPECT_GT(largest, 0.9);
  EXPECT_EQ(facts(chiller, "narrow-aisle.ldt")["photometry"]["type"], "eulumdat");
}

TEST(FileFacts, OfAMeshAreItsSizeAndMaterials) {
  const TempFolder folder;
  folder.write("table.obj",
               "v 0 0 0\nv 2 0 0\nv 2 0.5 3\nv 0 0 3\nusemtl wood\nf 1 2 3\nusemtl steel\nf 1 3 4\nusemtl "
               "wood\nf 1 2 4\n");
  const auto mesh = facts(folder.path(), "table.obj")["mesh"];
  EXPECT_EQ(mesh["lower"], (nlohmann::ordered_json{0.0, 0.0, 0.0}));
  EXPECT_EQ(mesh["upper"], (nlohmann::ordered_json{2.0, 0.5, 3.0}));
  ASSERT_EQ(mesh["materials"].size(), 2U);
  EXPECT_EQ(mesh["materials"][0], (nlohmann::ordered_json{{"name", "wood"}, {"triangles", 2}}));
}

TEST(FileFacts, AreOfFilesInTheFolderAlone) {
  const TempFolder folder;
  folder.write("inner/store.json", "{}");
  fs::copy(chiller / "batwing.ies", folder / "outer.ies");
  fs::create_symlink("../outer.ies", folder / "inner" / "link.ies");
  const fs::path inner = folder / "inner";
  for (const std::string& name :
       {std::string("../outer.ies"), (folder / "outer.ies").string(), std::string("link.ies"),
        std::string("missing.ies"), std::string("../outer.obj")})
    EXPECT_THROW(facts(inner, name), InputError) << name;
  EXPECT_TRUE(facts(inner, "store.json").empty());
}

TEST(FileFacts, RefuseWhatNoStoreCanUse) {
  const TempFolder folder;
  folder.write("cut.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 2 3\n");
  folder.write("cut.obj", "v 1 2\nf 1 2 3\n");
  folder.write("cut.glb", "glTF");
  for (const char* name : {"cut.ies", "cut.obj", "cut.glb"})
    EXPECT_THROW(facts(folder.path(), name), InputError) << name;
}

}  // namespace
}  // namespace shelfbeam::serve
