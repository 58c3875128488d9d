#include "shelfbeam/transport/world/specular_chain.hpp"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"

#include "physics/bare_scene.hpp"

namespace shelfbeam {
namespace {

// Paths straight through two panes have the probability and the share of a connection to their end; both are
// products of the same numbers, in the same order except for rounding. The control uses the throughput, which
// is their ratio, as the share.
TEST(SpecularChain, ProbabilitiesOfStraightPathsEqualTransmittances) {
  test::BareScene room;
  room.box(room.material(Lambertian{0.5}), {0, 0, 0}, {4, 3, 3});
  room.quad(room.material(ThinDielectric{4, 0.004, 50}), {1.5, 0, 0}, {0, 3, 0}, {0, 0, 3});
  room.quad(room.material(ThinDielectric{1.5, 0.01, 20}), {2.5, 0, 0}, {0, 3, 0}, {0, 0, 2});
  room.label({0.01, 1, 1}, {1, 0, 0});
  room.unit({3.5, 1.5, 2.9}, {0, 0, -1}, SinTwoTheta{1});
  const World world(room.scene);
  const SurfacePoint from{{0.01, 1, 1}, {1, 0, 0}};
  int through[3] = {}, mirror_path = 0, differ = 0;
  for (std::uint32_t k = 0; k < 4000; ++k) {
    RandomStream random(3, k, 0, 0);
    const double u1 = random.uniform(), u2 = random.uniform();
    const Vec3 direction = Frame::about({1, 0, 0}).to_world(sample_cosine_hemisphere(u1, u2));
    std::uint64_t rays = 0;
    const auto end =
        follow_chain(world, from, direction, Departure::scattered, random, rays, [](std::size_t, double) {});
    ASSERT_TRUE(end);
    if (!end->is_straight) {
      ++mirror_path;
      continue;
    }
    ++through[rays - 1];
    const Transmittance transmittance = world.rays.transmittance(from, end->point.position);
    EXPECT_NEAR(end->probability, transmittance.probability, 1e-5 * transmittance.probability);
    EXPECT_NEAR(end->throughput * end->probability, transmittance.share, 1e-5 * transmittance.share);
    differ += std::abs(end->throughput - transmittance.share) > 1e-5 * transmittance.share ? 1 : 0;
  }
  for (const int ways : through) EXPECT_GT(ways, 100);
  EXPECT_GT(mirror_path, 100);
  EXPECT_GT(differ, 200);
}

// Connections find the discs that a scattered ray meets and, by way of one plane mirror, their images. Only a
// ray by way of two mirrors finds a disc itself.
TEST(SpecularChain, ScoresDiscsWhereNoConnectionFindsThem) {
  test::BareScene room;
  const MaterialId mirror = room.material(Conductor{0, 1, {}});
  room.box(room.material(Lambertian{0.5}), {0, 0, 0}, {6, 4, 3});
  room.quad(mirror, {0.1, 0, 0}, {0, 4, 0}, {0, 0, 3});
  room.quad(mirror, {5.9, 0, 0}, {0, 4, 0}, {0, 0, 3});
  room.label({3, 2, 1}, {1, 0, 0});
  room.unit({3, 2, 2}, {1, 0, 0}, GeneralizedLambertian{1, 1}, 0.5);
  const World world(room.scene);
  const auto scored = [&](const Vec3& from, const Vec3& direction, Departure departure) {
    RandomStream random(1, 0, 0, 0);
    std::uint64_t rays = 0;
    int times = 0;
    follow_chain(world, {from, {1, 0, 0}}, normalized(direction), departure, random, rays,
                 [&](std::size_t, double) { ++times; });
    return times;
  };
  // Rays that end at the floor: to the face of the disc, directly and by way of one and two mirrors. The disc
  // blocks none of them.
  EXPECT_EQ(scored({5, 2, 2.9}, {-2, 0, -0.9}, Departure::scattered), 0);
  EXPECT_EQ(scored({5, 2, 2.9}, {-2, 0, -0.9}, Departure::mirrored), 0);
  EXPECT_EQ(scored({5, 2, 2.9}, {-2, 0, -0.9}, Departure::specular), 1);
  EXPECT_EQ(scored({4, 2, 2.9}, {1.9 + 2.9, 0, -0.9}, Departure::scattered), 0);
  EXPECT_EQ(scored({2, 2, 2.9}, {-(1.9 + 5.8 + 2.9), 0, -0.9}, Departure::scattered), 1);
  EXPECT_EQ(after_specular(Departure::scattered, false), Departure::specular);
}

}  // namespace
}  // namespace shelfbeam
