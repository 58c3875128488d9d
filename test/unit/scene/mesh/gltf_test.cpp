#include "support/testing.hpp"
#include "unit/scene/mesh/gltf_maker.hpp"
#include "unit/scene/solids.hpp"

// The tetrahedron has the volume 1 and the corners (1, 0, 0), (0, 2, 0) and (0, 0, 3) of glTF, in which y is
// up. Tolerances are far above the rounding of single precision and far below the effect of each feature.

namespace shelfbeam::test {
namespace {

constexpr double rounding = 1e-5;

void expect_bounds(const Scene& scene, const Vec3& low, const Vec3& high) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(scene.lower[axis], low[axis], rounding) << axis;
    EXPECT_NEAR(scene.upper[axis], high[axis], rounding) << axis;
  }
}

std::vector<float> repeated(const std::vector<float>& values, std::size_t times) {
  std::vector<float> result;
  for (std::size_t k = 0; k < times; ++k) result.insert(result.end(), values.begin(), values.end());
  return result;
}

const std::vector<float> identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

TEST(Gltf, MirroredNodesKeepTheirOutside) {
  const auto mirrored = [](const Json& parent, const Json& child) {
    GltfMaker maker;
    maker.file["nodes"] = {parent, child};
    maker.node(0)["children"] = {1};
    maker.node(1)["mesh"] = 0;
    return volume(maker.scene().mesh);
  };
  EXPECT_NEAR(mirrored({{"scale", {-1, 1, 1}}}, Json::object()), 1, rounding);
  EXPECT_NEAR(mirrored({{"scale", {-1, 1, 1}}}, {{"scale", {1, -2, 1}}}), 2, rounding)
      << "twice is no mirror";
  EXPECT_NEAR(mirrored({{"scale", {-1, -1, -1}}}, {{"rotation", {0.5, 0.5, 0.5, 0.5}}}), 1, rounding);
  const Json shear{1, 0, 0, 0, 0.5, -1, 0, 0, 0, 0.25, 1, 0, 4, 5, 6, 1};
  EXPECT_NEAR(mirrored({{"matrix", shear}}, Json::object()), 1, rounding);
}

