#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/expect_input_error.hpp"
#include "unit/scene/shelving.hpp"
#include "unit/scene/solids.hpp"

// Lengths to 1e-9 m, as in gondola_test.cpp.

namespace shelfbeam {
namespace {

using test::freezer_store;
using test::gondola_store;
using test::in_fixture;
using test::Json;
using test::scene_of;
using test::solids_of;

constexpr double exact = 1e-9;

Json with_doors(Json store) {
  store["materials"]["glass"] = {{"type", "lambertian"}, {"reflectance", 0.1}};
  store["fixtures"][0]["doors"] = "glass";
  return store;
}

struct Bounds {
  Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
};
Bounds bounds(const test::Solid& solid, const Scene& scene, double rotation) {
  Bounds b;
  for (const auto& triangle : solid.triangles)
    for (const auto v : triangle) {
      const Vec3 p = in_fixture(scene.mesh.vertices[v], rotation);
      b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y), std::min(b.low.z, p.z)};
      b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y), std::max(b.high.z, p.z)};
    }
  return b;
}

void expect_bounds(const Bounds& b, const Vec3& low, const Vec3& high) {
  EXPECT_LT(length(b.low - low), exact) << b.low.x << ' ' << b.low.y << ' ' << b.low.z;
  EXPECT_LT(length(b.high - high), exact) << b.high.x << ' ' << b.high.y << ' ' << b.high.z;
}

TEST(Doors, OfAGondolaStandFiveCentimetresBeforeItsBoards) {
  for (const double rotation : {0.0, 90.0, 33.3}) {
    Json store = with_doors(gondola_store());
    store["fixtures"][0]["rotation_deg"] = rotation;
    const Scene scene = scene_of(store);
    const auto doors = solids_of(scene, PartKind::door);
    ASSERT_EQ(doors.size(), 2u);
    expect_bounds(bounds(doors[0], scene, rotation), {0, -0.05, 0.12}, {3.2, -0.05, 1.78});
    expect_bounds(bounds(doors[1], scene, rotation), {0, 0.95, 0.12}, {3.2, 0.95, 1.78});
    for (const test::Solid& door : doors) {
      EXPECT_EQ(scene.materials[door.part.material.value].name, "glass");
      EXPECT_NEAR(test::area(door, scene.mesh), 3.2 * 1.66, exact);
    }
    std::size_t glass = 0;
    for (const MaterialId id : scene.mesh.materials)
      glass += scene.materials[id.value].name == "glass" ? 1 : 0;
    EXPECT_EQ(glass, 4u);
    for (const test::Solid& solid : solids_of(scene)) {
      if (solid.part.kind == PartKind::door) continue;
      EXPECT_TRUE(test::is_closed(solid));
      EXPECT_GT(test::volume(solid, scene.mesh), 0);
      EXPECT_LE(solid.part.top, 1.8);
    }
    // Walls of 2 cm and doors with 1 cm of frame around 3.2 x 0.9 m.
    EXPECT_NEAR(test::signed_area(scene.fixtures[0].footprint), 3.24 * 1.02, exact);
    EXPECT_EQ(scene.fixtures[0].height, 1.8);
  }
}

TEST(Doors, StandWhereBoardsAre) {
  for (const auto& [face, door, outline] :
       {std::tuple{"front", -0.05, std::pair{-0.06, 0.9}}, {"back", 0.95, std::pair{0.0, 0.96}}}) {
    Json store = with_doors(gondola_store());
    store["fixtures"][0]["faces"] = {face};
    const Scene scene = scene_of(store);
    const auto doors = solids_of(scene, PartKind::door);
    ASSERT_EQ(doors.size(), 1u);
    EXPECT_NEAR(bounds(doors[0], scene, 0).low.y, door, exact);
    EXPECT_NEAR(scene.fixtures[0].footprint[0][1] - 1, outline.first, exact);
    EXPECT_NEAR(scene.fixtures[0].footprint[2][1] - 1, outline.second, exact);
  }
}

TEST(Doors, LeaveBoardsGoodsAndLabelsAsTheyWere) {
  for (const Json& open : {gondola_store(), freezer_store()}) {
    const Scene before = scene_of(open), after = scene_of(with_doors(open));
    const auto unchanged = [](const Scene& scene) {
      std::vector<std::vector<double>> parts;
      for (const Part& part : scene.parts) {
        if (part.kind == PartKind::casing || part.kind == PartKind::door || part.kind == PartKind::kick_plate)
          continue;
        parts.push_back({static_cast<double>(part.kind), part.bottom, part.top});
        for (const auto& [x, y] : part.footprint) parts.back().insert(parts.back().end(), {x, y});
      }
      return parts;
    };
    EXPECT_GT(unchanged(before).size(), 10u);
    EXPECT_EQ(unchanged(after), unchanged(before));
    ASSERT_EQ(after.labels.size(), before.labels.size());
    for (std::size_t i = 0; i < before.labels.size(); ++i)
      EXPECT_EQ(after.labels[i].position, before.labels[i].position);
  }
}

