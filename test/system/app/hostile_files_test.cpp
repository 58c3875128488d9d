#include <cstdint>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include "support/process.hpp"
#include "support/sanitizers.hpp"
#include "support/temp_folder.hpp"

// Tests files that require far more memory than they contain. A program with half a gigabyte of address space
// and a few seconds of CPU time must refuse them (exit code 2), although reading each would require many
// times as much.

namespace shelfbeam {
namespace {

using test::Outcome;
using test::TempFolder;

std::string repeated(const std::string& text, int count) {
  std::string result;
  for (int k = 0; k < count; ++k) result += text;
  return result;
}

class HostileFiles : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::memory_can_be_limited) GTEST_SKIP() << "the sanitizer needs all addresses";
  }
};

Outcome run_small(const std::string& arguments) {
  return test::run(
      {"/bin/sh", "-c", "ulimit -v 500000; ulimit -t 20; exec " SHELFBEAM_BINARY " " + arguments});
}

// A store with `gondolas` gondolas of a million labels each.
std::string store_of(int gondolas) {
  std::string fixtures;
  for (int k = 0; k < gondolas; ++k)
    fixtures += (k > 0 ? "," : "") + std::string(R"({"type":"gondola","id":"G)") + std::to_string(k) +
                R"(","at":[1,1],"length":900,"depth":1,"height":2,"material":"m","shelves":[0.5],
                "labels":{"type":"l","spacing":0.002}})";
  return R"({"room":{"size":[1000,9,3],"floor":"m","ceiling":"m","walls":"m"},
    "materials":{"m":{"type":"lambertian","reflectance":0.5}},"label_types":{"l":{"threshold":0.02}},
    "transceiver_types":{"t":{"emission":{"type":"isotropic","intensity":1}}},
    "transceivers":{"list":[{"id":"T","position":[5,5,2],"type":"t"}]},"fixtures":[)" +
         fixtures + "]}";
}

std::string mesh_store(const std::string& file) {
  return R"({"materials":{"m":{"type":"lambertian","reflectance":0.5}},"label_types":{"l":{"threshold":0.02}},
    "transceiver_types":{"t":{"emission":{"type":"isotropic","intensity":1}}},
    "transceivers":{"list":[{"id":"T","position":[5,5,2],"type":"t"}]},
    "fixtures":[{"type":"mesh","id":"M","at":[0,0,0],"file":")" +
         file + R"(","materials":{"*":"m"}}]})";
}

std::string npy(const std::string& shape) {
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': " + shape + ", }\n";
  return "\x93NUMPY\x01" + std::string(1, '\0') + static_cast<char>(header.size()) + std::string(1, '\0') +
         header + "1234";
}

void expect_refused(const std::string& arguments, const std::string& message, int exit_code = 2) {
  const Outcome outcome = run_small(arguments);
  EXPECT_EQ(outcome.exit_code, exit_code) << arguments << ": " << outcome.err;
  EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
}

TEST_F(HostileFiles, StoresThatMultiply) {
  const TempFolder folder;
  const std::string store = folder.write("store.json", store_of(100));
  const std::string rest = " -o " + (folder / "signal.h5").string() + " --memory ";
  expect_refused("simulate " + store + rest + "300M", "(--memory)", 5);
  // With a higher limit than the address space, the memory runs out.
  expect_refused("simulate " + store + rest + "500G",
                 store + ": requires about 92.9 GB of memory, more than is ", 5);
  // Without an option, the limit is that of the process.
  expect_refused("inspect " + store, "the limit is 0.4", 5);
}

// A room of 30 x 20 m with these keys besides.
std::string shop_of(const std::string& keys, const std::string& room = R"("size":[30,20,3])") {
  return R"({"room":{)" + room + R"(,"floor":"m","ceiling":"m","walls":"m"},
    "materials":{"m":{"type":"lambertian","reflectance":0.5}},"label_types":{"l":{"threshold":0.02}},
    "transceiver_types":{"t":{"emission":{"type":"isotropic","intensity":1}}},
    "labels":[{"id":"L","position":[1,1,1],"normal":[1,0,0],"type":"l"}],)" +
         keys + "}";
}

