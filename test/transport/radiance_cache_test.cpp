#include "shelfbeam/transport/radiance_cache.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "shelfbeam/transport/simulate.hpp"

#include "physics/bare_scene.hpp"

namespace shelfbeam {
namespace {

constexpr double albedo = 0.6;

// A room with a shelf, and labels on the floor, of which the first lie in its shadow for the second unit.
test::BareScene room() {
  test::BareScene room;
  room.box(room.material(Lambertian{albedo}), {0, 0, 0}, {6, 5, 3});
  room.box(room.material(Lambertian{albedo}), {2.8, 0.5, 0}, {3.3, 4.5, 1.8});
  for (int k = 0; k < 10; ++k)
    room.label({k < 5 ? 1.2 + 0.2 * k : 4 + 0.2 * k - 1, 1 + 0.33 * k, 0.002}, {0, 0, 1});
  room.unit({1.5, 2.5, 2.9}, {0, 0, -1}, GeneralizedLambertian{1, pi});
  room.unit({4.5, 2.5, 2.9}, {0, 0, -1}, GeneralizedLambertian{1, pi});
  return room;
}

double cached(const RadianceCache& cache, const UnitGroups& groups, const SurfacePoint& at, std::size_t j) {
  const RadianceCache::Row row = cache.row(at);
  double sum = 0;
  for (std::size_t c = 0; c < row.count; ++c) {
    if (row.groups[c] != groups.place(j) / lanes) continue;
    LaneValues e;
    groups.irradiance(row.groups[c], LanePoint(at), e);
    const std::size_t k = groups.place(j) % lanes;
    sum += static_cast<double>(e[k] * PackedLane::share(row.share[c * lanes + k]) +
                               PackedLane::value(row.indirect[c * lanes + k]));
  }
  return sum;
}

// Coarse: irradiance on the floor within 30 %, within 12 % as root mean square (the reference to 1 %). The
// control is a room with the albedo of 0.45.
TEST(RadianceCache, HoldsRoughlyTheIrradiance) {
  const test::BareScene scene = room();
  const World world(scene.scene);
  const UnitGroups groups(world);
  const RadianceCache cache(world, groups, 1e-4F, 5);
  EXPECT_GT(cache.cells(), 100U);
  EXPECT_GT(cache.rays(), 10000U);
  EXPECT_NEAR(static_cast<double>(cache.guide(MaterialId{0}).flat()) * pi, albedo, 1e-6);

  const auto deviation = [&](double other_albedo) {
    test::BareScene other = room();
    for (NamedMaterial& material : other.scene.materials) material.material = Lambertian{other_albedo};
    const SignalMatrix truth = simulate(other.scene, "", {60000, DirectLight::exact, 3}).matrix;
    double squares = 0, largest = 0;
    for (std::size_t i = 0; i < truth.rows(); ++i)
      for (std::size_t j = 0; j < 2; ++j) {
        const double ratio = cached(cache, groups, {scene.scene.labels[i].position, {0, 0, 1}}, j) /
                             static_cast<double>(truth.mean[truth.at(i, j)]);
        squares += std::pow(ratio - 1, 2) / static_cast<double>(truth.mean.size());
        largest = std::max(largest, std::abs(ratio - 1));
      }
    return std::pair{std::sqrt(squares), largest};
  };
  const auto [typical, largest] = deviation(albedo);
  EXPECT_LT(typical, 0.12);
  EXPECT_LT(largest, 0.3);
  EXPECT_GT(deviation(0.45).first, 0.12);
}

TEST(RadianceCache, IsBlankWhereNothingIsKnown) {
  const test::BareScene scene = room();
  const World world(scene.scene);
  const UnitGroups groups(world);
  const SurfacePoint floor{{1.5, 2.5, 0}, {0, 0, 1}};
  const RadianceCache cache(world, groups, 1e-4F, 5);
  EXPECT_GT(cache.row(floor).count, 0U);
  EXPECT_EQ(cache.row({{60, 2.5, 0}, {0, 0, 1}}).count, 0U);
  EXPECT_EQ(cache.row({{1.5, 2.5, 0}, {0, 0, -1}}).count, 0U);
  EXPECT_EQ(cache.row({{1.5, 2.5, 1.5}, {0, 0, 1}}).count, 0U);
  // Nor is anything kept that is too faint.
  EXPECT_EQ(RadianceCache(world, groups, 1e6F, 5).row(floor).count, 0U);
}

TEST(RadianceCache, FollowsFromTheSeedAlone) {
  const test::BareScene scene = room();
  const World world(scene.scene);
  const UnitGroups groups(world);
  const SurfacePoint floor{{1.5, 2.5, 0}, {0, 0, 1}};
  const RadianceCache one(world, groups, 1e-4F, 5), same(world, groups, 1e-4F, 5),
      other(world, groups, 1e-4F, 6);
  EXPECT_EQ(cached(one, groups, floor, 1), cached(same, groups, floor, 1));
  EXPECT_NE(cached(one, groups, floor, 1), cached(other, groups, floor, 1));
}

}  // namespace
}  // namespace shelfbeam
