// Rays in packets against rays one by one.

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/ray_scene.hpp"

#include "physics/strategy_store.hpp"

namespace shelfbeam {
namespace {

Scene store_with_panes(bool panes_are_walls) {
  test::StrategyStore store;
  store.add_glass();
  if (panes_are_walls) store.set("pane", make_lambertian(0.5));
  return store.scene();
}

Vec3 place(std::uint32_t k, std::uint32_t stream) {
  const auto u = philox({k, stream, 0, 0}, 9);
  return {6 * to_unit(u[0]), 5 * to_unit(u[1]), 3 * to_unit(u[2])};
}

// From a point on whatever lies below, to `count` others in the air.
SurfacePoint start(const RayScene& rays, std::uint32_t k) {
  const Vec3 above = place(k, 0);
  const auto hit = rays.intersect({above, {0, 0, 1}}, {0, 0, -1});
  return hit ? SurfacePoint{hit->point.position, {0, 0, 1}} : SurfacePoint{above, {0, 0, 1}};
}

// Equal, in packets of every size from 1 to 40; each kind of answer at least 500 times.
TEST(PacketRays, SharesAreThoseOfPassages) {
  const Scene scene = store_with_panes(false);
  const RayScene rays(scene);
  int blocked = 0, dimmed = 0, open = 0;
  for (std::uint32_t k = 0; k < 600; ++k) {
    const SurfacePoint from = start(rays, k);
    std::vector<Vec3> to;
    for (std::uint32_t t = 0; t < 1 + k % 40; ++t) to.push_back(place(k, t + 1));
    std::vector<float> shares(to.size(), -1);
    rays.shares(from, to, shares);
    for (std::size_t t = 0; t < to.size(); ++t) {
      const auto expected = static_cast<float>(rays.passage(from, to[t]).share);
      EXPECT_EQ(shares[t], expected) << k << ", " << t;
      ++(expected == 0 ? blocked : expected < 1 ? dimmed : open);
    }
  }
  EXPECT_GT(blocked, 500);
  EXPECT_GT(dimmed, 500);
  EXPECT_GT(open, 500);
}

// What is in sight is what light reaches where panes are walls; the control is what it reaches through them.
TEST(PacketRays, PanesAreNotSeenThrough) {
  const Scene scene = store_with_panes(false), walls = store_with_panes(true);
  const RayScene rays(scene), opaque(walls);
  int differ = 0;
  for (std::uint32_t k = 0; k < 600; ++k) {
    const SurfacePoint from = start(rays, k);
    std::vector<Vec3> to;
    for (std::uint32_t t = 0; t < 1 + k % 40; ++t) to.push_back(place(k, t + 1));
    std::vector<float> seen(to.size(), -1);
    rays.in_sight(from, to, seen);
    for (std::size_t t = 0; t < to.size(); ++t) {
      EXPECT_EQ(seen[t], opaque.passage(from, to[t]).share > 0 ? 1 : 0) << k << ", " << t;
      differ += (rays.passage(from, to[t]).share > 0) != (seen[t] > 0) ? 1 : 0;
    }
  }
  EXPECT_GT(differ, 500);
}

}  // namespace
}  // namespace shelfbeam