TEST_F(HostileFiles, ShapesThatMultiply) {
  const TempFolder folder;
  const auto refused = [&](const std::string& store, const std::string& message) {
    const int code = message.find("requires about") == std::string::npos ? 2 : 5;
    expect_refused("inspect " + folder.write("store.json", store).string(), message, code);
  };
  const auto with_units = [](const std::string& transceivers) {
    return shop_of(R"("transceivers":{)" + transceivers + "}");
  };
  refused(with_units(R"("areas":[{"type":"t","area":"room","spacing":1e-9,"z":2}])"),
          "areas[0].spacing: is 1e-09");
  refused(with_units(R"("areas":[{"type":"t","area":"room","spacing":0.025,"z":2}])"),
          "areas[0]: the store up to here requires about 0.9");
  refused(with_units(R"("areas":[{"type":"t","area":[[-9e3,0],[9e3,0],[0,9e3]],"spacing":0.025,"z":2}])"),
          "areas[0]: the store up to here requires about 0.9");
  refused(with_units(R"("rails":[{"type":"t","id":"R","points":[[-9e3,1,2],[9e3,1,2]],"spacing":0.001}])"),
          "rails[0].spacing: produces 18000001 candidates");
  const std::string rest = R"(,"transceivers":{"list":[{"id":"T","position":[2,2,2],"type":"t"}]})";
  const std::string corner = R"({"type":"prism","top":1,"material":"m","polygon":[[1,1],[2,1],[2,2]],"id":")";
  refused(
      shop_of(R"("fixtures":[)" + corner + R"(P{n}","repeat":{"count":1000000000,"step":[1,0]}}])" + rest),
      "repeat.count: is 1000000000");
  refused(shop_of(R"("fixtures":[)" + corner + repeated("{n}", 200'000) +
                  R"(","repeat":{"count":10000,"step":[0.001,0]}}])" + rest),
          "fixtures[0]: the store up to here requires about 0.4");
  std::string presets;
  for (int k = 0; k < 9999; ++k)
    presets += "\"" + std::to_string(k) + R"(":{"preset":")" + std::to_string(k + 1) + "\"},";
  refused(shop_of(R"("presets":{)" + presets + R"("end":{}},"fixtures":[)" +
                  repeated(R"({"preset":"0"},)", 1000) + R"({"preset":"0"}])" + rest),
          "is the end of a chain of 100 presets");
  std::string walls;
  for (int k = 0; k < 1000; ++k)
    walls += (k > 0 ? R"(,{"id":")" : R"({"id":")") + std::to_string(k) + R"(","from":[)" +
             std::to_string(1 + 0.02 * k) + R"(,1],"to":[)" + std::to_string(29 - 0.02 * k) + ",19]}";
  refused(shop_of(rest.substr(1), R"("size":[30,20,3],"inner_walls":[)" + walls + "]"),
          "room: has edges that meet in more than 20,000 points of its plan");
  std::string corners = "[0,0]";
  for (int k = 0; k < 100'000; ++k) corners += ",[20," + std::to_string(1e-4 * k) + "]";
  refused(shop_of(rest.substr(1), R"("height":3,"outline":[)" + corners + "]"),
          "room.outline: has 100001 corners");
  folder.write("p.csv", "article,fixture,face,level,position\n1,G,front,1,1000000000\n");
  refused(
      shop_of(R"("planogram":{"file":"p.csv","type":"l"},"fixtures":[{"type":"gondola","id":"G","at":[5,5],
    "length":3,"depth":1,"height":2,"material":"m","shelves":[0.5]}])" +
              rest),
      "p.csv: line 2, field 5: is 1e+09");
}

// The light of 5,000 labels for previews requires more than 0.4 GB.
TEST_F(HostileFiles, ShopsWithTooManyLabels) {
  const std::string store = SHELFBEAM_SOURCE_DIR "/examples/supermarket/store.json";
  expect_refused("preview " + store + " --unit 2,2,2.9", "GB of memory", 5);
}

