// Tests places in store files, the facts of files that a store names, and the search for warnings.

#include "serve/live/file_facts.hpp"
#include "serve/live/place.hpp"
#include "serve/live/warning_finder.hpp"
#include "unit/serve/testing.hpp"

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

using namespace std::chrono_literals;
using Clock = WarningFinder::Clock;

// A program that answers as `inspect --json` does, and writes down each of its runs.
fs::path program(const TempFolder& folder, const std::string& answer) {
  fs::path path = folder.path() / "program";
  std::ofstream(path) << "#!/bin/sh\necho run >> '" << (folder.path() / "runs").string() << "'\necho '"
                      << answer << "'\n";
  fs::permissions(path, fs::perms::owner_all);
  return path;
}

std::optional<nlohmann::ordered_json> result(WarningFinder& finder, Clock::time_point now) {
  std::optional<nlohmann::ordered_json> found;
  becomes_true([&] { return (found = finder.poll(now)).has_value(); });
  return found;
}

TEST(WarningFinder, BeginsWhenTheFileIsQuiet) {
  const TempFolder folder;
  WarningFinder finder("store.json", program(folder, R"({"findings": [{"path": "room"}]})").string());
  const auto start = Clock::now();
  EXPECT_FALSE(finder.poll(start)) << "nothing has changed";
  finder.restart(start);
  finder.restart(start + 200ms);
  EXPECT_FALSE(finder.poll(start + 400ms));
  EXPECT_FALSE(fs::exists(folder.path() / "runs"));
  const auto found = result(finder, start + 600ms);
  ASSERT_TRUE(found);
  EXPECT_EQ((*found)[0]["path"], "room");
  EXPECT_FALSE(finder.poll(start + 10s)) << "once for each change";
}

TEST(WarningFinder, FindsNoneInAStoreWithProblemsAndTellsOfAFailure) {
  for (const auto& [answer, codes] :
       {std::pair(R"({"problems": [1]})", std::vector<std::string>()), {"", {"not_checked"}}}) {
    const TempFolder folder;
    WarningFinder finder("store.json", program(folder, answer).string());
    finder.restart(Clock::now());
    const auto found = result(finder, Clock::now() + 1s);
    ASSERT_TRUE(found);
    std::vector<std::string> found_codes;
    for (const auto& warning : *found) found_codes.push_back(warning["code"]);
    EXPECT_EQ(found_codes, codes);
  }
}

}  // namespace
}  // namespace shelfbeam::serve