TEST(Gltf, LastRowOfAMatrixIsThatOfAnAffineMap) {
  GltfMaker maker;
  maker.node(0)["matrix"] = {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  expect_input_error([&] { maker.scene(); }, "nodes[0].matrix", "last row");
}

TEST(Gltf, QuaternionsAreNormalized) {
  GltfMaker maker;
  maker.node(0)["rotation"] = {0, 0, 2, 2};  // a quarter turn about z
  expect_bounds(maker.scene(), {-2, -3, 0}, {0, 0, 1});
  for (const double scale : {1e200, 1e-170}) {  // whose squares overflow or vanish
    maker.node(0)["rotation"] = {0, 0, scale, scale};
    expect_bounds(maker.scene(), {-2, -3, 0}, {0, 0, 1});
  }
  maker.node(0)["rotation"] = {0, 0, 0, 0};
  expect_input_error([&] { maker.scene(); }, "nodes[0].rotation", "zero quaternion");
}

// Joint 1 doubles, joint 2 shifts by 10 along x; the last three corners, a triangle, belong half to each.
GltfMaker skinned() {
  GltfMaker maker;
  maker.file["scenes"][0]["nodes"] = {0, 1, 2};
  maker.file["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"scale", {7, 7, 7}}},
                         {{"scale", {2, 2, 2}}},
                         {{"translation", {10, 0, 0}}}};
  std::vector<std::uint8_t> joints;
  for (int k = 0; k < 12; ++k) joints.insert(joints.end(), {0, 1, 0, 0});
  std::vector<float> weights = repeated({1, 0, 0, 0}, 9);
  const std::vector<float> shared = repeated({0.5, 0.5, 0, 0}, 3);
  weights.insert(weights.end(), shared.begin(), shared.end());
  maker.primitive()["attributes"]["JOINTS_0"] = maker.add("VEC4", 4, joints);
  maker.primitive()["attributes"]["WEIGHTS_0"] = maker.add("VEC4", 4, weights);
  maker.file["skins"] = {{{"joints", {1, 2}}}};
  return maker;
}

TEST(Gltf, SkinsMoveTheirVertices) {
  GltfMaker maker = skinned();
  // The node itself does not move the mesh. Corner (1, 0, 0) of the last triangle: (2 + 11) / 2.
  const Scene scene = maker.scene();
  expect_bounds(scene, {0, -6, 0}, {6.5, 0, 4});
  // The inverse of joint 1 before its scale, and a shift before that of joint 2.
  std::vector<float> inverses = identity;
  inverses[0] = inverses[5] = inverses[10] = 0.5;
  inverses.insert(inverses.end(), identity.begin(), identity.end());
  inverses[16 + 12] = -10;
  maker.file["skins"][0]["inverseBindMatrices"] = maker.add("MAT4", 16, inverses);
  expect_bounds(maker.scene(), {0, -3, 0}, {1, 0, 2});
  EXPECT_NEAR(volume(maker.scene().mesh), 1, rounding);
}

TEST(Gltf, SkinsAreChecked) {
  const auto refused = [](const auto& change, const char* place, const char* message) {
    GltfMaker maker = skinned();
    change(maker);
    expect_input_error([&] { maker.scene(); }, "store.json: fixtures[0].file: ", place, message);
  };
  refused([](GltfMaker& m) { m.file["skins"][0]["joints"] = {1}; }, "JOINTS_0", "joint 1 of 1");
  refused([](GltfMaker& m) { m.file["scenes"][0]["nodes"] = {0, 1}; }, "joints[1]", "outside the scene");
  refused([](GltfMaker& m) { m.primitive()["attributes"].erase("JOINTS_0"); }, "JOINTS_0", "missing");
  refused([](GltfMaker& m) { m.primitive()["attributes"].erase("WEIGHTS_0"); }, "WEIGHTS_0", "missing");
  refused([](GltfMaker& m) { m.file["skins"][0]["inverseBindMatrices"] = m.add("MAT4", 16, identity); },
          "inverseBindMatrices", "fewer");
  refused(
      [](GltfMaker& m) {
        m.primitive()["attributes"]["WEIGHTS_0"] = m.add("VEC4", 4, repeated({0, 0, 0, 0}, 12));
      },
      "WEIGHTS_0", "no weight at vertex 0");
}

// A target that moves all vertices by (0, 0, 1), with weights at the mesh and at the node.
TEST(Gltf, MorphTargetsMoveVertices) {
  GltfMaker maker;
  maker.primitive()["targets"] = {{{"POSITION", maker.add("VEC3", 3, repeated({0, 0, 1}, 12))}},
                                  {{"NORMAL", 0}},
                                  {{"POSITION", maker.add("VEC3", 3, repeated({5, 0, 0}, 12))}}};
  expect_bounds(maker.scene(), {0, -3, 0}, {1, 0, 2});
  maker.file["meshes"][0]["weights"] = {2, 1, 0};
  expect_bounds(maker.scene(), {0, -5, 0}, {1, -2, 2});
  maker.node(0)["weights"] = {0.5, 0, 0.2};
  expect_bounds(maker.scene(), {1, -3.5, 0}, {2, -0.5, 2});
  maker.node(0)["weights"] = {1};
  expect_input_error([&] { maker.scene(); }, "targets", "3 morph targets for 1 weights");
}

// Morph targets are often sparse: only vertex 3, the corner (0, 0, 0) of the second triangle, moves.
TEST(Gltf, AccessorsMayBeSparse) {
  GltfMaker maker;
  const std::size_t index = maker.view(std::vector<std::uint8_t>{3}),
                    value = maker.view(std::vector<float>{0, -4, 0});
  maker.file["accessors"].push_back({{"componentType", 5126},
                                     {"count", 12},
                                     {"type", "VEC3"},
                                     {"sparse",
                                      {{"count", 1},
                                       {"indices", {{"bufferView", index}, {"componentType", 5121}}},
                                       {"values", {{"bufferView", value}}}}}});
  Json& sparse = maker.file["accessors"].back();
  maker.primitive()["targets"] = {{{"POSITION", maker.file["accessors"].size() - 1}}};
  maker.node(0)["weights"] = {1};
  expect_bounds(maker.scene(), {0, -3, -4}, {1, 0, 2});
  sparse["bufferView"] = 0;  // the positions themselves, so that all are doubled
  expect_bounds(maker.scene(), {0, -6, -4}, {2, 0, 4});
  sparse["count"] = 3;
  expect_input_error([&] { maker.scene(); }, "element 3 of 3");
  sparse["count"] = 1e14;
  sparse.erase("bufferView");
  expect_input_error([&] { maker.scene(); }, "accessors[1]", "memory");
}

TEST(Gltf, InstancesAreCopies) {
  GltfMaker maker;
  maker.node(0)["scale"] = {1, 1, 2};
  Json& attributes = maker.extension(0, "EXT_mesh_gpu_instancing")["attributes"];
  attributes["TRANSLATION"] = maker.add("VEC3", 3, std::vector<float>{0, 0, 0, 5, 0, 1});
  EXPECT_EQ(maker.scene().mesh.triangles.size(), 8u);
  expect_bounds(maker.scene(), {0, -8, 0}, {6, 0, 2});
  attributes["SCALE"] = maker.add("VEC3", 3, std::vector<float>{1, 1, 1, -2, 1, 1});
  EXPECT_NEAR(volume(maker.scene().mesh), 2 + 4, rounding) << "the mirrored copy faces outwards, too";
  // 90 degrees about x in bytes, whose length is not quite 1.
  attributes["ROTATION"] = maker.add("VEC4", 4, std::vector<std::int8_t>{0, 0, 0, 127, 90, 0, 0, 90}, true);
  expect_bounds(maker.scene(), {0, -6, -3}, {5, 0, 2});
  attributes["ROTATION"] = maker.add("VEC4", 4, std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 0, 0}, true);
  expect_input_error([&] { maker.scene(); }, "EXT_mesh_gpu_instancing", "zero quaternion");
  attributes["SCALE"] = maker.add("VEC3", 3, std::vector<float>{1, 1, 1});
  expect_input_error([&] { maker.scene(); }, "different numbers");
  maker = skinned();
  maker.extension(0, "EXT_mesh_gpu_instancing")["attributes"] = Json::object();
  expect_input_error([&] { maker.scene(); }, "EXT_mesh_gpu_instancing", "skin");
}