TEST_F(HostileFiles, DeeplyNestedBrackets) {
  const TempFolder folder;
  const std::string store = folder.write("store.json", std::string(3'000'000, '['));
  expect_refused("inspect " + store, "100 ");
  const std::string objects = folder.write("objects.json", repeated("{\"a\":", 500'000));
  expect_refused("inspect " + objects, "100 ");
}

TEST_F(HostileFiles, MeshesThatClaimMore) {
  const TempFolder folder;
  folder.write("a.ply",
               "ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\nproperty float x\nproperty "
               "float y\nproperty float z\nend_header\n1234");
  folder.write("a.gltf",
               R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4000000000,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":3}],"buffers":[{"byteLength":3,"uri":"data:;base64,AAAA"}]})");
  expect_refused("inspect " + folder.write("ply.json", mesh_store("a.ply")).string(), "a.ply'");
  expect_refused("inspect " + folder.write("gltf.json", mesh_store("a.gltf")).string(), "accessors[0]: ");
}

// A mesh of few bytes that many nodes instantiate.
TEST_F(HostileFiles, MeshesThatMultiply) {
  const TempFolder folder;
  constexpr int nodes = 20'000;
  constexpr std::size_t triangles = 2'000;
  std::string numbers, objects;
  for (int k = 0; k < nodes; ++k) {
    numbers += (k > 0 ? "," : "") + std::to_string(k);
    objects += std::string(k > 0 ? "," : "") + "{\"mesh\":0}";
  }
  // Triangles in base64, 48 characters each, with all positions 0.
  folder.write("a.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[)" + numbers + R"(]}],"nodes":[)" +
                             objects +
                             R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":)" +
                             std::to_string(3 * triangles) +
                             R"(,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":)" +
                             std::to_string(36 * triangles) + R"(}],"buffers":[{"byteLength":)" +
                             std::to_string(36 * triangles) + R"(,"uri":"data:;base64,)" +
                             std::string(48 * triangles, 'A') + R"("}]})");
  const std::string store = folder.write("store.json", mesh_store("a.gltf"));
  expect_refused("simulate " + store + " -o " + (folder / "signal.h5").string() + " --memory 300M",
                 "triangles");
}

TEST_F(HostileFiles, MatricesThatClaimMore) {
  const TempFolder folder;
  const auto place = [&](const std::string& file) {
    return "place " + file + " -o " + (folder / "placement.json").string() + " --threshold 1";
  };
  expect_refused(place(folder.write("a.npy", npy("(4294967294, 4294967294)"))), "(4294967294, 4294967294)");
  expect_refused(place(folder.write("a.txt", "4000000000 4000000000 1\n0\n")), "m is 4000000000");
  expect_refused(place(folder.write("b.txt", "4000000000 4000000000\n1 1\n")), "m is 4000000000");
}

// Sparse files of 200 GB, which take no room on the disk.
TEST_F(HostileFiles, FilesThatAreTooLarge) {
  const TempFolder folder;
  for (const char* name : {"a.stl", "a.npy", "a.csv", "a.h5", "a.json"})
    std::filesystem::resize_file(folder.write(name, ""), std::uintmax_t{200} << 30);
  const std::filesystem::path signal =
      folder.write("b.h5", "shelfbeam signal file, XXH3-128 of what follows this line: ");
  std::filesystem::resize_file(signal, std::uintmax_t{200} << 30);
  folder.write("store.json", mesh_store("a.stl"));
  const auto refuse = [&](const std::string& verb, const std::string& file, const std::string& name) {
    expect_refused(verb + " " + (folder / file).string(),
                   name + ": has 214,748,364,800 bytes; the maximum is ");
  };
  refuse("inspect", "store.json", "a.stl");
  refuse("inspect", "a.json", "a.json");
  for (const std::string name : {"a.npy", "a.csv", "a.h5", "b.h5"}) refuse("place --threshold 1", name, name);
}

TEST_F(HostileFiles, FilesThatAreNotRegular) {
  const TempFolder folder;
  const std::string pipe = (folder / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& path : {pipe, std::string("/dev/zero")})
    for (const std::string verb : {"inspect ", "place "})
      expect_refused(verb + path, path + ": is not a regular file");
  const std::string store = folder.write("store.json", store_of(0));
  expect_refused("verify " + store + " " + pipe, "pipe: is not a regular file");
}

// A gzip file that unpacks to a thousand times its size.
TEST_F(HostileFiles, FilesThatUnpackWithoutEnd) {
  const TempFolder folder;
  const std::string path = (folder / "a.txt.gz").string();
  const std::string text(1 << 20, ' ');
  const gzFile file = gzopen(path.c_str(), "wb1");
  gzputs(file, "1 1 1\n");
  for (int k = 0; k < 300; ++k) gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  const Outcome outcome = test::run({SHELFBEAM_BINARY, "place", path});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find(path + ": has more than 268,435,456 bytes"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace shelfbeam
