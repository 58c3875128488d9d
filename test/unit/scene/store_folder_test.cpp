#include "shelfbeam/scene/store_folder.hpp"

#include <sys/stat.h>

#include "support/testing.hpp"
#include "unit/scene/mesh/gltf_maker.hpp"

namespace shelfbeam::test {
namespace {

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
    make_scene(parse_store(mesh_store(name).dump(), "store.json", from.empty() ? home : from,
                           {.allow_outside = allow_outside}));
  }
  void read_without_links(const std::string& name, const fs::path& from) const {
    make_scene(parse_store(mesh_store(name).dump(), "store.json", from, {.allow_links = false}));
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
  for (const std::string& name :
       std::vector<std::string>{"../secret.obj", "deep/../../secret.obj", folder / "secret.obj", "out.obj",
                                "up/secret.obj", "../store/../secret.obj"}) {
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
  for (const std::string& name :
       std::vector<std::string>{"own.obj", "deep/own.obj", "deep/../own.obj", home / "own.obj"})
    EXPECT_NO_THROW(read_without_links(name, home)) << name;
  EXPECT_NO_THROW(read_without_links("own.obj", folder.path() / "also")) << "the folder by a link";
  fs::create_directory_symlink("deep", home / "short");
  fs::create_symlink("../none.obj", home / "none.obj");
  EXPECT_NO_THROW(read("short/own.obj"));
  for (const std::string name :
       {"link.obj", "short/own.obj", "short/../own.obj", "out.obj", "up/secret.obj", "none.obj"})
    expect_input_error([&] { read_without_links(name, home); },
                       "store.json: fixtures[0].file: '" + (home / name).string() + "' ", "symbolic link");
  for (const std::string& name :
       std::vector<std::string>{"../secret.obj", "deep/../../none.obj", folder / "secret.obj"})
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
  for (
      const char* change :
      {R"({"labels": {"csv": "../devices.csv"}})", R"({"transceivers": {"list": {"csv": "../devices.csv"}}})",
       R"({"transceiver_types": {"down": {"emission": {"type": "ies", "file": "../devices.csv", "flux": 1}}}})",
       R"({"transceiver_types": {"down": {"emission": {"type": "eulumdat", "file": "../devices.csv", "flux": 1}}}})",
       R"({"catalogues": ["../devices.csv"]})",
       R"({"planogram": {"file": "../devices.csv", "type": "small"}})"}) {
    Json store = mesh_store("own.obj");
    store.update(Json::parse(change));
    std::string text = store.dump();
    expect_input_error([&] { parse_store(text, "store.json", home); }, refused);
    text.erase(text.find("../devices"), 3);
    expect_input_error([&] { parse_store(text, "store.json", home, {.allow_links = false}); },
                       "symbolic link");
  }
}

TEST_F(References, OfAMeshAreConfinedToo) {
  const GltfMaker maker;
  folder.write("a b.bin", maker.bytes());
  folder.write("store/deep/a b.bin", maker.bytes());
  folder.write("store/deep/own.gltf", maker.text("a%20b.bin"));
  EXPECT_NO_THROW(read("deep/own.gltf")) << "beside the mesh, its blank as glTF writes it";
  folder.write("store/deep/up.gltf", maker.text("%2e./../a%20b.bin"));
  expect_input_error([&] { read("deep/up.gltf"); }, "fixtures[0].file: ", refused);
  EXPECT_NO_THROW(read("deep/up.gltf", true));
  fs::create_symlink("a b.bin", home / "deep/link.bin");
  folder.write("store/deep/link.gltf", maker.text("link.bin"));
  EXPECT_NO_THROW(read("deep/link.gltf"));
  expect_input_error([&] { read_without_links("deep/link.gltf", home); }, "symbolic link");
}

TEST_F(References, OfTheStoreFileItselfMayBeALink) {
  const fs::path file = folder.write("store/store.json", mesh_store("own.obj").dump());
  fs::create_symlink(file, home / "other.json");
  EXPECT_NO_THROW(read_store(home / "other.json"));
  EXPECT_NO_THROW(read_store(file, {.allow_links = false}));
  expect_input_error([&] { read_store(home / "other.json", {.allow_links = false}); }, "symbolic link");
}

TEST_F(References, AreNoLargerThanTheLimit) {
  const std::string store = mesh_store("own.obj").dump();
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
}  // namespace shelfbeam::test
