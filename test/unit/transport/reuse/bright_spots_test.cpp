#include "shelfbeam/transport/reuse/bright_spots.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/stats/moments.hpp"

#include "physics/bare_scene.hpp"
#include "support/hypothesis.hpp"
#include "unit/transport/zoo.hpp"

namespace shelfbeam {
namespace {

// Units half a metre from a wall, in the middle of the room, and beside a column.
test::BareScene room_with_column() {
  test::BareScene room;
  const MaterialId paper = room.material(Lambertian{0.6});
  room.box(paper, {0, 0, 0}, {24, 20, 4.4});
  room.box(paper, {12, 9, 0}, {12.4, 9.4, 4.4});
  room.label({12, 0.01, 1}, {0, 1, 0});
  room.unit({12, 0.5, 4.3}, {0, 0, -1}, SinTwoTheta{1.6});
  room.unit({6, 12, 4.3}, {0, 0, -1}, SinTwoTheta{1.6});
  room.unit({12.6, 9.1, 4.3}, {0, 0, -1}, GeneralizedLambertian{1, 5});
  return room;
}

constexpr SpotRule rule{.min_cap_distance = 2};

TEST(BrightSpots, AreFoundBesideUnits) {
  const test::BareScene scene = room_with_column();
  const World world(scene.scene);
  UnitGroups units(world);
  const BrightSpots spots(world, units, 3, rule);
  EXPECT_EQ(spots.size(), 2U);
  const auto cap = [&](std::size_t j) {
    return units.cap(units.lane_index(j) / lanes, units.lane_index(j) % lanes);
  };
  EXPECT_FLOAT_EQ(cap(0), 1.6F / 4);
  EXPECT_GT(cap(1), 1e30F);
  EXPECT_LT(cap(2), 1);
}

// Units at 10 to 30 cm from columns light the ceiling over these; units under a ceiling do not.
TEST(BrightSpots, AreSteepBesideColumns) {
  const auto any_steep = [](const std::string& name) {
    const Scene scene = test::zoo_room(name).scene();
    const World world(scene);
    UnitGroups units(world);
    return BrightSpots(world, units, 3).any_steep();
  };
  EXPECT_TRUE(any_steep("units beside columns"));
  EXPECT_FALSE(any_steep("ordinary shop"));
  EXPECT_FALSE(any_steep("low shop"));
}

// A single unit, and one in a crowd 20 m away, 0.3 m above the floor. The caps have the two distances of the
// rule, and 1 m times sqrt(16 / 25) where 25 units are together.
TEST(BrightSpots, AreSmallerWhereUnitsAreMany) {
  for (const auto& [crowd, distance] : {std::pair{1, 1.0}, {16, 1.0}, {25, 0.8}, {64, 0.5}, {100, 0.5}}) {
    test::BareScene scene;
    scene.box(scene.material(Lambertian{0.6}), {0, 0, 0}, {30, 10, 4});
    scene.label({12, 0.01, 1}, {0, 1, 0});
    scene.unit({1, 5, 0.3}, {0, 0, -1}, SinTwoTheta{2});
    for (int k = 0; k < crowd; ++k) scene.unit({22 + 0.01 * k, 5, 0.3}, {0, 0, -1}, SinTwoTheta{2});
    const World world(scene.scene);
    UnitGroups units(world);
    const BrightSpots spots(world, units, 3);
    EXPECT_EQ(spots.size(), world.scene.transceivers.size());
    const auto cap = [&](std::size_t j) {
      return units.cap(units.lane_index(j) / lanes, units.lane_index(j) % lanes);
    };
    EXPECT_FLOAT_EQ(cap(0), 2);
    EXPECT_FLOAT_EQ(cap(1), static_cast<float>(2 / (distance * distance))) << crowd;
  }
}

// Flux in the excess of a unit, from rays sampled by its emission alone.
Moments plain_excess(const World& world, const UnitGroups& units, std::uint32_t j, std::uint32_t rays) {
  Moments moments;
  for (std::uint32_t r = 0; r < rays; ++r) {
    const auto u = philox({r, j, 0, 0}, 4);
    const auto emitted =
        world.emitters.emit(j, {to_uniform(u[0]), to_uniform(u[1]), to_uniform(u[2]), to_uniform(u[3])});
    double excess = 0;
    if (emitted) {
      const auto hit =
          world.rays.intersect({emitted->from.position, emitted->from.normal}, emitted->direction);
      SurfacePoint at = hit->point;
      if (dot(at.normal, emitted->direction) > 0) at.normal = -at.normal;
      const std::size_t g = units.lane_index(j) / lanes, lane = units.lane_index(j) % lanes;
      LaneValues e;
      units.irradiance(g, LanePoint(at), e);
      if (e[lane] > units.cap(g, lane))
        excess = emitted->flux * (1 - static_cast<double>(units.cap(g, lane) / e[lane]));
    }
    moments.add(excess);
  }
  return moments;
}

// For all distances and efforts, and so for all probabilities and numbers of rays, the lights of a unit carry
// its whole excess on average: both units, with eight rays, two or five, one, and one with a probability.
// z-test at 0.1 %, with errors of at most 5 %, and 1.5 % except for small probabilities. The control is a
// reference 8 % off.
TEST(BrightSpots, CarryTheWholeExcess) {
  const test::BareScene scene = room_with_column();
  const World world(scene.scene);
  UnitGroups units(world);
  const BrightSpots spots(world, units, 3, rule);
  std::vector<double> found, expected, errors;
  for (const std::uint32_t j : {0U, 2U}) {
    const Moments plain = plain_excess(world, units, j, 200000);
    for (const BrightSpots::Effort& effort :
         {BrightSpots::Effort{1e-4, 8}, {0.008, 8}, {0.02, 8}, {0.2, 8}}) {
      Moments drawn;
      std::vector<SpotLight> lights;
      std::uint64_t rays = 0;
      const std::vector<RayEnd> points{Vec3{14, 8, 1}, Vec3{10, 6, 1}};
      for (std::uint32_t batch = 0; batch < 20000; ++batch) {
        spots.draw(points, effort, {7, batch}, lights, rays);
        double power = 0;
        for (const SpotLight& light : lights)
          if (light.lane_index == units.lane_index(j)) power += light.power * spots.excess(light, 0);
        drawn.add(power);
      }
      found.push_back(drawn.mean());
      expected.push_back(plain.mean());
      errors.push_back(std::hypot(drawn.standard_error(), plain.standard_error()));
      EXPECT_LT(errors.back() / expected.back(), effort.relevant < 0.1 ? 0.015 : 0.05);
    }
  }
  EXPECT_TRUE(z_test(found, expected, errors, 0.001).pass);
  for (double& value : expected) value *= 1.08;
  EXPECT_FALSE(z_test(found, expected, errors, 0.001).pass);
}

// Closer than `near`, the cap grows with the density of the receiver's own rays.
TEST(BrightSpots, LeaveNearPointsToReceiverRays) {
  const test::BareScene scene = room_with_column();
  const World world(scene.scene);
  UnitGroups units(world);
  const BrightSpots spots(world, units, 3, {.min_cap_distance = 2, .near_distance = 0.5});
  const auto density = [](double distance) { return 1 / (pi * distance * distance); };
  SpotLight light;
  light.capped = 0.1;
  EXPECT_DOUBLE_EQ(spots.excess(light, 0), 0.9);
  EXPECT_DOUBLE_EQ(spots.excess(light, density(0.6)), 0.9);
  EXPECT_NEAR(spots.excess(light, density(0.25)), 0.6, 1e-12);
  EXPECT_EQ(spots.excess(light, density(0.1)), 0);
}

}  // namespace
}  // namespace shelfbeam
