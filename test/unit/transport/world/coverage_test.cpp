#include "shelfbeam/transport/world/coverage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/transport/world/world.hpp"

#include "physics/bare_scene.hpp"

namespace shelfbeam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Two mirrors, a block of glass and a point or, with a radius, a disc.
test::BareScene hall_of_mirrors(double radius) {
  test::BareScene room;
  const MaterialId mirror = room.material(Conductor{0, 1, {}});
  room.box(room.material(Lambertian{0.5}), {0, 0, 0}, {5, 4, 3});
  room.quad(mirror, {1, 1, 0.5}, {2, 0, 0}, {0, 0, 1});
  room.quad(mirror, {1, 3, 0.5}, {2, 0, 0}, {0, 0, 1});
  room.box(room.material(Dielectric{1.5, {}}), {4, 2, 0.1}, {4.5, 2.5, 1});
  room.label({2, 2, 1}, {1, 0, 0});
  room.unit({2, 2, 2.5}, {0, 0, -1}, SinTwoTheta{1}, radius);
  return room;
}

TEST(StrategyCoverage, NamesLightThatPointsMissAndDiscsFindByChance) {
  const test::BareScene points = hall_of_mirrors(0), discs = hall_of_mirrors(0.1);
  const auto both = [](PathEnd end) {
    return ElementsAre(LightKind{end, PathWay::successive_mirrors, {MaterialId{0}, MaterialId{2}}},
                       LightKind{end, PathWay::solid_glass, {MaterialId{2}}});
  };
  EXPECT_THAT(uncovered_light(points.scene), both(PathEnd::point_transceivers));
  EXPECT_THAT(chance_light(points.scene), IsEmpty());
  EXPECT_THAT(uncovered_light(discs.scene), IsEmpty());
  EXPECT_THAT(chance_light(discs.scene), both(PathEnd::disc_transceivers));
}

TEST(StrategyCoverage, ListsLightFoundByChance) {
  const test::BareScene discs = hall_of_mirrors(0.1);
  EXPECT_THAT(chance_light(discs.scene, Strategy::walk),
              ElementsAre(LightKind{PathEnd::disc_transceivers, PathWay::any}));
  EXPECT_THAT(chance_light(discs.scene, Strategy::particle), IsEmpty());
  test::BareScene sized = hall_of_mirrors(0);
  sized.label({3, 2, 1}, {1, 0, 0}, CosineResponse{}, {0.1, 0.1});
  EXPECT_THAT(chance_light(sized.scene), IsEmpty());
  EXPECT_THAT(chance_light(sized.scene, Strategy::particle),
              ElementsAre(LightKind{
                  PathEnd::sized_labels, PathWay::mirrors_and_glass, {MaterialId{0}, MaterialId{2}}}));
  test::BareScene lit = hall_of_mirrors(0);
  lit.scene.emitting_surfaces.push_back({"panel", lit.material(Lambertian{0.5}), 1});
  EXPECT_THAT(chance_light(lit.scene),
              ElementsAre(LightKind{
                  PathEnd::emitting_surfaces, PathWay::mirrors_and_glass, {MaterialId{0}, MaterialId{2}}}));
}

TEST(StrategyCoverage, IsCompleteWithoutMirrors) {
  test::BareScene room;
  room.box(room.material(Lambertian{0.5}), {0, 0, 0}, {5, 4, 3});
  room.label({2, 2, 1}, {1, 0, 0});
  room.unit({2, 2, 2.5}, {0, 0, -1}, SinTwoTheta{1}, 0.1);
  EXPECT_THAT(uncovered_light(room.scene), IsEmpty());
  EXPECT_THAT(chance_light(room.scene), IsEmpty());
}

}  // namespace
}  // namespace shelfbeam
