// Rays in packets against rays one by one.

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"

#include "physics/strategy_store.hpp"

namespace shelfbeam {
namespace {

Scene store_with_panes() {
  test::StrategyStore store;
  store.add_glass();
  store.set("pane", make_thin_dielectric(1.5, 0.01, 20));
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
  const Scene scene = store_with_panes();
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

// The chances of walks through panes are those of passages, too; they are not the shares, which the control
// takes for them.
TEST(PacketRays, ProbabilitiesAreThoseOfPassages) {
  const Scene scene = store_with_panes();
  const RayScene rays(scene);
  int differ = 0;
  for (std::uint32_t k = 0; k < 600; ++k) {
    const SurfacePoint from = start(rays, k);
    std::vector<Vec3> to;
    for (std::uint32_t t = 0; t < 1 + k % 40; ++t) to.push_back(place(k, t + 1));
    std::vector<Passage> passages(to.size());
    rays.passages(from, to, passages);
    for (std::size_t t = 0; t < to.size(); ++t) {
      const Passage expected = rays.passage(from, to[t]);
      EXPECT_EQ(passages[t].share, expected.share) << k << ", " << t;
      EXPECT_EQ(passages[t].probability, expected.probability) << k << ", " << t;
      differ += passages[t].probability != passages[t].share ? 1 : 0;
    }
  }
  EXPECT_GT(differ, 500);
}

}  // namespace
}  // namespace shelfbeam
