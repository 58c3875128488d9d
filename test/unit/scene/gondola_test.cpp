#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "unit/scene/shelving.hpp"
#include "unit/scene/solids.hpp"

// Lengths are compared to 1e-9 m: coordinates are of the order of 1 m and pass through a rotation and back,
// which costs a few units of 1e-16. What the check would miss if it were wrong - a label 1 cm off, a board of
// 4 cm - is ten million times larger; each test names a wrong value that it refuses.

namespace shelfbeam {
namespace {

using test::gondola_store;
using test::in_fixture;
using test::Json;
using test::scene_of;
using test::solids_of;

constexpr double exact = 1e-9;

TEST(Gondola, BoardEdgesAreAtTheHeightsGiven) {
  const Scene scene = scene_of(gondola_store());
  std::multiset<long> millimetres;
  for (const test::Solid& board : solids_of(scene, PartKind::board)) {
    EXPECT_NEAR(board.part.top - board.part.bottom, 0.04, exact);
    millimetres.insert(std::lround(500 * (board.part.top + board.part.bottom)));
    double low = 1e9, high = -1e9;
    for (const auto& [x, y] : board.part.footprint) low = std::min(low, y), high = std::max(high, y);
    const bool front = std::abs(low - 1) < exact;
    EXPECT_TRUE(front || std::abs(high - 1.9) < exact) << "a board reaches to the front or to the back";
    EXPECT_NEAR(high - low, 0.43, exact) << "half the depth without the back panel of 4 cm";
  }
  EXPECT_EQ(millimetres, (std::multiset<long>{400, 400, 1000, 1000, 1500, 1500}));
}

class TurnedGondola : public testing::TestWithParam<double> {
 protected:
  Json store() const {
    Json json = gondola_store();
    json["fixtures"][0]["rotation_deg"] = GetParam();
    return json;
  }
};
INSTANTIATE_TEST_SUITE_P(Angles, TurnedGondola, testing::Values(0, 90, 180, 270, 360, -90, 30, -77.7, 211.3));

// Where label k of a row stands in the fixture's own coordinates.
Vec3 place_of(const std::string& id, double offset) {
  const double heights[] = {0.4, 1.0, 1.5};
  const bool front = id.starts_with("A-front-");
  const std::string rest = id.substr(front ? 8 : 7);
  const auto level = static_cast<std::size_t>(std::stoi(rest)), dash = rest.find('-');
  const int k = std::stoi(rest.substr(dash + 1));
  // Six labels 0.5 m apart on 3.2 m: 2.5 m from the first to the last, 0.35 m free at both ends.
  return {0.35 + 0.5 * (k - 1), front ? -offset : 0.9 + offset, heights[level - 1]};
}

TEST_P(TurnedGondola, LabelsStandOneCentimetreOffTheEdge) {
  const Scene scene = scene_of(store());
  ASSERT_EQ(scene.labels.size(), 2u * 3 * 6 + 1);
  for (const Label& label : scene.labels) {
    if (label.id == "far") continue;
    const Vec3 p = in_fixture(label.position, GetParam());
    EXPECT_LT(length(p - place_of(label.id, 0.01)), exact) << label.id;
    EXPECT_GT(length(p - place_of(label.id, 0.011)), exact) << "a millimetre more must show";
  }
  EXPECT_EQ(scene.labels.back().id, "far") << "listed labels come after those of fixtures";
  EXPECT_EQ(scene.labels.front().id, "A-front-1-1");
}

TEST_P(TurnedGondola, LabelsLookOutwards) {
  Json tilted = store();
  tilted["fixtures"][0]["labels"]["tilt_deg"] = 25;
  const double tilt = 25 * std::acos(-1.0) / 180;
  for (const auto& [json, angle] : {std::pair{store(), 0.0}, {tilted, tilt}})
    for (const Label& label : scene_of(json).labels) {
      if (label.id == "far") continue;
      const Vec3 tip = in_fixture(label.position + label.normal, GetParam());
      const Vec3 n = tip - in_fixture(label.position, GetParam());
      const double out = label.id.starts_with("A-front-") ? -1 : 1;
      EXPECT_LT(length(n - Vec3{0, out * std::cos(angle), std::sin(angle)}), exact) << label.id;
      EXPECT_NEAR(length(label.normal), 1, 1e-12);
    }
}

TEST_P(TurnedGondola, TurnsAboutItsCorner) {
  const Scene turned = scene_of(store()), straight = scene_of(gondola_store());
  ASSERT_EQ(turned.mesh.vertices.size(), straight.mesh.vertices.size());
  for (std::size_t v = 0; v < turned.mesh.vertices.size(); ++v)
    EXPECT_LT(
        length(in_fixture(turned.mesh.vertices[v], GetParam()) - in_fixture(straight.mesh.vertices[v], 0)),
        exact);
  EXPECT_EQ(turned.mesh.triangles, straight.mesh.triangles);
  for (const Part& part : turned.parts) EXPECT_GT(test::signed_area(part.footprint), 0);
  ASSERT_EQ(turned.fixtures.size(), 1u);
  EXPECT_NEAR(test::signed_area(turned.fixtures[0].footprint), 3.2 * 0.9, exact);
  EXPECT_EQ(turned.fixtures[0].footprint[0], (std::array<double, 2>{2, 1}));
}

TEST(Gondola, RightAnglesAreWithoutRounding) {
  Json store = gondola_store();
  store["fixtures"][0]["rotation_deg"] = 90;
  const Scene scene = scene_of(store);
  for (const Label& label : scene.labels) {
    if (label.id == "far") continue;
    EXPECT_EQ(label.normal, (Vec3{label.id.starts_with("A-front-") ? 1.0 : -1.0, 0, 0}));
  }
}

TEST_P(TurnedGondola, EveryPartIsAClosedBlock) {
  const Scene scene = scene_of(store());
  std::set<PartKind> kinds;
  for (const test::Solid& solid : solids_of(scene)) {
    kinds.insert(solid.part.kind);
    const auto& corners = solid.part.footprint;
    ASSERT_EQ(corners.size(), 4u);
    const double a = std::hypot(corners[1][0] - corners[0][0], corners[1][1] - corners[0][1]);
    const double b = std::hypot(corners[2][0] - corners[1][0], corners[2][1] - corners[1][1]);
    const double h = solid.part.top - solid.part.bottom;
    EXPECT_TRUE(test::is_closed(solid));
    EXPECT_NEAR(test::volume(solid, scene.mesh), a * b * h, exact);
    EXPECT_NEAR(test::area(solid, scene.mesh), 2 * (a * b + b * h + h * a), exact);
  }
  EXPECT_EQ(kinds, (std::set{PartKind::panel, PartKind::board, PartKind::kick_plate, PartKind::goods}));
  // A block with one triangle turned round is refused, and so is one with a triangle missing.
  test::Solid block = solids_of(scene).front();
  std::swap(block.triangles[3][0], block.triangles[3][1]);
  EXPECT_FALSE(test::is_closed(block));
  block = solids_of(scene).front();
  block.triangles.pop_back();
  EXPECT_FALSE(test::is_closed(block));
}

TEST(Gondola, EmptyOneHasTheAreaOfItsBoards) {
  Json store = gondola_store();
  store["fixtures"][0]["stocking"] = 0;
  const Scene scene = scene_of(store);
  const auto block = [](double l, double d, double h) { return 2 * (l * d + d * h + h * l); };
  // Panel 4 cm; two kick plates 12 cm high, set back 4 cm behind boards of 43 cm; six boards 4 cm thick.
  const double expected = block(3.2, 0.04, 1.8) + 2 * block(3.2, 0.39, 0.12) + 6 * block(3.2, 0.43, 0.04);
  double sum = 0;
  for (const test::Solid& solid : solids_of(scene)) sum += test::area(solid, scene.mesh);
  EXPECT_NEAR(sum, expected, 1e-8);
  EXPECT_GT(std::abs(sum - expected - block(3.2, 0.43, 0.04)), 1) << "a board too many must show";
}

TEST(Gondola, WithOneFaceHasItsPanelBehind) {
  for (const auto& [face, panel_y] : {std::pair{"front", 1.86}, {"back", 1.0}}) {
    Json store = gondola_store();
    store["fixtures"][0]["faces"] = {face};
    const Scene scene = scene_of(store);
    EXPECT_EQ(solids_of(scene, PartKind::board).size(), 3u);
    const auto panels = solids_of(scene, PartKind::panel);
    ASSERT_EQ(panels.size(), 1u);
    EXPECT_NEAR(panels[0].part.footprint[0][1], panel_y, exact);
    ASSERT_EQ(scene.labels.size(), 3u * 6 + 1);
    EXPECT_TRUE(scene.labels[0].id.starts_with(std::string("A-") + face));
  }
}

TEST(Gondola, GoodsStandBetweenTheBoardsOfTheirSide) {
  Json store = gondola_store();
  store["fixtures"][0]["stocking"] = 1;
  const Scene scene = scene_of(store);
  const auto goods = solids_of(scene, PartKind::goods);
  // 3.2 m hold 11 facings of about 0.3 m, on the deck and three boards of both sides.
  EXPECT_EQ(goods.size(), 11u * 4 * 2);
  const std::map<long, double> ceiling_above = {{120, 0.38}, {420, 0.98}, {1020, 1.48}, {1520, 1.8}};
  for (const test::Solid& block : goods) {
    const auto ceiling = ceiling_above.find(std::lround(1000 * block.part.bottom));
    ASSERT_NE(ceiling, ceiling_above.end())
        << "goods stand on the deck or a board, not at " << block.part.bottom;
    EXPECT_NEAR(block.part.top, block.part.bottom + 0.9 * (ceiling->second - block.part.bottom), exact);
    for (const auto& [x, y] : block.part.footprint) {
      EXPECT_GE(x, 2);
      EXPECT_LE(x, 5.2);
      EXPECT_TRUE((y > 1.02 && y < 1.43) || (y > 1.47 && y < 1.88)) << "behind the edge, before the panel";
    }
  }
}

TEST(Gondola, OfLeastSizeHasNoPartTurnedInsideOut) {
  for (const char* faces : {R"(["front", "back"])", R"(["front"])", R"(["back"])"}) {
    Json store = gondola_store();
    store["fixtures"][0].update(
        Json{{"depth", 0.1}, {"height", 0.11}, {"length", 0.001}, {"shelves", {0.05, 0.1}}, {"stocking", 1}});
    store["fixtures"][0]["faces"] = Json::parse(faces);
    const Scene scene = scene_of(store);
    for (const test::Solid& solid : solids_of(scene))
      EXPECT_GT(test::volume(solid, scene.mesh), 0)
          << faces << ", part " << static_cast<int>(solid.part.kind);
  }
}

TEST(Gondola, LabelRowsFitTheLength) {
  for (const auto& [length, spacing, expected] :
       {std::tuple{3.2, 0.5, 6u}, {3.0, 0.5, 6u}, {2.999, 0.5, 5u}, {12.0, 0.8, 15u}, {0.3, 0.8, 1u}}) {
    Json store = gondola_store();
    store["fixtures"][0]["length"] = length;
    store["fixtures"][0]["labels"]["spacing"] = spacing;
    store["fixtures"][0]["labels"]["faces"] = {"front"};
    const Scene scene = scene_of(store);
    ASSERT_EQ(scene.labels.size(), 3 * expected + 1) << length << " m, every " << spacing << " m";
    const double first = scene.labels[0].position.x - 2, last = scene.labels[expected - 1].position.x - 2;
    EXPECT_NEAR(first, length - last, exact) << "as much free at one end as at the other";
    EXPECT_NEAR(last - first, (expected - 1) * spacing, exact);
    EXPECT_GT(first, 0);
  }
}

}  // namespace
}  // namespace shelfbeam
