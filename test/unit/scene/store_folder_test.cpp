#include "shelfbeam/scene/store_folder.hpp"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/scene/mesh_files.hpp"

namespace shelfbeam {
namespace {

using test::expect_input_error;
using test::Json;
using test::TempFolder;
namespace fs = std::filesystem;

constexpr const char* refused = "outside the folder of the store file";

class References : public testing::Test {
 protected:
  References() {
    folder.write("secret.obj", triangle);
    folder.write("store/own.obj", triangle);
    folder.write("store/deep/own.obj", triangle);
    fs::create_symlink("own.obj", home / "link.obj");
    fs::create_symlink("../secret.obj", home / "out.obj");
    fs::create_directory_symlink("..", home / "up");
    fs::create_directory_symlink(home, folder.path() / "also");
  }
  void read(const std::string& name, bool allow_outside = false, const fs::path& from = {}) const {
    make_scene(parse_store(test::mesh_store(name).dump(), "store.json", from.empty() ? home : from,
                           {.allow_outside = allow_outside}));
  }
  void read_without_links(const std::string& name, const fs::path& from) const {
    make_scene(parse_store(test::mesh_store(name).dump(), "store.json", from, {.allow_links = false}));
  }
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  TempFolder folder;
  fs::path home = folder.path() / "store";
};

TEST_F(References, BelowTheFolderAreRead) {
  for (const std::string name : {"own.obj", "./own.obj", "deep/own.obj", "deep/../own.obj", "link.obj"})
    EXPECT_NO_THROW(read(name)) << name;
  EXPECT_NO_THROW(read((home / "own.obj").string())) << "absolute, and in the folder";
  EXPECT_NO_THROW(read("own.obj", false, folder.path() / "also")) << "the folder by a link";
}

TEST_F(References, OutsideAreRefusedUnlessAllowed) {
  const std::string absolute = (folder.path() / "secret.obj").string();
  for (const std::string& name :
       {std::string("../secret.obj"), std::string("deep/../../secret.obj"), absolute, std::string("out.obj"),
        std::string("up/secret.obj"), std::string("../store/../secret.obj")}) {
    expect_input_error([&] { read(name); }, "store.json: fixtures[0].file: '" + name + "' ", refused);
    EXPECT_NO_THROW(read(name, true)) << name;
  }
}

// The message does not reveal whether a forbidden file exists.
TEST_F(References, OutsideAreRefusedWhetherOrNotTheyExist) {
  expect_input_error([&] { read("../none.obj"); }, refused);
  expect_input_error([&] { read("/etc/passwd"); }, refused);
  expect_input_error([&] { read(""); }, "fixtures[0].file: ", "empty");
  expect_input_error([&] { read(std::string("a\0.obj", 6)); }, "null character");
  expect_input_error([&] { read(std::string(100'000, 'a')); }, "fixtures[0].file: ");
  expect_input_error([&] { read(".."); }, refused);
  expect_input_error([&] { read("../store-2/own.obj"); }, refused);
  expect_input_error([&] { read("../none.obj", true); }, "none.obj' ", "exist");
}

TEST_F(References, ByLinksAreReadOnlyIfAllowed) {
  const std::string absolute = (home / "own.obj").string();
  for (const std::string& name :
       {std::string("own.obj"), std::string("deep/own.obj"), std::string("deep/../own.obj"), absolute})
    EXPECT_NO_THROW(read_without_links(name, home)) << name;
  EXPECT_NO_THROW(read_without_links("own.obj", folder.path() / "also")) << "the folder by a link";
  fs::create_directory_symlink("deep", home / "short");
  fs::create_symlink("../none.obj", home / "none.obj");
  EXPECT_NO_THROW(read("short/own.obj"));
  for (const std::string name :
       {"link.obj", "short/own.obj", "short/../own.obj", "out.obj", "up/secret.obj", "none.obj"})
    expect_input_error([&] { read_without_links(name, home); },
                       "store.json: fixtures[0].file: '" + (home / name).string() + "' ", "symbolic link");
  for (const std::string& name : {std::string("../secret.obj"), std::string("deep/../../none.obj"),
                                  (folder.path() / "secret.obj").string()})
    expect_input_error([&] { read_without_links(name, home); }, refused);
}

TEST_F(References, ToWhatCannotBeReadDoNotWait) {
  ASSERT_EQ(::mkfifo((home / "pipe.obj").c_str(), 0600), 0);
  expect_input_error([&] { read("pipe.obj"); }, "pipe.obj' is not a regular file");
  expect_input_error([&] { read("pipe.obj", true); }, "pipe.obj' is not a regular file");
  expect_input_error([&] { read_without_links("pipe.obj", home); }, "pipe.obj' is not a regular file");
  expect_input_error([&] { read("/dev/zero", true); }, "'/dev/zero' is not a regular file");
}

TEST_F(References, OfAnyKindAreConfined) {
  folder.write("devices.csv", "");
  fs::create_symlink("none.csv", home / "devices.csv");
  const Json planogram{{"file", "../devices.csv"}, {"type", "small"}};
  for (const Json& change :
       {Json{{"labels", {{"csv", "../devices.csv"}}}},
        Json{{"transceivers", {{"list", {{"csv", "../devices.csv"}}}}}},
        Json{{"transceiver_types",
              {{"down", {{"emission", {{"type", "ies"}, {"file", "../devices.csv"}, {"flux", 1}}}}}}}},
        Json{{"transceiver_types",
              {{"down", {{"emission", {{"type", "eulumdat"}, {"file", "../devices.csv"}, {"flux", 1}}}}}}}},
        Json{{"catalogues", {"../devices.csv"}}}, Json{{"planogram", planogram}}}) {
    Json store = test::mesh_store("own.obj");
    store.update(change);
    std::string text = store.dump();
    expect_input_error([&] { parse_store(text, "store.json", home); }, refused);
    text.erase(text.find("../devices"), 3);
    expect_input_error([&] { parse_store(text, "store.json", home, {.allow_links = false}); },
                       "symbolic link");
  }
}

TEST_F(References, OfAMeshAreConfinedToo) {
  const auto gltf = [](const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
      "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
           uri + R"("}]})";
  };
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string bytes(reinterpret_cast<const char*>(corners), sizeof corners);
  folder.write("a b.bin", bytes);
  folder.write("store/deep/a b.bin", bytes);
  folder.write("store/deep/own.gltf", gltf("a%20b.bin"));
  EXPECT_NO_THROW(read("deep/own.gltf")) << "beside the mesh, its blank as glTF writes it";
  folder.write("store/deep/up.gltf", gltf("%2e./../a%20b.bin"));
  expect_input_error([&] { read("deep/up.gltf"); }, "fixtures[0].file: ", refused);
  EXPECT_NO_THROW(read("deep/up.gltf", true));
  fs::create_symlink("a b.bin", home / "deep/link.bin");
  folder.write("store/deep/link.gltf", gltf("link.bin"));
  EXPECT_NO_THROW(read("deep/link.gltf"));
  expect_input_error([&] { read_without_links("deep/link.gltf", home); }, "symbolic link");
}

TEST_F(References, OfTheStoreFileItselfMayBeALink) {
  const fs::path file = folder.write("store/store.json", test::mesh_store("own.obj").dump());
  fs::create_symlink(file, home / "other.json");
  EXPECT_NO_THROW(read_store(home / "other.json"));
  EXPECT_NO_THROW(read_store(file, {.allow_links = false}));
  expect_input_error([&] { read_store(home / "other.json", {.allow_links = false}); }, "symbolic link");
}

TEST_F(References, AreNoLargerThanTheLimit) {
  const std::string store = test::mesh_store("own.obj").dump();
  ASSERT_GT(store.size(), triangle.size());
  const fs::path file = folder.write("store/store.json", store);
  EXPECT_NO_THROW(read_store(file, {.file_size = store.size()}));
  expect_input_error([&] { read_store(file, {.file_size = store.size() - 1}); }, file.string(),
                     "the maximum is");
  const auto parse = [&](std::uint64_t limit) {
    parse_store(store, "store.json", home, {.file_size = limit});
  };
  EXPECT_NO_THROW(parse(triangle.size()));
  expect_input_error([&] { parse(triangle.size() - 1); }, "fixtures[0].file: ", "the maximum is");
}

}  // namespace
}  // namespace shelfbeam