TEST(Gltf, HiddenNodesHideTheirChildren) {
  GltfMaker maker;
  maker.file["nodes"] = {{{"mesh", 0}, {"children", {1}}}, {{"children", {2}}}, {{"mesh", 0}}};
  EXPECT_EQ(maker.scene().mesh.triangles.size(), 8u);
  maker.extension(1, "KHR_node_visibility")["visible"] = true;
  EXPECT_EQ(maker.scene().mesh.triangles.size(), 8u);
  maker.extension(1, "KHR_node_visibility")["visible"] = false;
  maker.extension(2, "KHR_node_visibility")["visible"] = true;
  EXPECT_EQ(maker.scene().mesh.triangles.size(), 4u);
  maker.extension(0, "KHR_node_visibility")["visible"] = false;
  expect_input_error([&] { maker.scene(); }, "no triangles");
}

TEST(Gltf, ExtensionsAreAppliedHarmlessOrRefused) {
  const auto with = [](const char* list, const std::string& name) {
    GltfMaker maker;
    maker.file[list] = {name};
    return [text = maker.text()] { return file_warnings(read_mesh("a.gltf", text)); };
  };
  for (const char* known :
       {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_node_visibility", "KHR_materials_unlit",
        "KHR_texture_transform", "KHR_lights_punctual", "EXT_texture_webp", "MSFT_lod", "KHR_xmp_json_ld",
        "KHR_interactivity", "FB_ngon_encoding"})
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
      EXPECT_TRUE(with(list, known)().empty()) << known;
  for (const char* changing : {"CESIUM_RTC", "AGI_articulations", "KHR_gaussian_splatting", "KHR_billboard",
                               "BENTLEY_primitive_restart"})
    expect_input_error(with("extensionsUsed", changing), "extensionsUsed[0]", "uses the unsupported '",
                       changing);
  for (const char* compression :
       {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    EXPECT_TRUE(with("extensionsUsed", compression)().empty()) << "the data are there without it, too";
    expect_input_error(with("extensionsRequired", compression), "requires the unsupported '", compression);
  }
  expect_input_error(with("extensionsRequired", "ACME_twist"), "requires the unsupported 'ACME_twist'");
  const auto warnings = with("extensionsUsed", "ACME_twist")();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "store.json: fixtures[0]: the mesh 'a.gltf' uses the unknown extension 'ACME_twist', which was "
            "ignored");
}

