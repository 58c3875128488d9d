#include "shelfbeam/transport/specular_chain.hpp"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"

#include "physics/bare_scene.hpp"

namespace shelfbeam {
namespace {

// Ways straight through two panes have the chance and the share that a passage to their end has; both are
// products of the same numbers, in the same order but for rounding. The control takes the throughput, which
// is their ratio, for the share.
TEST(SpecularChain, ChancesOfStraightWaysAreThoseOfPassages) {
  test::BareScene room;
  room.box(room.material(Lambertian{0.5}), {0, 0, 0}, {4, 3, 3});
  room.quad(room.material(ThinDielectric{4, 0.004, 50}), {1.5, 0, 0}, {0, 3, 0}, {0, 0, 3});
  room.quad(room.material(ThinDielectric{1.5, 0.01, 20}), {2.5, 0, 0}, {0, 3, 0}, {0, 0, 2});
  room.label({0.01, 1, 1}, {1, 0, 0});
  room.unit({3.5, 1.5, 2.9}, {0, 0, -1}, SinTwoTheta{1});
  const World world(room.scene);
  const SurfacePoint from{{0.01, 1, 1}, {1, 0, 0}};
  int through[3] = {}, bent = 0, differ = 0;
  for (std::uint32_t k = 0; k < 4000; ++k) {
    RandomStream random(3, k, 0, 0);
    const double u1 = random.unit(), u2 = random.unit();
    const Vec3 direction = Frame::about({1, 0, 0}).to_world(sample_cosine_hemisphere(u1, u2));
    std::uint64_t rays = 0;
    const auto end =
        follow_chain(world, from, direction, Departure::scattered, random, rays, [](std::size_t, double) {});
    ASSERT_TRUE(end);
    if (!end->is_straight) {
      ++bent;
      continue;
    }
    ++through[rays - 1];
    const Passage passage = world.rays.passage(from, end->point.position);
    EXPECT_NEAR(end->probability, passage.probability, 1e-5 * passage.probability);
    EXPECT_NEAR(end->throughput * end->probability, passage.share, 1e-5 * passage.share);
    differ += std::abs(end->throughput - passage.share) > 1e-5 * passage.share ? 1 : 0;
  }
  for (const int ways : through) EXPECT_GT(ways, 100);
  EXPECT_GT(bent, 100);
  EXPECT_GT(differ, 200);
}

}  // namespace
}  // namespace shelfbeam
