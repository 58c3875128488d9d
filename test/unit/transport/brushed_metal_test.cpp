// The first roughness of a surface is the one along its horizontal direction, on level surfaces along x.

#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/stats/hypothesis.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "support/empty_room.hpp"

namespace shelfbeam {
namespace {

// What a label hears over one brushed surface; all others are black.
struct Heard {
  double signal, standard_error;
};

Heard over_floor(double alpha_x, double alpha_y, bool along_x) {
  Scene scene = test::empty_room({8, 8, 3});
  scene.materials.push_back(
      {"brushed", make_conductor(0.2, 6, make_microfacets(FacetDistribution::ggx, alpha_x, alpha_y))});
  test::give_side(scene, {0, 0, -1}, MaterialId{1});
  const double a = 2, b = 6;
  scene.transceivers[0].position = along_x ? Vec3{a, 4, 2} : Vec3{4, a, 2};
  scene.labels[0].position = along_x ? Vec3{b, 4, 2} : Vec3{4, b, 2};
  scene.labels[0].normal = {0, 0, -1};
  SimulationOptions options;
  options.samples = 100000;
  const SignalMatrix matrix = simulate(scene, "", options).matrix;
  return {matrix.mean[0], matrix.standard_error[0]};
}

Heard over_wall(double alpha_across, double alpha_up, bool level) {
  Scene scene = test::empty_room({8, 8, 8});
  scene.materials.push_back(
      {"brushed", make_conductor(0.2, 6, make_microfacets(FacetDistribution::ggx, alpha_across, alpha_up))});
  test::give_side(scene, {-1, 0, 0}, MaterialId{1});
  scene.transceivers[0].position = level ? Vec3{2, 2, 4} : Vec3{2, 4, 6};
  scene.transceivers[0].axis = {-1, 0, 0};
  scene.labels[0].position = level ? Vec3{2, 6, 4} : Vec3{2, 4, 2};
  scene.labels[0].normal = {-1, 0, 0};
  SimulationOptions options;
  options.samples = 100000;
  const SignalMatrix matrix = simulate(scene, "", options).matrix;
  return {matrix.mean[0], matrix.standard_error[0]};
}

// z-test at 0.1 %; relative standard errors of about 1 %.
bool same(const Heard& a, const Heard& b) {
  return z_test(std::vector{a.signal}, std::vector{b.signal},
                std::vector{std::hypot(a.standard_error, b.standard_error)}, 0.001, batch_count - 1)
      .pass;
}

TEST(BrushedMetal, TurnsWithTheStore) {
  const Heard along = over_floor(0.1, 0.5, true);
  EXPECT_LT(along.standard_error / along.signal, 0.02);
  EXPECT_TRUE(same(along, over_floor(0.5, 0.1, false)));
  EXPECT_FALSE(same(along, over_floor(0.5, 0.1, true)));
  EXPECT_FALSE(same(along, over_floor(0.1, 0.5, false)));
}

TEST(BrushedMetal, FirstRoughnessIsHorizontalOnWalls) {
  const Heard level = over_wall(0.1, 0.5, true);
  EXPECT_LT(level.standard_error / level.signal, 0.02);
  EXPECT_TRUE(same(level, over_wall(0.5, 0.1, false)));
  EXPECT_FALSE(same(level, over_wall(0.5, 0.1, true)));
  // The same place over a floor and over a wall.
  EXPECT_TRUE(same(level, over_floor(0.1, 0.5, true)));
}

}  // namespace
}  // namespace shelfbeam
