// If every surface of a closed room has albedo a and emits the radiance L, the radiance is L / (1 - a)
// everywhere and in all directions, with any objects in the room. Lossless glass, panes and mirrors do not
// change it.

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"

#include "physics/bare_scene.hpp"
#include "physics/comparison.hpp"

namespace shelfbeam::physics::furnace {
namespace {

using test::Way;

constexpr double albedo = 0.6, radiance = 1.5;
// The reading of a cosine label at any position.
constexpr double reading(double a = albedo) {
  return pi * radiance / (1 - a);
}

// Either points, or a blind under the ceiling and a poster on a wall.
enum class Labels { points, large };
void add_labels(test::BareScene& room, Labels labels) {
  if (labels == Labels::large) {
    room.label({0.1, 0.3, 0.8}, {0, 0, -1}, CosineResponse{}, {1.2, 1});
    room.label({-1.3, 0, -0.1}, {1, 0, 0}, CosineResponse{}, {1.5, 1.2});
    return;
  }
  room.label({0.4, -0.5, 0.3}, {0, 0, 1});
  room.label({-0.6, 0.2, -0.5}, normalized({1, -2, 0.5}));
  room.label({0.75, 0.6, 0.1}, {-1, 0, 0});
  room.label({-0.3, -0.75, 0.4}, normalized({-1, 0.3, -3}));
}

// An emitting room with an emitting box in it.
test::BareScene furnace(Labels labels) {
  test::BareScene room;
  const MaterialId wall = room.material(Lambertian{albedo});
  room.box(wall, {-1.5, -1.25, -1}, {1.5, 1.25, 1});
  room.box(wall, {-0.25, -0.2, -0.4}, {0.3, 0.25, 0.2});
  room.shines(wall, radiance);
  add_labels(room, labels);
  return room;
}

// Adds glass, a pane and a mirror, which neither emit nor absorb and fill much of the labels' field of view.
void add_clear_things(test::BareScene& room) {
  room.box(room.material(Dielectric{1.5, {}}), {-0.2, 0.35, -0.3}, {0.5, 0.7, 0.5});
  room.quad(room.material(ThinDielectric{1.5, 0.006, 0}), {-0.1, -0.7, -0.6}, {0.5, 0.3, 0}, {0, 0.2, 1});
  room.quad(room.material(Conductor{0, 1, {}}), {0.5, -0.3, -0.6}, {0.1, 0.6, 0}, {0, 0, 0.9});
}

// Tests all labels, with a relative standard error below 0.5 % (particles 0.8 %). The control is an albedo 2
// % off, which is 3 % of the reading.
void expect_uniform(const Way& way, const test::BareScene& room, std::uint64_t samples,
                    double precision = 5e-3) {
  test::Comparison readings;
  readings.add_column(way.simulate(room.scene, samples), 0, reading());
  test::expect_agreement(readings, way.strategy == Strategy::particle ? 8e-3 : precision,
                         reading(1.02 * albedo) / reading(), way.name);
}

TEST(Furnace, IsUniformInABoxWithABoxInIt) {
  for (const Labels labels : {Labels::points, Labels::large}) {
    for (const Way& way : {test::walk, test::mis, test::mis_power})
      expect_uniform(way, furnace(labels), 40000);
    expect_uniform(test::particle, furnace(labels), 120000);
  }
}

// Behind glass a particle reaches only labels with a size.
TEST(Furnace, StaysUniformWithGlassPanesAndMirrors) {
  for (const Labels labels : {Labels::points, Labels::large}) {
    test::BareScene room = furnace(labels);
    add_clear_things(room);
    for (const Way& way : {test::walk, test::mis, test::mis_power}) expect_uniform(way, room, 40000);
    if (labels == Labels::large) expect_uniform(test::particle, room, 200000);
  }
}

// Connections between surfaces that meet in an emitting corner have no finite variance, and so no usable
// standard error. Plain next event estimation and path reuse are therefore tested in a room without corners.
test::BareScene sphere(bool clear_things) {
  test::BareScene room;
  const MaterialId wall = room.material(Lambertian{albedo});
  room.sphere(wall, 1.5, 4);
  room.shines(wall, radiance);
  add_labels(room, Labels::points);
  room.label({0.75, 0.6, 0.1}, {-1, 0, 0}, CosineResponse{}, {0.2, 0.1});
  if (clear_things) add_clear_things(room);
  return room;
}

TEST(FurnaceSlow, IsUniformForConnectionsAloneInASphere) {
  for (const bool clear_things : {false, true}) expect_uniform(test::nee, sphere(clear_things), 40000);
}

TEST(FurnaceSlow, IsUniformForPathReuseInASphere) {
  for (const bool clear_things : {false, true})
    expect_uniform(test::path_reuse, sphere(clear_things), 150 * test::reuse_samples, 6.5e-3);
}

}  // namespace
}  // namespace shelfbeam::physics::furnace