// Some programs forget to declare the extensions of an object.
TEST(Gltf, ExtensionsNeedNoDeclaration) {
  for (const char* place : {"/nodes/0", "/meshes/0", "/meshes/0/primitives/0", "/scenes/0"}) {
    GltfMaker maker;
    Json& object = maker.file[Json::json_pointer(place)];
    object["extensions"]["AGI_articulations"] = Json::object();
    expect_input_error([&] { maker.scene(); }, "uses the unsupported 'AGI_articulations'");
    object["extensions"] = {{"ACME_twist", Json::object()}};
    EXPECT_EQ(file_warnings(maker.scene()).size(), 1u) << place;
  }
}

TEST(Gltf, CompressedDataNeedAnotherForm) {
  GltfMaker maker;
  maker.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
  EXPECT_NO_THROW(maker.scene());
  maker.file["accessors"][0].erase("bufferView");
  expect_input_error([&] { maker.scene(); }, "KHR_draco_mesh_compression", "only form");
}

TEST(Gltf, TrianglesHaveThreeCorners) {
  GltfMaker maker;
  maker.primitive()["indices"] = maker.add("SCALAR", 1, std::vector<std::uint8_t>{0, 1, 2, 3});
  expect_input_error([&] { maker.scene(); }, "primitives[0]", "has 4 corners");
}

// At 5,000 km, single precision has steps of 0.5 m, which doubles of a node do not have.
TEST(Gltf, SinglePrecisionFarFromTheOriginIsReported) {
  const auto warnings = [](GltfMaker& maker) {
    const TempFolder folder;
    folder.write("a.gltf", maker.text());
    Json store = mesh_store("a.gltf");
    store["fixtures"][0]["at"] = {-5e6, 0, 0};
    return file_warnings(scene_of(store, folder.path()));
  };
  GltfMaker node;
  node.node(0)["translation"] = {5e6, 0, 0};
  EXPECT_TRUE(warnings(node).empty());
  GltfMaker vertices;
  std::vector<float> far;
  for (const auto& triangle : tetrahedron())
    for (const auto& [x, y, z] : triangle) far.insert(far.end(), {5e6F + x, y, z});
  vertices.primitive()["attributes"]["POSITION"] = vertices.add("VEC3", 3, far);
  ASSERT_EQ(warnings(vertices).size(), 1u);
  EXPECT_NE(warnings(vertices)[0].find("single precision, which rounds them by up to 0.3"), std::string::npos)
      << warnings(vertices)[0];
}

}  // namespace
}  // namespace shelfbeam::test
