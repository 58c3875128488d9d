// Compares path reuse entry by entry with strategies that share no sampling code with it.

#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/warp.hpp"

#include "physics/bare_scene.hpp"
#include "physics/comparison.hpp"
#include "physics/strategy_store.hpp"

namespace shelfbeam::physics::reuse_agreement {
namespace {

Scene glossy() {
  test::StrategyStore store;
  store.add_glossy();
  return store.scene();
}

// A scene with a mirror, a pane and a glass block, and with discs of 0.4 m and labels of 0.6 x 0.4 m, or
// points.
Scene glass(bool areas) {
  test::StrategyStore store;
  store.add_glossy();
  store.add_glass();
  if (areas) {
    store.radius = 0.4;
    store.label_size = {0.6, 0.4};
  }
  return store.scene();
}

void put(test::BareScene& room, const std::vector<std::pair<Vec3, Vec3>>& labels,
         const std::vector<Responsivity>& responses) {
  for (std::size_t k = 0; k < labels.size(); ++k)
    room.label(labels[k].first, normalized(labels[k].second), responses[k % responses.size()]);
}
const std::vector<std::pair<Vec3, Vec3>> places{
    {{1.8, 0.799, 1.0}, {0, -1, 0}},  {{2.4, 0.799, 0.6}, {0, -1, 0}}, {{1.2, 1.401, 1.2}, {0, 1, 0}},
    {{3.8, 3.599, 0.9}, {0, -1, 0}},  {{5, 1, 0.01}, {0, 0, 1}},       {{0.01, 2.8, 1.5}, {1, 0, 0}},
    {{4.2, 2, 1.4}, {-0.6, 0.2, 0.8}}};

// Tilted and rolled units with an emission table that depends on phi; rough glass, coated plastic and brushed
// metal.
Scene lopsided() {
  test::BareScene room;
  const MaterialId paper = room.material(Lambertian{0.6}), floor = room.material(Lambertian{0.3});
  room.box({floor, paper, paper}, {0, 0, 0}, {6, 5, 3});
  room.box(room.material(make_conductor(0.4, 4, make_microfacets(FacetDistribution::ggx, 0.2, 0.5))),
           {0.8, 0.8, 0}, {2.8, 1.4, 1.6});
  room.box(room.material(make_plastic(1.5, 0.5, make_microfacets(FacetDistribution::beckmann, 0.3, 0.3))),
           {3.2, 3.6, 0}, {5.4, 4.2, 1.8});
  room.box(room.material(make_dielectric(1.5, make_microfacets(FacetDistribution::ggx, 0.4, 0.4))),
           {3.4, 1.6, 0.2}, {3.9, 2.6, 1.7});
  put(room, places, {CosineResponse{}});
  const double right = pi / 2;
  const DirectionTable table({0, right / 3, 2 * right / 3, 1.1 * right}, {0, right, 2 * right, 4 * right},
                             {1, 2, 3, 0, 1, 0.5, 0, 0, 1, 1, 0.2, 0.1, 1, 2, 3, 0});
  room.unit({1.2, 1.8, 2.8}, normalized({0.5, 0.3, -1}), EmissionTable{table});
  room.unit({4.6, 2.4, 2.9}, normalized({-0.3, 0.8, -0.6}), EmissionTable{table});
  room.unit({3, 4.5, 2.6}, {0, 0, -1}, SinTwoTheta{1});
  room.scene.transceivers[0].roll_deg = 70;
  room.scene.transceivers[1].roll_deg = -25;
  return room.scene;
}

// Highlights that the control variate contains (GGX), and bases under coats of every kind, one of them black.
// Labels close to the floor see it at grazing angles.
Scene coats() {
  test::BareScene room;
  const auto facets = [](FacetDistribution kind, double roughness) {
    return make_microfacets(kind, roughness, roughness);
  };
  const MaterialId paper = room.material(Lambertian{0.6});
  const MaterialId floor = room.material(make_plastic(1.5, 0.3, facets(FacetDistribution::ggx, 0.2)));
  const MaterialId walls = room.material(make_plastic(1.5, 0.6));
  room.box({floor, paper, walls}, {0, 0, 0}, {6, 5, 3});
  room.box(room.material(make_conductor(1.7, 8.6, facets(FacetDistribution::ggx, 0.3))), {0.8, 0.8, 0},
           {2.8, 1.4, 1.6});
  room.box(room.material(make_plastic(1.8, 0, facets(FacetDistribution::ggx, 0.5))), {3.2, 3.6, 0},
           {5.4, 4.2, 1.8});
  room.box(room.material(make_plastic(1.5, 0.7, facets(FacetDistribution::beckmann, 0.3))), {3.4, 1.6, 0.2},
           {3.9, 2.6, 1.7});
  put(room, places, {CosineResponse{}});
  room.label({3, 0.01, 0.15}, {0, 1, 0}, CosineResponse{});
  room.label({5.99, 2.5, 0.3}, {-1, 0, 0}, CosineResponse{}, {0.2, 0.1});
  room.unit({1.2, 1.8, 2.8}, {0, 0, -1}, SinTwoTheta{1});
  room.unit({4.6, 2.4, 2.9}, normalized({-0.3, 0.4, -0.6}), IsotropicHemisphere{0.6});
  room.unit({5.8, 4.6, 2.6}, {0, 0, -1}, SinTwoTheta{1});
  return room.scene;
}

Scene other_devices() {
  test::BareScene room;
  const MaterialId paper = room.material(Lambertian{0.7}), floor = room.material(Lambertian{0.4});
  room.box({floor, paper, paper}, {0, 0, 0}, {6, 5, 3});
  room.box(paper, {0.8, 0.8, 0}, {2.8, 1.4, 1.6});
  room.box(floor, {3.2, 3.6, 0}, {5.4, 4.2, 1.8});
  put(room, places,
      {CosinePowerResponse{2.5, 60 * pi / 180}, ResponseTable{{{0, 0.3, 0.7, 1.3}, {0}, {1, 0.9, 0.3, 0.1}}},
       CosineResponse{}});
  room.unit({1.2, 1.8, 2.8}, {0, 0, -1}, GeneralizedLambertian{2, 3});
  room.unit({4.6, 2.4, 2.9}, normalized({-0.3, 0.4, -0.6}), IsotropicHemisphere{0.6});
  room.unit({3, 4.5, 2.6}, {0, 0, -1}, GeneralizedLambertian{1, 3});
  room.unit({5, 0.5, 2.6}, {0, 0, -1}, IsotropicHemisphere{0.3});
  return room.scene;
}

// Labels and goods on both sides of doors that absorb less than half of the light; everything else is
// Lambertian.
Scene dark_doors() {
  test::BareScene room;
  const MaterialId paper = room.material(Lambertian{0.7}), floor = room.material(Lambertian{0.4});
  room.box({floor, paper, paper}, {0, 0, 0}, {6, 5, 3});
  room.box(paper, {0.8, 0.8, 0}, {2.8, 1.4, 1.6});
  room.box(floor, {3.2, 3.6, 0}, {5.4, 4.2, 1.8});
  const MaterialId door = room.material(ThinDielectric{4, 0.004, 50});
  room.quad(door, {0.6, 1.7, 0}, {2.4, 0, 0}, {0, 0, 1.8});
  room.quad(door, {3.2, 3.2, 0}, {2.4, 0, 0}, {0, 0, 1.8});
  for (int k = 0; k < 4; ++k) {
    room.label({1 + 0.5 * k, 1.401, 0.4 + 0.3 * k}, {0, 1, 0});
    room.label({3.4 + 0.5 * k, 3.599, 1.4 - 0.3 * k}, {0, -1, 0});
    room.label({3.4 + 0.5 * k, 2.2, 0.6}, {0, 0.8, 0.6});
  }
  room.unit({1.2, 1.8, 2.8}, {0, 0, -1}, SinTwoTheta{1});
  room.unit({4.6, 2.4, 2.9}, {0, 0, -1}, GeneralizedLambertian{1, 3});
  room.unit({5.6, 3.4, 2.6}, {0, 0, -1}, SinTwoTheta{1});
  return room.scene;
}

// An emitting board in the middle of the room, optionally with units (points or discs) beside it.
Scene lamp(bool units, double radius) {
  test::BareScene room;
  const MaterialId paper = room.material(Lambertian{0.7}), floor = room.material(Lambertian{0.4});
  room.box({floor, paper, paper}, {0, 0, 0}, {6, 5, 3});
  room.box(room.material(Conductor{0.2, 6, {}}), {0.8, 0.8, 0}, {2.8, 1.4, 1.6});
  room.box(room.material(make_plastic(1.5, 0.5, make_microfacets(FacetDistribution::ggx, 0.4, 0.4))),
           {3.2, 3.6, 0}, {5.4, 4.2, 1.8});
  const MaterialId board = room.material(Lambertian{0.5});
  room.quad(board, {2.5, 2, 2.3}, {1.2, 0, 0}, {0, 0.6, 0});
  room.shines(board, 2);
  put(room, places, {CosineResponse{}});
  room.label({3, 1.1, 2.0}, {0, 0, -1}, CosineResponse{}, {0.5, 0.3});
  if (!units) room.scene.labels.pop_back();
  if (units) {
    room.unit({1.2, 1.8, 2.8}, {0, 0, -1}, SinTwoTheta{1}, radius);
    room.unit({4.6, 2.4, 2.9}, normalized({-0.3, 0.4, -0.6}), IsotropicHemisphere{0.3}, radius);
  }
  return room.scene;
}

// The samples of both sides, the root mean square error of the differences over all entries, and the factor
// of the control.
struct Effort {
  std::uint32_t reuse;  // multiplied by 32 batches
  std::uint64_t samples;
  double largest_error, wrong;
};

struct Store {
  const char* name;
  Scene (*scene)();
  test::Way reference;
  Effort effort;
};

// Errors are 2 to 13 % for typical entries. The most precise entries clearly reject the controls.
const Store stores[] = {{"DiffuseAndGlossy", glossy, test::nee, {4, 20000, 0.03, 1.04}},
                        {"MirrorPaneAndGlassWithDiscsAndRectangles",
                         [] { return glass(true); },
                         test::mis,
                         {2, 6000, 0.13, 1.12}},
                        {"LopsidedUnitsAndRoughThings", lopsided, test::nee, {8, 25000, 0.12, 1.09}},
                        {"Coats", coats, test::nee, {4, 25000, 0.07, 1.07}}};

// The same stores with errors of 2 to 7 %, and others.
const Store precise_stores[] = {
    {"DiffuseAndGlossy", glossy, test::nee, {18, 110000, 0.022, 1.025}},
    {"MirrorPaneAndGlassWithPoints", [] { return glass(false); }, test::nee, {8, 30000, 0.04, 1.04}},
    {"MirrorPaneAndGlassWithDiscsAndRectangles",
     [] { return glass(true); },
     test::mis,
     {16, 60000, 0.07, 1.07}},
    {"LopsidedUnitsAndRoughThings", lopsided, test::nee, {60, 220000, 0.06, 1.05}},
    {"Coats", coats, test::nee, {18, 130000, 0.045, 1.05}},
    {"DarkDoors", dark_doors, test::nee, {16, 50000, 0.045, 1.05}},
    {"OtherUnitsAndResponses", other_devices, test::nee, {16, 100000, 0.03, 1.03}},
    {"ShiningBoard", [] { return lamp(false, 0); }, test::mis, {16, 30000, 0.045, 1.08}},
    {"ShiningBoardAndPoints", [] { return lamp(true, 0); }, test::mis, {16, 50000, 0.045, 1.05}},
    {"ShiningBoardAndDiscs", [] { return lamp(true, 0.3); }, test::mis, {16, 50000, 0.05, 1.08}}};

// Tests all entries together at 0.1 %.
void expect_agreement(const Store& store) {
  const Scene scene = store.scene();
  const Effort& effort = store.effort;
  const test::Comparison entries =
      test::compare(test::path_reuse.simulate(scene, effort.reuse * test::reuse_samples),
                    store.reference.simulate(scene, effort.samples, 77, {.direct = DirectLight::exact}));
  EXPECT_TRUE(entries.agrees(0.001));
  double squares = 0;
  for (std::size_t k = 0; k < entries.values.size(); ++k)
    squares += std::pow(entries.standard_errors[k] / entries.references[k], 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(entries.values.size())), effort.largest_error);
  EXPECT_FALSE(entries.with_references_times(effort.wrong).agrees(0.001));
}

void PrintTo(const Store& store, std::ostream* to) {  // NOLINT(readability-identifier-naming): GoogleTest's
  *to << store.name;
}
class ReuseAgreement : public testing::TestWithParam<Store> {};
class ReuseAgreementSlow : public testing::TestWithParam<Store> {};

TEST_P(ReuseAgreement, WithStrategies) {
  expect_agreement(GetParam());
}
TEST_P(ReuseAgreementSlow, WithStrategies) {
  expect_agreement(GetParam());
}
const auto name_of = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(In, ReuseAgreement, testing::ValuesIn(stores), name_of);
INSTANTIATE_TEST_SUITE_P(In, ReuseAgreementSlow, testing::ValuesIn(precise_stores), name_of);

}  // namespace
}  // namespace shelfbeam::physics::reuse_agreement
