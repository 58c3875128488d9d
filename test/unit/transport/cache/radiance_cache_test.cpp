#include "shelfbeam/transport/cache/radiance_cache.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "physics/bare_scene.hpp"
#include "unit/transport/zoo.hpp"

namespace shelfbeam {
namespace {

constexpr double wall_albedo = 0.6;

// A room with a shelf, and labels on the floor. The first of them are in its shadow for the second unit.
test::BareScene room(double of_all = wall_albedo) {
  test::BareScene room;
  room.box(room.material(Lambertian{of_all}), {0, 0, 0}, {6, 5, 3});
  room.box(room.material(Lambertian{of_all}), {2.8, 0.5, 0}, {3.3, 4.5, 1.8});
  for (int k = 0; k < 10; ++k)
    room.label({k < 5 ? 1.2 + 0.2 * k : 4 + 0.2 * k - 1, 1 + 0.33 * k, 0.002}, {0, 0, 1});
  room.unit({1.5, 2.5, 2.9}, {0, 0, -1}, GeneralizedLambertian{1, pi});
  room.unit({4.5, 2.5, 2.9}, {0, 0, -1}, GeneralizedLambertian{1, pi});
  return room;
}

SurfaceLinks links_of(const World& world, std::uint64_t seed,
                      detail::CellSearch search = detail::CellSearch::units) {
  return {
      world, std::make_shared<const detail::SurfaceCells>(world, seed, search, RunControl{}), seed, {}, {}};
}

struct Prepared {
  test::BareScene scene;
  World world{scene.scene};
  UnitGroups groups{world};
  RadianceCache cache;

  explicit Prepared(double of_all = wall_albedo, float threshold = 1e-4F, std::uint64_t seed = 5)
      : scene(room(of_all)), cache(world, groups, links_of(world, seed), threshold) {}

  double cached(const SurfacePoint& at, std::size_t j) const {
    const RadianceCache::Row row = cache.row(at);
    double sum = 0;
    for (std::size_t c = 0; c < row.count; ++c) {
      if (row.groups[c] != groups.lane_index(j) / lanes) continue;
      LaneValues e;
      groups.irradiance(row.groups[c], LanePoint(at), e);
      const std::size_t k = groups.lane_index(j) % lanes;
      sum += static_cast<double>(e[k] * PackedLane::share(row.share[c * lanes + k]) +
                                 PackedLane::value(row.indirect[c * lanes + k]));
    }
    return sum;
  }

  // Root mean square and largest relative deviation on the floor from a room of some albedo.
  std::pair<double, double> deviation(double real_albedo) const {
    const SignalMatrix truth =
        simulate(room(real_albedo).scene, {EstimatorKind::uniform, 60000, DirectLight::exact, 3}).matrix;
    double squares = 0, largest = 0;
    for (std::size_t i = 0; i < truth.rows(); ++i)
      for (std::size_t j = 0; j < 2; ++j) {
        const double ratio = cached({scene.scene.labels[i].position, {0, 0, 1}}, j) /
                             static_cast<double>(truth.mean[truth.at(i, j)]);
        squares += std::pow(ratio - 1, 2) / static_cast<double>(truth.mean.size());
        largest = std::max(largest, std::abs(ratio - 1));
      }
    return {std::sqrt(squares), largest};
  }
};

const SurfacePoint floor_point{{1.5, 2.5, 0}, {0, 0, 1}};

// The cache is coarse: irradiance on the floor is within 30 %, and within 12 % as root mean square (the
// reference within 1 %). The control is a room with an albedo of 0.45.
TEST(RadianceCache, ApproximatesTheIrradiance) {
  const Prepared room;
  EXPECT_GT(room.cache.cells(), 100U);
  EXPECT_NEAR(static_cast<double>(room.cache.guide(MaterialId{0}).flat()) * pi, wall_albedo, 1e-6);
  const auto [typical, largest] = room.deviation(wall_albedo);
  EXPECT_LT(typical, 0.12);
  EXPECT_LT(largest, 0.3);
  EXPECT_GT(room.deviation(0.45).first, 0.12);
}

// The rounds compute 1 - 0.95^7, less than a third, of the final light of white walls; rays that the cells
// lose cost a fifth. The control is a room with an albedo of 0.9, whose walls have half as much.
TEST(RadianceCacheSlow, ExtrapolatesTheBouncesBetweenWhiteWalls) {
  const Prepared room(0.95);
  EXPECT_LT(room.deviation(0.95).first, 0.3);
  EXPECT_GT(room.deviation(0.9).first, 0.3);
}

TEST(RadianceCache, IsEmptyOutsideLitSurfaces) {
  const Prepared room;
  EXPECT_GT(room.cache.row(floor_point).count, 0U);
  EXPECT_EQ(room.cache.row({{60, 2.5, 0}, {0, 0, 1}}).count, 0U);
  EXPECT_EQ(room.cache.row({{1.5, 2.5, 0}, {0, 0, -1}}).count, 0U);
  EXPECT_EQ(room.cache.row({{1.5, 2.5, 1.5}, {0, 0, 1}}).count, 0U);
  // Light that is too weak is not stored.
  EXPECT_EQ(Prepared(wall_albedo, 1e6F).cache.row(floor_point).count, 0U);
}

// The places with light of a back room's unit, among a hundred on its floor. The control is a cache whose
// walks all start at labels, which are in the hall.
TEST(RadianceCache, KnowsABackRoomWithoutLabels) {
  const auto known_places = [](const std::string& name, detail::CellSearch search, std::size_t unit) {
    const Scene scene = test::zoo_room(name).scene();
    const World world(scene);
    const UnitGroups groups(world);
    const RadianceCache cache(world, groups, links_of(world, 5, search), 1e-4F);
    const std::size_t lane = groups.lane_index(unit);
    int known = 0;
    for (int k = 0; k < 100; ++k) {
      const RadianceCache::Row row =
          cache.row({{9.15 + 0.3 * (k % 10), 6.15 + 0.3 * static_cast<int>(k / 10), 0}, {0, 0, 1}});
      for (std::size_t c = 0; c < row.count; ++c)
        if (row.groups[c] == lane / lanes && PackedLane::value(row.indirect[c * lanes + lane % lanes]) > 0)
          ++known;
    }
    return std::pair(cache.any_hidden(), known);
  };
  const auto [is_hidden, known] = known_places("back room", detail::CellSearch::units, 0);
  EXPECT_TRUE(is_hidden);
  EXPECT_GT(known, 95);
  const auto [is_hidden_to_labels, known_by_labels] =
      known_places("back room", detail::CellSearch::labels, 0);
  EXPECT_FALSE(is_hidden_to_labels);
  EXPECT_LT(known_by_labels, 70);  // cells beside inner walls are always known
  // Nothing changes where walks from labels meet what units light.
  for (const char* const name : {"ordinary shop", "warehouse", "back room with labels"})
    EXPECT_FALSE(known_places(name, detail::CellSearch::units, 0).first) << name;
}

TEST(RadianceCache, FollowsFromTheSeedAlone) {
  const Prepared one, same, other(wall_albedo, 1e-4F, 6);
  EXPECT_EQ(one.cached(floor_point, 1), same.cached(floor_point, 1));
  EXPECT_NE(one.cached(floor_point, 1), other.cached(floor_point, 1));
}

}  // namespace
}  // namespace shelfbeam
