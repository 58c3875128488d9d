#include "shelfbeam/transport/world/ray_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"

#include "physics/strategy_store.hpp"
#include "support/empty_room.hpp"
#include "support/small_store.hpp"

namespace shelfbeam {
namespace {

bool blocked(const RayScene& rays, const Vec3& from, const Vec3& to) {
  return rays.transmittance({from, {0, 0, 1}}, to).share == 0;
}

TEST(RayScene, FindsTheWallItLooksAt) {
  const RayScene rays(test::empty_room({6, 5, 3}));
  const auto hit = rays.intersect({{3, 2, 1}, {1, 0, 0}}, normalized({1, 0.25, -0.1}));
  ASSERT_TRUE(hit);
  // The start is moved by 16 x 2^-24 of 6 m, 6e-6 m.
  EXPECT_NEAR(hit->point.position.x, 6, 1e-12);
  EXPECT_NEAR(hit->point.position.y, 2.75, 1e-5);
  EXPECT_NEAR(hit->point.position.z, 0.7, 1e-5);
  EXPECT_NEAR(std::abs(hit->point.normal.x), 1, 1e-12);
  EXPECT_NEAR(hit->distance({3, 2, 1}, normalized({1, 0.25, -0.1})), length(Vec3{3, 0.75, -0.3}), 1e-5);
}

TEST(RayScene, LightDoesNotLeakOutOfAClosedRoom) {
  const Scene scene = test::SmallStore{}.scene();
  const RayScene rays(scene);
  for (std::uint32_t k = 0; k < 10000; ++k) {
    const auto u = philox({k, 0, 0, 0}, 1);
    const Vec3 from{6 * to_uniform(u[0]), 5 * to_uniform(u[1]), 2.5 + 0.4 * to_uniform(u[2])};
    const double z = 2 * to_uniform(u[3]) - 1, phi = k, r = std::sqrt(1 - z * z);
    const Vec3 direction{r * std::cos(phi), r * std::sin(phi), z};
    ASSERT_TRUE(rays.intersect({from, direction}, direction));
  }
}

// A point of a convex room sees every other point, at any size of the room, and for any start and end of
// rays, walls and edges included. The control is a start below the surface without offset, which must be
// blocked.
TEST(RayScene, ConvexRoomsShadowNothingAtAnyScale) {
  for (const double scale : {0.05, 1.0, 20.0, 200.0}) {
    const Scene scene = test::empty_room({scale, 0.7 * scale, 0.3 * scale});
    const RayScene rays(scene);
    int controls = 0;
    for (std::uint32_t k = 0; k < 20000; ++k) {
      const auto u = philox({k, 0, 0, 0}, 2);
      const Vec3 floor{scale * to_uniform(u[0]), 0.7 * scale * to_uniform(u[1]), 0};
      const Vec3 ceiling{scale * to_uniform(u[2]), 0.7 * scale * to_uniform(u[3]), 0.3 * scale};
      EXPECT_FALSE(blocked(rays, floor, ceiling)) << "scale " << scale;
      controls += blocked(rays, floor - Vec3{0, 0, 0.01 * scale}, ceiling) ? 1 : 0;
    }
    EXPECT_EQ(controls, 20000);
  }
}

// Walks between the walls of a convex room never leave it, and always find the opposite side.
TEST(RayScene, WalksStayInsideAtAnyScale) {
  for (const double scale : {0.05, 1.0, 200.0}) {
    const Scene scene = test::empty_room({scale, 0.7 * scale, 0.3 * scale});
    const RayScene rays(scene);
    Vec3 position{0.3 * scale, 0.2 * scale, 0}, normal{0, 0, 1};
    for (std::uint32_t k = 0; k < 20000; ++k) {
      const auto u = philox({k, 1, 0, 0}, 3);
      const Vec3 local = sample_cosine_hemisphere(to_uniform(u[0]), to_uniform(u[1]));
      const auto hit = rays.intersect({position, normal}, Frame::about(normal).to_world(local));
      ASSERT_TRUE(hit) << "scale " << scale << ", step " << k;
      ASSERT_GT(dot(normal, hit->point.position - position), 1e-9 * scale)
          << "hit the surface it left, at scale " << scale;
      position = hit->point.position;
      const Vec3 inwards = Vec3{0.5 * scale, 0.35 * scale, 0.15 * scale} - position;
      normal = dot(hit->point.normal, inwards) > 0 ? hit->point.normal : -hit->point.normal;
    }
  }
}

// The same for rotated halls, where no plane contains its corners exactly. On the floor within a tenth of a
// millimetre to a metre of the origin, coordinates are small and do not show the extent of the floor. The
// control is a start as far below the floor as rays start above it at most.
TEST(RayScene, RotatedHallsDoNotShadowThemselves) {
  for (const double size : {20.0, 200.0})
    for (const Vec3& up : {Vec3{0.37, -0.52, 0.8}, Vec3{2.37, -0.52, 0.2}, Vec3{-0.1, 0.05, 1}}) {
      const Frame frame = Frame::about(normalized(up));
      Scene scene = test::empty_room({size, 0.7 * size, 4});
      const auto place = [&](const Vec3& p) { return frame.to_world(p - Vec3{0.43 * size, 0.31 * size, 0}); };
      for (Vec3& vertex : scene.mesh.vertices) vertex = place(vertex);
      const RayScene rays(scene);
      int controls = 0;
      for (std::uint32_t k = 0; k < 20000; ++k) {
        const auto u = philox({k, 0, 0, 0}, 4), v = philox({k, 1, 0, 0}, 4);
        const double r = std::pow(10.0, -4 * to_uniform(u[2])), phi = 2 * pi * to_uniform(u[3]);
        const Vec3 near_origin = place({0.43 * size + r * std::cos(phi), 0.31 * size + r * std::sin(phi), 0});
        const Vec3 above = sample_cosine_hemisphere(to_uniform(u[0]), to_uniform(u[1]));
        const auto hit = rays.intersect({near_origin, frame.z}, frame.to_world(above));
        ASSERT_TRUE(hit);
        EXPECT_GT(dot(hit->point.position - near_origin, frame.z), 1e-9 * size);
        const double below = 1e-6 * size;
        const auto back = rays.intersect({near_origin - frame.z * below, frame.z}, frame.to_world(above));
        controls += back && dot(back->point.position - near_origin, frame.z) < 1e-6 ? 1 : 0;

        const Vec3 before_wall{size - 0.3, 0.7 * size * to_uniform(v[0]), 0.1 + 3.8 * to_uniform(v[1])};
        const Vec3 on_wall{size, std::clamp(before_wall.y + to_uniform(v[2]) - 0.5, 0.1, 0.7 * size - 0.1),
                           0.1 + 3.8 * to_uniform(v[3])};
        EXPECT_EQ(rays.transmittance({place(before_wall), frame.x}, place(on_wall)).share, 1);
        EXPECT_EQ(rays.transmittance({near_origin + frame.z * 0.3, frame.z}, near_origin).share, 1);
      }
      EXPECT_EQ(controls, 20000);
    }
}

// A sheet 1.5 mm thick, far from the origin in a hall of 200 m, is opaque: from its own faces and from afar,
// and for objects that touch its other face. The control passes beside it.
TEST(RayScene, ThinSheetsBlockInAHall) {
  Scene scene = test::empty_room({200, 140, 6});
  const Vec3 low{180.3, 120.2, 1}, high{180.3015, 121.2, 2};
  const auto first = static_cast<std::uint32_t>(scene.mesh.vertices.size());
  for (const double x : {low.x, high.x}) {
    for (const auto& [y, z] : {std::pair(low.y, low.z), {high.y, low.z}, {high.y, high.z}, {low.y, high.z}})
      scene.mesh.vertices.push_back({x, y, z});
    const std::uint32_t a = x == low.x ? first : first + 4;
    for (const std::uint32_t k : {1U, 2U}) {
      scene.mesh.triangles.push_back({a, a + k, a + k + 1});
      scene.mesh.materials.push_back(MaterialId{0});
    }
  }
  const RayScene rays(scene);
  for (std::uint32_t k = 0; k < 2000; ++k) {
    const auto u = philox({k, 0, 0, 0}, 5);
    const double y = 120.3 + 0.8 * to_uniform(u[0]), z = 1.1 + 0.8 * to_uniform(u[1]);
    const Vec3 beyond{high.x, 120.3 + 0.8 * to_uniform(u[2]), 1.1 + 0.8 * to_uniform(u[3])};
    EXPECT_EQ(rays.transmittance({{low.x, y, z}, {-1, 0, 0}}, beyond + Vec3{0.3, 0, 0}).share, 0);
    EXPECT_EQ(rays.transmittance({{178, y, z}, {1, 0, 0}}, beyond + Vec3{0.0005, 0, 0}).share, 0);
    EXPECT_EQ(rays.transmittance({{178, y, z}, {1, 0, 0}}, beyond + Vec3{0.3, 0, 4}).share, 1);
  }
}

TEST(RayScene, FixturesBlock) {
  const Scene scene = test::SmallStore{}.scene();
  const RayScene rays(scene);
  EXPECT_EQ(rays.transmittance({{2, 1.0, 0.3}, {0, -1, 0}}, Vec3{2, 4.5, 0.4}).share, 0);
  EXPECT_EQ(rays.transmittance({{2, 1.0, 0.3}, {0, -1, 0}}, Vec3{2, 0.2, 2.9}).share, 1);
}

// Rays from points on the surfaces below to points in the air, in packets of every size from 1 to 40: equal
// results, each kind at least 500 times. Probabilities are not shares, which the control uses instead.
TEST(RayScene, PacketsAgreeWithSingleRays) {
  test::StrategyStore store;
  store.add_glass();
  store.set("pane", make_thin_dielectric(1.5, 0.01, 20));
  const RayScene rays(store.scene());
  const auto place = [](std::uint32_t k, std::uint32_t stream) {
    const auto u = philox({k, stream, 0, 0}, 9);
    return Vec3{6 * to_uniform(u[0]), 5 * to_uniform(u[1]), 3 * to_uniform(u[2])};
  };
  int blocked = 0, dimmed = 0, open = 0, differ = 0;
  for (std::uint32_t k = 0; k < 600; ++k) {
    const auto hit = rays.intersect({place(k, 0), {0, 0, 1}}, {0, 0, -1});
    const SurfacePoint from{hit ? hit->point.position : place(k, 0), {0, 0, 1}};
    std::vector<RayEnd> to;
    for (std::uint32_t t = 0; t < 1 + k % 40; ++t) to.push_back(place(k, t + 1));
    std::vector<float> shares(to.size(), -1);
    std::vector<Transmittance> transmittances(to.size());
    rays.shares(from, to, shares);
    rays.transmittances(from, to, transmittances);
    for (std::size_t t = 0; t < to.size(); ++t) {
      const Transmittance expected = rays.transmittance(from, to[t]);
      EXPECT_EQ(shares[t], static_cast<float>(expected.share)) << k << ", " << t;
      EXPECT_EQ(transmittances[t].share, expected.share) << k << ", " << t;
      EXPECT_EQ(transmittances[t].probability, expected.probability) << k << ", " << t;
      ++(expected.share == 0 ? blocked : expected.share < 1 ? dimmed : open);
      differ += expected.probability != expected.share ? 1 : 0;
    }
  }
  for (const int times : {blocked, dimmed, open, differ}) EXPECT_GT(times, 500);
}

}  // namespace
}  // namespace shelfbeam