TEST(Doors, OfAFreezerAreItsLid) {
  const Scene scene = scene_of(with_doors(freezer_store()));
  const auto doors = solids_of(scene, PartKind::door);
  ASSERT_EQ(doors.size(), 1u);
  expect_bounds(bounds(doors[0], scene, 0), {0.06, 0.06, 0.9}, {1.94, 0.74, 0.9});
  EXPECT_NEAR(test::area(doors[0], scene.mesh), 1.88 * 0.68, exact);
  EXPECT_NEAR(test::signed_area(scene.fixtures[0].footprint), 2 * 0.8, exact);
}

// Whether a ray meets any triangle of these parts.
bool is_stopped(const std::vector<test::Solid>& solids, const Scene& scene, const Vec3& from,
                const Vec3& way) {
  for (const test::Solid& solid : solids)
    for (const auto& [a, b, c] : solid.triangles) {
      const Vec3 &p = scene.mesh.vertices[a], u = scene.mesh.vertices[b] - p, v = scene.mesh.vertices[c] - p;
      const Vec3 q = cross(way, v), s = from - p, r = cross(s, u);
      const double det = dot(u, q);
      if (det == 0) continue;
      const double x = dot(s, q) / det, y = dot(way, r) / det;
      if (x >= 0 && y >= 0 && x + y <= 1 && dot(v, r) / det > 0) return true;
    }
  return false;
}

// How many of 4000 rays from behind the doors leave.
int escapes(const std::vector<test::Solid>& solids, const Scene& scene, const std::vector<Vec3>& from) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  int count = 0;
  for (int k = 0; k < 4000; ++k) {
    const Vec3 way{normal(random), normal(random), normal(random)};
    count += is_stopped(solids, scene, from[static_cast<std::size_t>(k) % from.size()], way) ? 0 : 1;
  }
  return count;
}

// No tolerance: without a gap no ray can leave. Without any one kind of part some do.
TEST(Doors, AreTheOnlyWayIn) {
  Json turned = with_doors(gondola_store()), one_face = turned, low = turned;
  turned["fixtures"][0]["rotation_deg"] = 33.3;
  one_face["fixtures"][0]["faces"] = {"back"};
  low["fixtures"][0]["shelves"] = {0.05, 0.1};
  for (const Json& store :
       {with_doors(gondola_store()), turned, one_face, low, with_doors(freezer_store())}) {
    const Scene scene = scene_of(store);
    const bool is_freezer = scene.fixtures[0].type == "freezer";
    const double rotation = scene.fixtures[0].rotation_deg;
    const double turn = rotation * std::acos(-1.0) / 180, c = std::cos(turn), s = std::sin(turn);
    std::vector<Vec3> from;
    for (const double x : {0.1, 0.7, 1.85})
      for (const double z : is_freezer ? std::vector{0.89} : std::vector{0.2, 0.7, 1.77}) {
        const double y = is_freezer ? 0.3 : 0.93;
        from.push_back({2 + c * x - s * y, 1 + s * x + c * y, z});
      }
    std::vector<test::Solid> solids = solids_of(scene);
    std::erase_if(solids, [](const test::Solid& solid) {
      return solid.part.kind == PartKind::goods || solid.part.kind == PartKind::board;
    });
    EXPECT_EQ(escapes(solids, scene, from), 0);
    for (const PartKind kind : is_freezer ? std::vector{PartKind::door, PartKind::tub}
                                          : std::vector{PartKind::door, PartKind::casing}) {
      std::vector<test::Solid> fewer = solids;
      std::erase_if(fewer, [&](const test::Solid& solid) { return solid.part.kind == kind; });
      EXPECT_GT(escapes(fewer, scene, from), 0) << static_cast<int>(kind);
    }
  }
}

TEST(Doors, GiveNoWarnings) {
  for (const Json& open : {gondola_store(), freezer_store()}) {
    Json store = with_doors(open);
    store["room"] = Json::parse(R"({"size": [8, 6, 4], "floor": "m", "ceiling": "m", "walls": "m"})");
    store["labels"][0]["position"] = {1, 1, 1};
    store["transceivers"]["list"][0]["position"] = {1, 1, 3};
    EXPECT_TRUE(scene_of(store).warnings.empty());
  }
}

TEST(Doors, OfASolidDielectricAreRefused) {
  for (const Json& open : {gondola_store(), freezer_store()}) {
    Store store = test::read_text(with_doors(open).dump());
    store.materials[1].material = make_dielectric(1.5);
    test::expect_input_error([&] { make_scene(store); },
                             "store.json: fixtures[0].doors: 'glass' is a solid 'dielectric'",
                             "thin_dielectric");
    store.materials[1].material = make_thin_dielectric(1.5, 0.006, 0);
    EXPECT_NO_THROW(make_scene(store));
  }
}

}  // namespace
}  // namespace shelfbeam
