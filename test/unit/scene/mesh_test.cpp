#include "shelfbeam/base/file.hpp"

#include "support/testing.hpp"
#include "unit/scene/mesh/gltf_maker.hpp"

// Mesh files store coordinates and node transforms as 32-bit numbers. Coordinates here are below 64 m, so
// they are exact to 4e-6 m, and a sum of a few of them to 2e-5 m. The check at that tolerance rejects a wrong
// axis, order of transforms or scale, each of which moves a vertex by more than 0.1 m.

namespace shelfbeam::test {
namespace {

constexpr double single = 2e-5;

void expect_near(const Vec3& p, const Vec3& expected) {
  EXPECT_LT(length(p - expected), single) << p.x << ' ' << p.y << ' ' << p.z;
}

const std::filesystem::path grocery = SHELFBEAM_SOURCE_DIR "/examples/grocery";

TEST(Mesh, OfTheGroceryCheckout) {
  const Json materials = {{"Painted*", "steel"}, {"BeltRubber", "tile"}, {"*Plastic", "white"}};
  const Scene scene = scene_of(mesh_store("checkout.glb", materials), grocery);
  // 3 blocks, a belt, and 2 blocks with a pole of 12 sides (scripts/make-example-meshes).
  EXPECT_EQ(scene.mesh.triangles.size(), 36u + 12 + 24 + 48);
  auto area = areas_of(scene);
  const auto block = [](double a, double b, double c) { return 2 * (a * b + b * c + c * a); };
  EXPECT_NEAR(area["tile"], block(2.15, 0.03, 0.44), 1e-5);
  const double turn = 2 * std::acos(-1.0) / 12;
  const double pole = 12 * 2 * 0.03 * std::sin(turn / 2) * 1.35 + 12 * 0.03 * 0.03 * std::sin(turn);
  EXPECT_NEAR(area["white"], block(0.05, 0.3, 0.4) + block(0.05, 0.25, 0.4) + pole, 1e-5);
  // y is up in glTF: the 0.6 m of the counter from z = 0 extend towards -y here, and its sign is at 2.2 m.
  expect_near(scene.lower, {0, -0.6, 0});
  expect_near(scene.upper, {3.4, 0.7, 2.2});
  ASSERT_EQ(scene.fixtures.size(), 1u);
  EXPECT_NEAR(scene.fixtures[0].height, 2.2, single);
  EXPECT_EQ(scene.parts.size(), 3u);
}

TEST(Mesh, IsTransformed) {
  const TempFolder folder;
  folder.write("corner.obj", "v 0 0 0\nv 2 0 0\nv 0 4 0\nv 0 0 6\nf 1 2 3\nf 1 2 4\n");
  Json store = mesh_store("corner.obj");
  store["fixtures"][0].update(Json{{"at", {10, 20, 1}}, {"rotation_deg", 90}, {"scale", 0.5}});
  const Scene scene = scene_of(store, folder.path());
  ASSERT_EQ(scene.mesh.triangles.size(), 2u);
  // (2, 0, 0) is scaled to (1, 0, 0), rotated to (0, 1, 0), and moved; z is up in OBJ.
  const auto& p = scene.mesh.vertices;
  const auto& [a, b, c] = scene.mesh.triangles[0];
  expect_near(p[a], {10, 20, 1});
  expect_near(p[b], {10, 21, 1});
  expect_near(p[c], {8, 20, 1});
  expect_near(p[scene.mesh.triangles[1][2]], {10, 20, 4});
  store["fixtures"][0]["up"] = "y";
  const Scene upright = scene_of(store, folder.path());
  // (0, 4, 0) points up now; (0, 0, 6) points to -y before the rotation and to +x after it.
  expect_near(upright.mesh.vertices[upright.mesh.triangles[0][2]], {10, 20, 3});
  expect_near(upright.mesh.vertices[upright.mesh.triangles[1][2]], {13, 20, 1});
}

// The corners of a glTF file with these nodes: (0, 0, 0), (0, 2, 0), (1, 0, 0) are those of its first
// triangle.
std::vector<Vec3> corners(const Json& nodes) {
  GltfMaker maker;
  maker.file["nodes"] = nodes;
  const Scene scene = maker.scene();
  std::vector<Vec3> result;
  for (const auto& triangle : scene.mesh.triangles)
    for (const auto v : triangle) result.push_back(scene.mesh.vertices[v]);
  return result;
}

// Converts y-up coordinates of the file to z-up coordinates of the scene.
Vec3 upright(double x, double y, double z) {
  return {x, -z, y};
}

TEST(Mesh, NodesMoveTurnAndScale) {
  const double half = std::sqrt(0.5);
  // A rotation by 90 degrees about x takes y to z and z to -y.
  const auto p = corners(
      {{{"mesh", 0}, {"translation", {10, 20, 30}}, {"rotation", {half, 0, 0, half}}, {"scale", {2, 3, 4}}}});
  expect_near(p.at(0), upright(10, 20, 30));
  expect_near(p.at(1), upright(10, 20, 36));
  expect_near(p.at(2), upright(12, 20, 30));
}

TEST(Mesh, NodesAreNested) {
  // The child is moved by 1 along its own x, then scaled by 2 relative to its parent, then moved by 5 along
  // y.
  const auto p = corners({{{"children", {1}}, {"scale", {2, 2, 2}}, {"translation", {0, 5, 0}}},
                          {{"mesh", 0}, {"translation", {1, 0, 0}}}});
  expect_near(p.at(0), upright(2, 5, 0));
  expect_near(p.at(1), upright(2, 9, 0));
  expect_near(p.at(2), upright(4, 5, 0));
}

TEST(Mesh, NodesMayHaveAMatrixAndShareAMesh) {
  // Columns: x stays, y becomes -y (a mirror), z stays; moved by (7, 8, 9).
  const Json matrix{1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1};
  const auto p = corners({{{"children", {1, 2}}}, {{"mesh", 0}, {"matrix", matrix}}, {{"mesh", 0}}});
  ASSERT_EQ(p.size(), 24u);
  const auto has = [&](const Vec3& wanted) {
    return std::any_of(p.begin(), p.end(), [&](const Vec3& q) { return length(q - wanted) < single; });
  };
  for (const Vec3& corner :
       {upright(7, 8, 9), upright(8, 8, 9), upright(7, 6, 9), upright(0, 0, 0), upright(0, 2, 0)})
    EXPECT_TRUE(has(corner)) << corner.x << ' ' << corner.y << ' ' << corner.z;
  EXPECT_FALSE(has(upright(7, 10, 9))) << "the mirror must show";
}

TEST(Mesh, ExtensionInCapitalsIsGltfToo) {
  expect_near(read_mesh("MESH.GLTF", GltfMaker().text()).upper, {1, 0, 2});
}

TEST(Mesh, FirstPatternThatMatchesCounts) {
  const TempFolder folder;
  folder.write("colours.mtl",
               "newmtl red brick\nKd 1 0 0\nnewmtl red paint\nKd 1 0 0\nnewmtl glass\nKd 0 0 1\n");
  folder.write("three.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nmtllib colours.mtl\n"
               "usemtl red brick\nf 1 2 3\nusemtl red paint\nf 1 2 4\nusemtl glass\nf 1 3 4\n");
  const auto area = [&](const Json& materials) {
    return areas_of(scene_of(mesh_store("three.obj", materials), folder.path()));
  };
  const double half = 0.5, all = 1.5;
  const auto first = area({{"red paint", "tile"}, {"red*", "steel"}, {"?lass", "white"}});
  EXPECT_NEAR(first.at("tile"), half, 1e-6);
  EXPECT_NEAR(first.at("steel"), half, 1e-6);
  EXPECT_NEAR(first.at("white"), half, 1e-6);
  const auto second = area({{"red*", "steel"}, {"red paint", "tile"}, {"*", "white"}});
  EXPECT_NEAR(second.at("steel"), 2 * half, 1e-6);
  EXPECT_EQ(second.count("tile"), 0u);
  EXPECT_NEAR(area({{"*", "snow"}}).at("snow"), all, 1e-6);
}

TEST(Mesh, SurfacesWithoutAMaterialTakeTheStar) {
  GltfMaker maker;
  Json& primitives = maker.file["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[1].erase("material");
  const auto read = [&](const Json& materials) { return read_mesh("mixed.gltf", maker.text(), materials); };
  const auto area = areas_of(read({{"m", "tile"}, {"*", "steel"}}));
  EXPECT_NEAR(area.at("tile"), tetrahedron_area, 1e-6);
  EXPECT_NEAR(area.at("steel"), tetrahedron_area, 1e-6);
  const Json neither = {{"D*", "tile"}};
  expect_input_error([&] { read(neither); }, "mixed.gltf': m, ", "surfaces without");
  expect_input_error([&] { read({{"m", "tile"}}); }, "surfaces of", "mixed.gltf'");
}

TEST(Mesh, NamesThatAreNotUtf8DoNoHarm) {
  const TempFolder folder;
  folder.write("odd.obj", "usemtl caf\xE9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Store store = read(mesh_store("odd.obj"), folder.path());
  EXPECT_NO_THROW(resolved_store_json(store, make_scene(store)));
}

// Texts of other formats are refused by test/data/refused/meshes.jsonc and MeshFormats.
TEST(Mesh, BrokenFilesAreRefused) {
  const std::string good = read_file(grocery / "checkout.glb");
  for (const auto& [name, content] :
       std::vector<std::pair<std::string, std::string>>{{"empty.glb", ""},
                                                        {"magic.glb", "glTF"},
                                                        {"header.glb", good.substr(0, 20)},
                                                        {"half.glb", good.substr(0, good.size() / 2)},
                                                        {"text.glb", "this is no mesh"},
                                                        {"cut.gltf", GltfMaker().text().substr(0, 300)},
                                                        {"store.json", sample_store().dump()}})
    expect_input_error([&, &file = name, &bytes = content] { read_mesh(file, bytes); },
                       "store.json: fixtures[0].file: ");
  const TempFolder folder;
  expect_input_error([&] { scene_of(mesh_store("none.obj"), folder.path()); }, "none.obj' ");
}

}  // namespace
}  // namespace shelfbeam::test
