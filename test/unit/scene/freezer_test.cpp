#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "unit/scene/shelving.hpp"
#include "unit/scene/solids.hpp"

// Lengths to 1e-9 m, as in gondola_test.cpp.

namespace shelfbeam {
namespace {

using test::freezer_store;
using test::Json;
using test::scene_of;
using test::solids_of;

constexpr double exact = 1e-9;

TEST(Freezer, LabelsStandBelowTheRimOfEveryFace) {
  for (const double rotation : {0.0, 90.0, 33.3}) {
    Json store = freezer_store();
    store["fixtures"][0]["rotation_deg"] = rotation;
    store["fixtures"][0]["labels"]["faces"] = {"front", "back", "left", "right"};
    const Scene scene = scene_of(store);
    // Five labels on 2 m, two on 0.8 m.
    ASSERT_EQ(scene.labels.size(), 2u * 5 + 2 * 2 + 1);
    for (const Label& label : scene.labels) {
      if (label.id == "far") continue;
      const Vec3 p = test::in_fixture(label.position, rotation);
      const Vec3 n = test::in_fixture(label.position + label.normal, rotation) - p;
      EXPECT_NEAR(p.z, 0.85, exact);
      const bool along_x = label.id.starts_with("F-front") || label.id.starts_with("F-back");
      const double across = along_x ? p.y : p.x, depth = along_x ? 0.8 : 2;
      const bool low = label.id.starts_with("F-front") || label.id.starts_with("F-left");
      EXPECT_NEAR(across, low ? -0.01 : depth + 0.01, exact) << label.id;
      EXPECT_LT(length(n - (along_x ? Vec3{0, low ? -1.0 : 1.0, 0} : Vec3{low ? -1.0 : 1.0, 0, 0})), exact);
    }
  }
}

TEST(Freezer, IsAnOpenTub) {
  Json store = freezer_store();
  store["fixtures"][0]["stocking"] = 0;
  const Scene scene = scene_of(store);
  // Walls and floor of 6 cm above a kick plate of 12 cm that is set back by 4 cm; nothing overlaps.
  const double outer = 2 * 0.8 * 0.78, hollow = 1.88 * 0.68 * (0.78 - 0.06), kick = 1.92 * 0.72 * 0.12;
  double sum = 0;
  for (const test::Solid& solid : solids_of(scene)) {
    EXPECT_TRUE(test::is_closed(solid));
    sum += test::volume(solid, scene.mesh);
  }
  EXPECT_NEAR(sum, outer - hollow + kick, exact);
  EXPECT_GT(std::abs(sum - (outer + kick)), 0.5) << "a closed chest must show";
  EXPECT_EQ(scene.upper.z, 0.9);
}

TEST(Freezer, GoodsLieInTheTub) {
  Json store = freezer_store();
  store["fixtures"][0]["stocking"] = 1;
  const Scene scene = scene_of(store);
  const auto goods = solids_of(scene, PartKind::goods);
  EXPECT_EQ(goods.size(), 2u * 6);  // two rows of 1.88 m
  for (const test::Solid& block : goods) {
    EXPECT_NEAR(block.part.bottom, 0.18, exact);
    EXPECT_NEAR(block.part.top, 0.18 + 0.9 * 0.72, exact);
    for (const auto& [x, y] : block.part.footprint) {
      EXPECT_TRUE(x > 2.06 && x < 3.94) << x;
      EXPECT_TRUE(y > 1.06 && y < 1.74) << y;
    }
  }
}

TEST(Freezer, OfLeastSizeHasNoPartTurnedInsideOut) {
  Json store = freezer_store();
  store["fixtures"][0].update(Json{{"length", 0.3}, {"depth", 0.3}, {"height", 0.3}, {"stocking", 1}});
  const Scene scene = scene_of(store);
  for (const test::Solid& solid : solids_of(scene)) EXPECT_GT(test::volume(solid, scene.mesh), 0);
}

TEST(Box, IsWhereItsCornersAre) {
  Json store = freezer_store();
  store["fixtures"][0] = Json::parse(
      R"({ "type": "box", "id": "C", "min": [1, -2, 0.5], "max": [1.5, 2, 3], "material": "m" })");
  const Scene scene = scene_of(store);
  EXPECT_EQ(scene.lower, (Vec3{1, -2, 0.5}));
  EXPECT_EQ(scene.upper, (Vec3{1.5, 2, 3}));
  const auto solids = solids_of(scene, PartKind::solid);
  ASSERT_EQ(solids.size(), 1u);
  EXPECT_TRUE(test::is_closed(solids[0]));
  EXPECT_NEAR(test::volume(solids[0], scene.mesh), 0.5 * 4 * 2.5, exact);
  EXPECT_NEAR(test::area(solids[0], scene.mesh), 2 * (0.5 * 4 + 4 * 2.5 + 2.5 * 0.5), exact);
  EXPECT_EQ(scene.fixtures[0].height, 3);
}

TEST(Room, IsAClosedShell) {
  const Scene scene = scene_of(test::sample_store());
  test::Solid shell;
  shell.triangles.assign(scene.mesh.triangles.begin(), scene.mesh.triangles.begin() + 12);
  EXPECT_NEAR(test::area(shell, scene.mesh), 2 * (8 * 6 + 6 * 3 + 3 * 8), exact);
  // Each edge of the triangles belongs to two of them, whichever way they run.
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : shell.triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
  for (const auto& edge : edges) EXPECT_EQ(edges.count(edge), 2u);
  // Walls x0, x1, y0, y1, floor, ceiling; two triangles each.
  const std::vector<std::string> expected = {"white", "white", "white", "tile", "tile", "white"};
  for (std::size_t t = 0; t < 12; ++t) {
    EXPECT_EQ(scene.materials[scene.mesh.materials[t].value].name, expected[t / 2]);
    const int axis = static_cast<int>(t / 4);
    const double at = (t / 2) % 2 == 0 ? 0 : (*scene.room)[axis];
    for (const auto v : scene.mesh.triangles[t]) EXPECT_EQ(scene.mesh.vertices[v][axis], at);
  }
}

}  // namespace
}  // namespace shelfbeam
