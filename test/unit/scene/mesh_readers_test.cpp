#include "support/line_ends.hpp"
#include "support/testing.hpp"
#include "unit/scene/mesh_files.hpp"

// Areas of small integers and halves, which doubles represent exactly.

namespace shelfbeam::test {
namespace {

// An arrow: a fan from its first corner would cover 4 and not 2.
const std::string arrow = "v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\n";

TEST(MeshReaders, ConcaveFacesAreTriangulated) {
  for (const std::string corners : {"1 2 3 4", "2 3 4 1", "3 4 1 2", "4 1 2 3", "4 3 2 1"}) {
    const Scene scene = read_mesh("a.obj", fmt::format("{}f {}\n", arrow, corners));
    EXPECT_EQ(scene.mesh.triangles.size(), 2u) << corners;
    EXPECT_DOUBLE_EQ(mesh_area(scene), 1) << corners;
  }
}

std::string star(int points) {
  std::string vertices, face = "f";
  for (int k = 0; k < 2 * points; ++k) {
    const double angle = std::acos(-1.0) * k / points, radius = k % 2 == 0 ? 2 : 1;
    vertices += fmt::format("v {} {} 0\n", radius * std::cos(angle), radius * std::sin(angle));
    face += fmt::format(" {}", k + 1);
  }
  return vertices + face + "\n";
}

TEST(MeshReaders, StarsAreTriangulatedAndLargeOnesRefused) {
  const Scene scene = read_mesh("a.obj", star(60));
  EXPECT_EQ(scene.mesh.triangles.size(), 118u);
  EXPECT_NEAR(mesh_area(scene), 120 * 0.5 * 2 * std::sin(std::acos(-1.0) / 60), 1e-12);
  expect_input_error([] { read_mesh("a.obj", star(10'000)); }, "20000 corners");
}

TEST(MeshReaders, ObjLinesContinueAfterABackslash) {
  EXPECT_DOUBLE_EQ(mesh_area(read_mesh("a.obj", "v 0 0 \\\n0\nv 2 0 0\nv 0 1 0\nf 1/1/1 2//2 \\\n-1\n")), 1);
  EXPECT_DOUBLE_EQ(mesh_area(read_mesh("a.obj", "v 0 0 0 \\\n\nv 2 0 0\nv 0 1 0\nf 1 2 3\n")), 1)
      << "a blank line ends it";
}

TEST(MeshReaders, ObjCommentsMayFollowData) {
  const std::string text =
      "# begins \\\nv 0 0 0 # first\nv 2 0 0#second\nv 0 1 0\t# third \\\nv 0 0 1\n"
      "usemtl red brick # from a quarry\nf 1 2 3 # front \\\nf 1/1 \\\n2/2#continued\n 4\nf 1 2 3 #\n";
  expect_input_error([&] { read_mesh("a.obj", text); }, "line 9 of '", "fewer than three corners");
  std::string good = text;
  good.replace(good.find("#continued\n"), 11, " ");
  EXPECT_DOUBLE_EQ(mesh_area(read_mesh("a.obj", good, {{"red brick", "white"}})), 3);
}

// 3ds Max numbers its materials so.
TEST(MeshReaders, ObjMaterialsMayHaveNumbers) {
  const auto material = [](const std::string& line) {
    const Json none = {{"none", "white"}};
    const std::string message = input_error(
        [&] { read_mesh("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl " + line + "\nf 1 2 3\n", none); });
    const auto begin = message.find("': ") + 3;
    return message.substr(begin, message.find(';') - begin);
  };
  EXPECT_EQ(material("Material #25"), "Material #25");
  EXPECT_EQ(material("Material#25"), "Material#25");
  EXPECT_EQ(material("Material #25 # the door"), "Material");
  EXPECT_EQ(material("Material # 25"), "Material");
  EXPECT_EQ(material("Material #the door"), "Material");
}

TEST(MeshReaders, MarksEncodingsAndLineEnds) {
  const auto solid = tetrahedron();
  for (const auto& [name, text] : {std::pair{"a.obj", obj(solid)}, std::pair{"a.ply", ply(solid, false)},
                                   std::pair{"a.stl", ascii_stl(solid)}}) {
    for (const std::string& variant :
         {"\xEF\xBB\xBF" + text, with_line_ends(text, "\r"), with_line_ends(text, "\r\n")})
      EXPECT_DOUBLE_EQ(mesh_area(read_mesh(name, variant)), tetrahedron_area) << name;
    expect_input_error([&, &file = name, &content = text] { read_mesh(file, in_utf16(content)); },
                       "store.json: fixtures[0].file: '", "is UTF-16; save it as UTF-8");
  }
  // The bytes behind the header of a binary file may begin with a line feed: the colour 10.
  std::string binary = ply(solid, true);
  const std::size_t header = binary.find("end_header\n") + 11;
  for (std::size_t vertex = 0; vertex < 12; ++vertex) binary[header + 13 * vertex] = '\n';
  for (const std::string_view end : {"\r", "\r\n"})
    EXPECT_DOUBLE_EQ(
        mesh_area(read_mesh("a.ply", with_line_ends(binary.substr(0, header), end) + binary.substr(header))),
        tetrahedron_area);
}

TEST(MeshReaders, PlyTextBehindTheLastElementIsReported) {
  for (const bool is_binary : {false, true}) {
    const auto warnings = file_warnings(read_mesh("a.ply", ply(tetrahedron(), is_binary) + "\n3 0 1 2\n"));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("'a.ply' continues after the last element"), std::string::npos) << warnings[0];
  }
}

TEST(MeshReaders, PlyStripsAreRefused) {
  std::string strips = ply(tetrahedron(), false);
  strips.insert(strips.find("end_header"), "element tristrips 1\nproperty list int int vertex_indices\n");
  expect_input_error([&] { read_mesh("a.ply", strips + "4 0 1 2 3\n"); }, "line 11", "triangle strips");
}

TEST(MeshReaders, PatternsAndNamesAreLimited) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  constexpr std::size_t count = 2000;
  for (std::size_t k = 0; k < count; ++k)
    text += "usemtl " + std::string(1000, 'a') + std::to_string(k) + "\nf 1 2 3\n";
  Json patterns{{"*", "tile"}};
  EXPECT_NO_THROW(read_mesh("a.obj", text, patterns));
  patterns["*" + std::string(500, 'b')] = "tile";
  expect_input_error([&] { read_mesh("a.obj", text, patterns); }, "patterns with 504 characters",
                     "at most 1,000,000,000");
}

// Found by fuzzing: the previous library for these files ended the program.
TEST(MeshReaders, PlyVerticesHaveThreeCoordinates) {
  const std::string good = ply(tetrahedron(), true);
  for (const std::string name : {"x", "y", "z"}) {
    std::string text = good;
    text.replace(text.find("float " + name), 7, "float w");
    expect_input_error([&] { read_mesh("a.ply", text); }, "a.ply' ", "x, y and z");
  }
  expect_input_error(
      [] { read_mesh("a.ply", "ply\nformat ascii 1.0\nelement nothing 4294967295\nend_header\n"); },
      "without properties");
}

// A square of 1 m in a mode of glTF.
Json square(int mode, const std::string& indices, int count) {
  // (0, 0), (1, 0), (0, 1), (1, 1) as bytes, each of three padded to four, then the indices.
  return Json::parse(R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":)" +
                     std::to_string(mode) + R"(}]}],
    "accessors":[{"bufferView":0,"componentType":5121,"count":4,"type":"VEC3"},
                 {"bufferView":1,"componentType":5121,"count":)" +
                     std::to_string(count) + R"(,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteLength":16,"byteStride":4},{"buffer":0,"byteOffset":16,"byteLength":6}],
    "buffers":[{"byteLength":22,"uri":"data:;base64,AAAAAAEAAAAAAQAAAQEAA)" +
                     indices + R"("}]})");
}

TEST(MeshReaders, GltfListsStripsAndFans) {
  // 16 bytes end within a base64 group, whose first two bits belong to the last byte.
  const Json list = square(4, "AABAgIBAw==", 6), strip = square(5, "AABAgMAAA==", 4),
             fan = square(6, "AABAwIAAA==", 4), points = square(0, "AABAgMAAA==", 4);
  for (const Json& file : {list, strip, fan}) {
    const Scene scene = read_mesh("a.gltf", file.dump());
    EXPECT_EQ(scene.mesh.triangles.size(), 2u);
    EXPECT_DOUBLE_EQ(mesh_area(scene), 1);
  }
  expect_input_error([&] { read_mesh("a.gltf", points.dump()); }, "no triangles");
}

TEST(MeshReaders, GltfIsNotTrusted) {
  const Json good = square(4, "AABAgIBAw==", 6);
  const auto refused = [&](const char* place, const Json& wrong, const char* message) {
    Json file = good;
    file[Json::json_pointer(place)].merge_patch(wrong);
    expect_input_error([&] { read_mesh("a.gltf", file.dump()); }, "store.json: fixtures[0].file: ", message);
  };
  refused("", {{"scenes", nullptr}}, "");
  refused("/accessors/0/count", 3, "vertex 3 of 3");
  refused("/accessors/0/count", 5, "accessors[0]: ");
  refused("/accessors/0/count", 4e15, "accessors[0].count: ");
  refused("/accessors/0/byteOffset", 14, "accessors[0]: ");
  refused("/accessors/1/byteOffset", 1, "accessors[1]: ");
  refused("/accessors/0/componentType", 5124, "componentType");
  refused("/accessors/0/type", "VEC2", "'VEC3'");
  refused("/accessors/0/bufferView", 2, "2 bufferViews");
  refused("/accessors/0/sparse", Json::object(), "accessors[0].sparse");
  refused("/bufferViews/0/byteStride", 0, "accessors[0]: ");
  refused("/bufferViews/0/byteOffset", 7, "bufferViews[0]: ");
  refused("/bufferViews/1/byteOffset", 4000, "");
  refused("/buffers/0/byteLength", 100, "22 bytes");
  refused("/buffers/0/uri", "data:;base64,A*", "base64");
  refused("/buffers/0/uri", "elsewhere.bin", "");
  refused("/nodes/0/children", {0}, "node 0 ");
  refused("/nodes/0/mesh", -1, "is -1");
  refused("/nodes/0/matrix", {1e308, 0, 0, 0, 1e308, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "infinite");
  refused("/nodes/0/matrix", Json::array({1}), "nodes[0].matrix: ");
  refused("/scene", 1, "1 scenes");
  refused("/asset/version", "1.0", "asset: ");
  refused("/extensionsRequired", {"KHR_draco_mesh_compression"}, "'KHR_draco_mesh_compression'");
  refused("/extensionsRequired", {"KHR_materials_ior", "EXT_meshopt_compression"},
          "'EXT_meshopt_compression'");
}

}  // namespace
}  // namespace shelfbeam::test
