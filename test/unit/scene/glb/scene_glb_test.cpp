#include "shelfbeam/scene/glb/scene_glb.hpp"

#include "support/testing.hpp"
#include "unit/scene/glb/glb_reader.hpp"
#include "unit/scene/mesh_files.hpp"
#include "unit/scene/shelving.hpp"

// Positions are 32-bit numbers. Those of the sample are below 8 m, so they are exact to 5e-7 m. The tolerance
// is that of 32-bit vertices that were also turned by a quaternion.

namespace shelfbeam::test {
namespace {

constexpr double single = 2e-5;

// The sample with a unit that is tilted and installed (T1), and a tilted label with a size.
Json store() {
  Json store = sample_store();
  store["labels"].push_back({{"id", "L2"}, {"position", {5, 3, 1}}, {"normal", {1, 0, 1}}, {"type", "deep"}});
  return store;
}

std::set<std::string> names(const std::map<std::string, GlbNode>& nodes) {
  std::set<std::string> names;
  for (const auto& [name, node] : nodes) names.insert(name);
  return names;
}

Vec3 centre(const std::array<Vec3, 3>& triangle) {
  return (triangle[0] + triangle[1] + triangle[2]) / 3;
}

// Twice the area, along the normal.
Vec3 normal(const std::array<Vec3, 3>& triangle) {
  return cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
}

double area(const GlbNode& node) {
  double sum = 0;
  for (const auto& triangle : node) sum += length(normal(triangle)) / 2;
  return sum;
}

double octahedron_area() {
  const auto pyramid = [](double height) {
    return 4 * 0.05 * std::sqrt(2) * std::hypot(height, 0.05 / std::sqrt(2)) / 2;
  };
  return pyramid(0.12) + pyramid(0.02);
}

TEST(SceneGlb, IsAValidFile) {
  const Scene scene = scene_of(store());
  const std::string bytes = scene_glb(scene);
  EXPECT_EQ(problem_of(bytes), "");
  EXPECT_TRUE(bytes == scene_glb(scene));
  const Json json = read_glb(bytes).json;
  EXPECT_EQ(json["asset"], R"({"version": "2.0", "generator": "shelfbeam"})"_json);
  EXPECT_EQ(json["nodes"][0]["name"], "Sample");
}

// The check above must find errors.
TEST(SceneGlb, CheckRejectsWrongFiles) {
  const std::string bytes = scene_glb(scene_of(store()));
  EXPECT_EQ(problem_of(bytes.substr(0, bytes.size() - 4)), "length");
  const auto positions = bytes.size() - read_glb(bytes).binary.size();
  const auto changed = [&](std::size_t at, const auto& value) {
    return problem_of(std::string(bytes).replace(at, 4, bytes_of(value)));
  };
  EXPECT_EQ(changed(positions, 1000.0F), "bounds");
  EXPECT_EQ(changed(bytes.size() - 4, std::uint32_t{1'000'000}), "index");
  EXPECT_EQ(changed(4, std::uint32_t{1}), "header");
}

TEST(SceneGlb, HasTheTrianglesOfTheScene) {
  const Scene scene = scene_of(store());
  Json materials;
  for (const NamedMaterial& material : scene.materials) materials[material.name] = material.name;
  materials["label"] = "carton";
  materials["candidate"] = "chrome";
  materials["installed"] = "foil";
  auto expected = areas_of(scene);
  for (const char* unused : {"carton", "chrome", "foil"}) ASSERT_EQ(expected.count(unused), 0u);
  const std::size_t points = scene.labels.size() - 1, candidates = scene.transceivers.size() - 1;
  expected["carton"] = 0.0015 * static_cast<double>(points) + 0.02;
  expected["chrome"] = octahedron_area() * static_cast<double>(candidates);
  expected["foil"] = octahedron_area();

  const Scene read = read_mesh("store.glb", scene_glb(scene), materials);
  EXPECT_EQ(read.mesh.triangles.size(),
            scene.mesh.triangles.size() + 2 * scene.labels.size() + 8 * scene.transceivers.size());
  EXPECT_LT(length(read.lower - scene.lower), single);
  EXPECT_LT(length(read.upper - scene.upper), single);
  const auto found = areas_of(read);
  EXPECT_EQ(found.size(), expected.size());
  for (const auto& [material, area] : expected) EXPECT_NEAR(found.at(material), area, 1e-4) << material;
}

// y is up in the file: without the rotation of the root node, the shop would lie on its side.
TEST(SceneGlb, HasYUp) {
  const Scene scene = scene_of(store());
  const TempFolder folder;
  folder.write("store.glb", scene_glb(scene));
  Json as_it_is = mesh_store("store.glb");
  as_it_is["fixtures"][0]["up"] = "z";
  const Vec3 size = scene.upper - scene.lower;
  const Scene read = scene_of(as_it_is, folder.path());
  EXPECT_LT(length(read.lower - Vec3{0, 0, -size.y}), single);
  EXPECT_LT(length(read.upper - Vec3{size.x, size.z, 0}), single);
}

TEST(SceneGlb, HasOpeningsInTheRoom) {
  const auto room_area = [](const char* openings) {
    Json with = store();
    with["room"]["openings"] = Json::parse(openings);
    return area(nodes_of(scene_glb(scene_of(with))).at("room"));
  };
  const double closed = room_area("[]");
  EXPECT_NEAR(room_area(R"([{"wall": 0, "at": 1, "width": 1.5, "top": 2}])"), closed - 3, 1e-4) << "a hole";
  EXPECT_NEAR(room_area(R"([{"wall": 0, "at": 1, "width": 1.5, "top": 2, "material": "door"}])"), closed,
              1e-4);
}

TEST(SceneGlb, HasANodePerFixture) {
  const Scene scene = scene_of(store());
  const auto nodes = nodes_of(scene_glb(scene));
  EXPECT_EQ(names(nodes), (std::set<std::string>{"A", "C", "F", "M", "candidates", "ceiling", "installed",
                                                 "labels", "room"}));
  EXPECT_NEAR(area(nodes.at("C")), 2 * 0.25 + 4 * 0.5 * 3, 1e-5);
  EXPECT_NEAR(area(nodes.at("M")), 0.25 * (0.5 + 0.5), 1e-5);
  std::uint32_t next = 12;  // after the room
  for (const FixtureOutline& fixture : scene.fixtures) {
    EXPECT_EQ(fixture.first_triangle, next) << fixture.id;
    EXPECT_EQ(nodes.at(fixture.id).size(), fixture.triangle_count) << fixture.id;
    next += fixture.triangle_count;
    for (const auto& triangle : nodes.at(fixture.id))
      for (const Vec3& p : triangle) EXPECT_LT(p.z, fixture.height + single) << fixture.id;
  }
  EXPECT_EQ(next, scene.mesh.triangles.size());
}

// The column C reaches the ceiling, but stays whole.
TEST(SceneGlb, HasTheCeilingApart) {
  Scene scene = scene_of(store());
  const auto nodes = nodes_of(scene_glb(scene));
  EXPECT_EQ(nodes.at("ceiling").size(), 2u);
  EXPECT_NEAR(area(nodes.at("ceiling")), 8 * 6, 1e-5);
  for (const auto& triangle : nodes.at("ceiling"))
    for (const Vec3& p : triangle) EXPECT_EQ(p.z, 3);
  EXPECT_EQ(nodes.at("room").size(), 10u);
  EXPECT_NEAR(area(nodes.at("room")), 8 * 6 + 2 * (8 + 6) * 3, 1e-5);

  scene.mesh.vertices[6].z = scene.mesh.vertices[7].z = 2;  // the side at y = 6
  const auto sloped = nodes_of(scene_glb(scene));
  EXPECT_EQ(sloped.at("room").size(), 10u);
  EXPECT_NEAR(area(sloped.at("ceiling")), 8 * std::hypot(6, 1), 1e-5);
}

TEST(SceneGlb, HasNoNodesWithoutContent) {
  const std::string bytes = scene_glb(scene_of(gondola_store()));
  EXPECT_EQ(names(nodes_of(bytes)), (std::set<std::string>{"A", "labels", "candidates"}));
  EXPECT_EQ(read_glb(bytes).json["nodes"][0]["name"], "store");
}

TEST(SceneGlb, ShowsLabelsFromTheirFront) {
  const Scene scene = scene_of(store());
  const GlbNode labels = nodes_of(scene_glb(scene)).at("labels");
  ASSERT_EQ(labels.size(), 2 * scene.labels.size());
  for (std::size_t k = 0; k < scene.labels.size(); ++k) {
    const Label& label = scene.labels[k];
    for (const auto& triangle : {labels[2 * k], labels[2 * k + 1]})
      EXPECT_GT(dot(normalized(normal(triangle)), label.normal), 0.9999) << label.id;
    const Vec3 middle = (centre(labels[2 * k]) + centre(labels[2 * k + 1])) / 2;
    EXPECT_LT(length(middle - label.position), 0.002) << label.id;
    EXPECT_GT(dot(middle - label.position, label.normal), 0) << label.id;
  }
  // 0.2 m wide, which is horizontal, and 0.1 m high.
  const auto& [low, next, high] = labels[labels.size() - 2];
  EXPECT_NEAR(length(next - low), 0.2, 1e-5);
  EXPECT_NEAR(next.z, low.z, 1e-6);
  EXPECT_NEAR(high.z - next.z, 0.1 * std::sqrt(0.5), 1e-5);
}

TEST(SceneGlb, PointsUnitsAlongTheirAxes) {
  const Scene scene = scene_of(store());
  const auto nodes = nodes_of(scene_glb(scene));
  EXPECT_EQ(nodes.at("candidates").size(), 8 * (scene.transceivers.size() - 1));
  const GlbNode& unit = nodes.at("installed");
  ASSERT_EQ(unit.size(), 8u);
  const Vec3 position{4, 3, 2.8}, axis = normalized(Vec3{0, 1, -1});
  double longest = 0;
  for (const auto& triangle : unit) {
    EXPECT_GT(dot(normal(triangle), centre(triangle) - position), 0);
    for (const Vec3& p : triangle) longest = std::max(longest, dot(p - position, axis));
  }
  EXPECT_NEAR(longest, 0.12, 1e-6);
}

TEST(SceneGlb, ShowsMaterialsByTheirReflectance) {
  const Json json = read_glb(scene_glb(scene_of(store()))).json;
  std::map<std::string, Json> materials;
  for (const Json& material : json["materials"]) {
    EXPECT_EQ(material["doubleSided"], true);
    materials[material["name"]] = material;
  }
  EXPECT_EQ(materials.size(), 9u + 3);
  const auto look = [&](const char* name) { return materials.at(name)["pbrMetallicRoughness"]; };
  EXPECT_EQ(look("tile")["baseColorFactor"], Json({0.5, 0.5, 0.5, 1.0}));
  EXPECT_EQ(look("carton")["baseColorFactor"], Json({0.6, 0.6, 0.6, 1.0}));
  EXPECT_EQ(look("tile")["metallicFactor"], 0.0);
  EXPECT_EQ(look("foil")["metallicFactor"], 0.5);
  const double eta = 1.674, k = 8.608;
  const double reflectance = (std::pow(eta - 1, 2) + k * k) / (std::pow(eta + 1, 2) + k * k);
  EXPECT_NEAR(look("foil")["baseColorFactor"][0].get<double>(), reflectance, 1e-12);
  for (const char* glass : {"door", "jar"}) {
    EXPECT_EQ(materials[glass]["alphaMode"], "BLEND") << glass;
    EXPECT_LT(look(glass)["baseColorFactor"][3].get<double>(), 0.5) << glass;
  }
  EXPECT_FALSE(materials["tile"].contains("alphaMode"));
}

// An inner wall has its own surfaces; a zone has its ceiling and the faces around it.
TEST(SceneGlb, HasInnerWallsAndZones) {
  Json with_wall = sample_store();
  with_wall["room"]["zones"] =
      R"([{"id": "low", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "height": 2.5}])"_json;
  with_wall["room"]["inner_walls"] =
      R"([{"id": "W", "from": [7, 0], "to": [7, 1], "thickness": 0.2, "height": 1}])"_json;
  const Scene scene = scene_of(with_wall);
  const std::string bytes = scene_glb(scene);
  EXPECT_EQ(problem_of(bytes), "");
  const auto nodes = nodes_of(bytes);
  EXPECT_NEAR(area(nodes.at("W")), 2 * 1 + 0.2 + 0.2, 1e-4) << "two sides, an end and the top";
  const double height = scene.upper.z;
  EXPECT_NEAR(area(nodes.at("ceiling low")), 1 + 2 * (height - 2.5), 1e-4);
}

}  // namespace
}  // namespace shelfbeam::test
