// Compares the signals of a room with glass in contact with those of the same room with gaps of 1 mm, for
// both estimators. The control expects a tenth more; jumping over contacts changed signals by a fifth to a
// half.

#include <cmath>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

#include "physics/bare_scene.hpp"
#include "physics/comparison.hpp"

namespace shelfbeam::physics::contact {
namespace {

/// A room with a jar on a table, two blocks of glass, a block on a glass shelf, a poster on a glass door, and
/// a double pane. `gap` separates them.
Scene room(double gap) {
  test::BareScene bare;
  const MaterialId wall = bare.material(Lambertian{0.6}), wood = bare.material(Lambertian{0.9}),
                   paper = bare.material(Lambertian{0.3}), glass = bare.material(make_dielectric(1.5)),
                   pane = bare.material(make_thin_dielectric(1.5, 0.004, 0));
  bare.box(wall, {0, 0, 0}, {6, 4, 3});
  bare.box(wood, {0.4, 0.4, 0}, {1.6, 1.6, 0.8});
  bare.box(glass, {0.5, 0.5, 0.8 + gap}, {1.5, 1.5, 1.2});
  bare.label({1, 1, 1.3}, {0, 0, -1});
  bare.box(glass, {2.2, 0.5, 0.8}, {3.2, 1.5, 1.2});
  bare.box(glass, {2.2, 0.5, 1.2 + gap}, {3.2, 1.5, 1.5});
  bare.label({2.7, 1, 0.6}, {0, 0, 1});
  bare.quad(pane, {3.9, 0.4, 0.8}, {1.2, 0, 0}, {0, 1.2, 0});
  bare.box(glass, {4, 0.5, 0.8 + gap}, {5, 1.5, 1.2});
  bare.label({4.5, 1, 0.6}, {0, 0, 1});
  bare.quad(pane, {0.3, 3, 0.2}, {2, 0, 0}, {0, 0, 2.6});
  bare.quad(paper, {0.3, 3 + std::abs(gap), 0.2}, {2, 0, 0}, {0, 0, 2.6});
  bare.label({1.3, 2.7, 1.5}, {0, 1, 0});
  bare.label({1.3, 3.5, 1.5}, {0, -1, 0});
  bare.quad(pane, {3.5, 3, 0.2}, {2, 0, 0}, {0, 0, 2.6});
  bare.quad(pane, {3.5, 3 + std::abs(gap), 0.2}, {2, 0, 0}, {0, 0, 2.6});
  bare.label({4.5, 3.6, 1.5}, {0, -1, 0});
  bare.label({2.7, 1, 1.5 + gap}, {0, 0, -1});
  bare.label({5 + gap, 1, 1}, {-1, 0, 0});
  bare.unit({2.8, 2.2, 2.9}, {0, 0, -1}, GeneralizedLambertian{1, 10});
  return bare.scene;
}

// Four tests at level 0.001; the fixed seeds make them reproducible. Particles do not find points behind
// solid glass.
TEST(SlowContact, CountsLikeSurfacesApart) {
  const SignalMatrix expected = test::mis.simulate(room(0.001), 100'000, 7);
  for (const auto& [way, samples] :
       {std::pair{test::path_reuse, std::uint64_t{5'000}}, std::pair{test::mis, std::uint64_t{50'000}}}) {
    const auto agrees = [&, &way = way, samples = samples](double gap, std::uint64_t seed,
                                                           double factor = 1) {
      return test::compare(way.simulate(room(gap), samples, seed), expected, factor).agrees(0.001);
    };
    EXPECT_TRUE(agrees(0, 1)) << way.name;
    EXPECT_TRUE(agrees(-4e-6, 2)) << way.name;
    EXPECT_FALSE(agrees(0, 1, 1.1)) << way.name;
  }
}

}  // namespace
}  // namespace shelfbeam::physics::contact
