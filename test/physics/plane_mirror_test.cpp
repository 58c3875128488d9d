// By way of a flat mirror a label sees the image of a unit: I R(label) F / d^2, where d is the length of the
// mirror path and F is the Fresnel reflectance. The label faces away from the unit itself. The whole scene is
// tilted, so that no axis of the world is special.

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "shelfbeam/material/optics/fresnel.hpp"
#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/random.hpp"

#include "physics/bare_scene.hpp"
#include "physics/comparison.hpp"
#include "physics/disc_light.hpp"

namespace shelfbeam::physics::plane_mirror {
namespace {

using test::Way;

const Conductor ideal{0, 1, {}}, gold{0.2, 6.5, {}};
const Frame tilted = Frame::about(normalized({0.3, -0.5, 0.8}));
const Vec3 origin{1, 2, 3};

// Points and directions are given in a frame in which the mirror is the plane z = 0.
Vec3 place(const Vec3& p) {
  return origin + tilted.to_world(p);
}

struct Stage {
  test::BareScene bare;

  Stage() = default;
  // A mirror 2 m long and 1 m wide in front of a unit.
  explicit Stage(const Material& mirror, double disc_radius = 0) {
    quad(bare.material(mirror), {-0.5, -0.5, 0}, {2, 0, 0}, {0, 1, 0});
    unit({0, 0, 1.2}, disc_radius);
  }
  void quad(MaterialId surface, const Vec3& corner, const Vec3& right, const Vec3& up) {
    bare.quad(surface, place(corner), tilted.to_world(right), tilted.to_world(up));
  }
  void unit(const Vec3& p, double radius = 0) {
    bare.unit(place(p), -tilted.z, GeneralizedLambertian{1, 1}, radius);
  }
  void label(const Vec3& p, std::array<double, 2> size = {}) {
    bare.label(place(p), -tilted.z, CosineResponse{}, size);
  }
};

double image(const Vec3& label, const Vec3& unit, const Conductor& mirror, double mirror_height = 0) {
  const Vec3 way{label.x - unit.x, label.y - unit.y, label.z + unit.z - 2 * mirror_height};
  const double cosine = way.z / length(way);
  return cosine / pi * cosine / length_squared(way) * fresnel_conductor(cosine, mirror.eta, mirror.k);
}

// The mean over a label of 0.3 x 0.2 m that faces down to the mirror, by 5 x 5 midpoints. Its sides are
// parallel to the horizontal plane of the world.
constexpr std::array<double, 2> label_size{0.3, 0.2};
template <class Value>
double over_label(const Vec3& middle, const Value& value) {
  const Frame label = Frame::of_surface(-tilted.z);
  double sum = 0;
  for (int i = -2; i <= 2; ++i)
    for (int k = -2; k <= 2; ++k)
      sum += value(middle +
                   tilted.to_local(label.x * (label_size[0] * i / 5) + label.y * (label_size[1] * k / 5)));
  return sum / 25;
}

const std::vector<Vec3> seeing{{0.4, 0.1, 0.6}, {1.8, -0.3, 0.9}, {-0.2, 0.4, 0.8}};

// Exact within the rounding of single precision, 1e-6, in the layer of one bounce and without a standard
// error. The control is the reflectance of the other metal.
TEST(PlaneMirror, ShowsTheImageOfAPointExactly) {
  for (const auto& [mirror, other] : {std::pair(ideal, gold), std::pair(gold, ideal)}) {
    Stage stage(mirror);
    for (const Vec3& p : seeing) stage.label(p);
    for (const Way& way : {test::nee, test::mis, test::particle}) {
      const SignalMatrix matrix = way.simulate(
          stage.bare.scene, 64, 1, {.direct = DirectLight::exact, .max_bounces = 3, .by_bounce = true});
      for (std::size_t i = 0; i < seeing.size(); ++i) {
        EXPECT_NEAR(matrix.by_bounce[1].mean[i] / image(seeing[i], {0, 0, 1.2}, mirror), 1, 1e-6) << way.name;
        EXPECT_GT(std::abs(matrix.by_bounce[1].mean[i] / image(seeing[i], {0, 0, 1.2}, other) - 1), 0.01);
        EXPECT_EQ(matrix.standard_error[i], 0);
        EXPECT_EQ(matrix.mean[i], matrix.by_bounce[1].mean[i]);
        EXPECT_EQ(matrix.direct[i], 0);
      }
      EXPECT_EQ(way.simulate(stage.bare.scene, 64, 1, {.max_bounces = 0}).mean[0], 0);
    }
  }
}

// The same by sampling: z-test at 0.1 %, relative standard error 1.5 %, with three units, so that the walk
// must choose one. The control is off by 5 %.
TEST(PlaneMirror, ShowsTheImagesOfPointsToConnections) {
  const std::vector<Vec3> units{{0, 0, 1.2}, {0.8, 0.2, 1.6}, {0.5, -0.4, 1.1}};
  Stage stage(gold);
  stage.unit(units[1]);
  stage.unit(units[2]);
  for (const Vec3& p : seeing) stage.label(p);
  for (const Way& way : {test::nee, test::mis}) {
    const SignalLayer layer =
        way.simulate(stage.bare.scene, 20000, 1, {.max_bounces = 2, .by_bounce = true}).by_bounce[1];
    test::Comparison found;
    for (std::size_t i = 0; i < seeing.size(); ++i)
      for (std::size_t j = 0; j < units.size(); ++j) {
        const std::size_t entry = i * units.size() + j;
        found.add(layer.mean[entry], image(seeing[i], units[j], gold), layer.standard_error[entry]);
      }
    test::expect_agreement(found, 0.015, 1.05, way.name);
  }
}

// Discs over an ideal mirror: the result is the direct light of the disc's image (disc_light.hpp). z-test at
// 0.1 %. If connections find the image, relative standard errors are 0.2 % and the control is off by 1.5 %.
// If walks hit the disc and particles the label at random, these are 2.5 % and 10 %. The reading of a label
// with a size is the mean over 5 x 5 midpoints of the rectangle (error below 0.1 %).
TEST(PlaneMirror, ShowsTheImageOfADisc) {
  constexpr double radius = 0.1;
  const auto expect = [](const Way& way, bool by_chance, const SignalMatrix& matrix,
                         const std::vector<double>& expected) {
    test::Comparison found;
    for (std::size_t i = 0; i < expected.size(); ++i)
      found.add(matrix.mean[i], expected[i], std::hypot(matrix.standard_error[i], 1e-3 * expected[i]));
    test::expect_agreement(found, by_chance ? 0.025 : 0.002, by_chance ? 1.1 : 1.015, way.name);
  };
  const auto image_of_disc = [](const Vec3& p) {
    return test::irradiance_of_disc(1, radius, {0, 0, 1.2}, {p.x, p.y, -p.z}, {0, 0, 1});
  };
  Stage points(ideal, radius), rectangles(ideal, radius);
  std::vector<double> at_points, over_rectangles;
  for (const Vec3& p : {Vec3{0.4, 0.1, 0.6}, Vec3{-0.2, 0.4, 0.8}}) {
    points.label(p);
    at_points.push_back(image_of_disc(p));
  }
  expect(test::walk, true, test::walk.simulate(points.bare.scene, 1500000), at_points);
  for (const Way& way : {test::nee, test::mis})
    expect(way, false, way.simulate(points.bare.scene, 20000), at_points);
  expect(test::particle, false, test::particle.simulate(points.bare.scene, 2000), at_points);

  for (const Vec3& p : {Vec3{0.4, 0.1, 0.6}, Vec3{0.1, 0.1, 0.8}}) {
    rectangles.label(p, label_size);
    over_rectangles.push_back(over_label(p, image_of_disc));
  }
  expect(test::mis, false, test::mis.simulate(rectangles.bare.scene, 20000), over_rectangles);
  expect(test::particle, true, test::particle.simulate(rectangles.bare.scene, 1000000), over_rectangles);
}

// Exact as above, or zero if a box, the back of the mirror, or a point of its plane outside the mirror blocks
// the mirror path.
TEST(PlaneMirror, ShowsNothingOutsideItsWindow) {
  Stage stage(ideal);
  const MaterialId black = stage.bare.material(Lambertian{0});
  // A post beside the unit's foot, which blocks only the path to the second label.
  stage.quad(black, {0.4, -0.5, 0}, {0, 0.5, 0}, {0, 0, 0.7});
  const std::vector<Vec3> labels{{0.8, 0.6, 0.8},    // over (0.48, 0.36): passes beside the post
                                 {0.8, -0.4, 0.8},   // over (0.48, -0.24): behind the post
                                 {-1.2, 0, 0.8},     // over (-0.72, 0), beyond the edge
                                 {0.4, 0.1, -0.6}};  // below the mirror
  for (const Vec3& p : labels) stage.label(p);
  for (const Way& way : {test::nee, test::mis, test::particle})
    for (const DirectLight direct : {DirectLight::exact, DirectLight::sampled}) {
      const SignalMatrix matrix = way.simulate(stage.bare.scene, 320, 1, {.direct = direct});
      EXPECT_NEAR(matrix.mean[0] / image(labels[0], {0, 0, 1.2}, ideal), 1, 1e-6) << way.name;
      for (std::size_t i = 1; i < labels.size(); ++i) EXPECT_EQ(matrix.mean[i], 0) << way.name << i;
    }
}

// A unit that is mounted on the mirror itself, within rounding, and faces away from it has no image. Many
// rotations put it in front of the plane or behind it by rounding. The control is a little off the plane and
// emits to all sides.
TEST(PlaneMirror, ShowsNothingOfAUnitOnIt) {
  for (std::uint32_t turn = 0; turn < 24; ++turn) {
    const auto u = philox({turn, 0, 0, 0}, 77);
    const Frame frame =
        Frame::about(normalized({to_uniform(u[0]) - 0.5, to_uniform(u[1]) - 0.5, to_uniform(u[2]) - 0.5}));
    const auto with_unit = [&](double height, const Vec3& axis) {
      test::BareScene bare;
      bare.quad(bare.material(ideal), origin - frame.x - frame.y, frame.x * 2, frame.y * 2);
      bare.unit(origin + frame.to_world({0.1, 0.2, height}), frame.to_world(axis), IsotropicHemisphere{1});
      bare.label(origin + frame.to_world({0.3, 0, 1}), -frame.z);
      return test::mis.simulate(bare.scene, 64, 1, {.direct = DirectLight::exact});
    };
    const SignalMatrix on = with_unit(0, {0, 0, 1}), off = with_unit(0.01, {1, 0, 0});
    EXPECT_EQ(on.mean[0], on.direct[0]) << turn;
    EXPECT_GT(off.mean[0], 1.5F * off.direct[0]) << turn;
  }
}

// A mirror that does not fill its bounding box.
TEST(PlaneMirror, EndsAtItsTriangles) {
  test::BareScene bare;
  bare.triangle(bare.material(ideal), {place({-1, -1, 0}), place({1, -1, 0}), place({-1, 1, 0})});
  bare.unit(place({0, 0, 1}), -tilted.z, GeneralizedLambertian{1, 1});
  const Vec3 inside{-0.6, -0.2, 1}, outside{0.6, 0.2, 1};
  for (const Vec3& p : {inside, outside}) bare.label(place(p), -tilted.z);
  const SignalMatrix matrix = test::mis.simulate(bare.scene, 64, 1, {.direct = DirectLight::exact});
  EXPECT_NEAR(matrix.mean[0] / image(inside, {0, 0, 1}, ideal), 1, 1e-6);
  EXPECT_EQ(matrix.mean[1], 0);
}

// A pane over the mirror dims the mirror's image twice and shows an image of its own. Exact within 1e-6.
TEST(PlaneMirror, WorksBehindAPane) {
  const ThinDielectric pane{1.5, 0.004, 20};
  constexpr double height = 0.3;
  Stage stage(gold);
  stage.quad(stage.bare.material(pane), {-1, -1, height}, {3, 0, 0}, {0, 2, 0});
  const Vec3 label{0.4, 0.1, 0.6}, unit{0, 0, 1.2};
  stage.label(label);
  const auto cosine = [&](double mirror_height) {
    const Vec3 way{label.x - unit.x, label.y - unit.y, label.z + unit.z - 2 * mirror_height};
    return way.z / length(way);
  };
  const double through = image(label, unit, gold) * std::pow(pane_transmittance(pane, cosine(0)), 2);
  const double own = image(label, unit, ideal, height) * pane_shares(pane, cosine(height)).reflected;
  for (const Way& way : {test::nee, test::mis, test::particle}) {
    const SignalMatrix matrix = way.simulate(stage.bare.scene, 64, 1, {.max_bounces = 1});
    EXPECT_NEAR(matrix.mean[0] / (through + own), 1, 1e-6) << way.name;
  }
  // Controls: each part counts.
  EXPECT_GT(own, 0.01 * through);
  EXPECT_LT(own, through);
}

// A large mirror and a large pane below a black ceiling. Light is reflected back and forth between them.
struct Stack {
  static constexpr double pane_height = 0.3;
  const ThinDielectric pane{2.5, 0.004, 10};
  Stage stage;

  explicit Stack(double ceiling) {
    const MaterialId black = stage.bare.material(Lambertian{0});
    stage.quad(stage.bare.material(gold), {-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
    stage.quad(stage.bare.material(pane), {-9, -9, pane_height}, {18, 0, 0}, {0, 18, 0});
    stage.quad(black, {-9, -9, ceiling}, {18, 0, 0}, {0, 18, 0});
  }

  // The share of light that remains at this angle after `trips` more round trips between mirror and pane.
  double share(double cosine, int trips) const {
    const auto [reflected, transmitted] = pane_shares(pane, cosine);
    return transmitted * transmitted * std::pow(reflected, trips) *
           std::pow(fresnel_conductor(cosine, gold.eta, gold.k), trips + 1);
  }
};

// The first bounce contains the images in mirror and pane, the third the mirror's image after one more round
// trip. z-test at 0.1 %, with relative standard errors below 4 %; the control is off by 10 %.
void expect_images(const SignalMatrix& matrix, const std::vector<std::array<double, 2>>& expected,
                   const char* what) {
  test::Comparison found;
  for (std::size_t j = 0; j < expected.size(); ++j)
    for (std::size_t trips = 0; trips < 2; ++trips) {
      const SignalLayer& layer = matrix.by_bounce[2 * trips + 1];
      found.add(layer.mean[j], expected[j][trips],
                std::hypot(layer.standard_error[j], 1e-3 * expected[j][trips]));
      EXPECT_EQ(matrix.by_bounce[2 * trips].mean[j], 0) << what;
    }
  test::expect_agreement(found, 0.04, 1.1, what);
}

// Two coaxial discs on the label's axis, one in front of it (facing away) and one behind it.
TEST(PlaneMirror, ShowsDiscsManyTimesBehindAPane) {
  constexpr double label = 1, units[] = {0.8, 1.1}, radii[] = {0.7, 1};
  Stack stack(1.2);
  stack.stage.label({0, 0, label});
  std::vector<std::array<double, 2>> expected(2);
  for (std::size_t j = 0; j < 2; ++j) {
    stack.stage.unit({0, 0, units[j]}, radii[j]);
    for (int trips = 0; trips < 2; ++trips)
      expected[j][static_cast<std::size_t>(trips)] =
          test::irradiance_of_coaxial_disc(1, radii[j], units[j] + label + 2 * trips * Stack::pane_height,
                                           [&](double cosine) { return stack.share(cosine, trips); });
    expected[j][0] += test::irradiance_of_coaxial_disc(
        1, radii[j], units[j] + label - 2 * Stack::pane_height,
        [&](double cosine) { return pane_shares(stack.pane, cosine).reflected; });
  }
  for (const Way& way : {test::walk, test::mis})
    expect_images(way.simulate(stack.stage.bare.scene, 200000, 1, {.max_bounces = 3, .by_bounce = true}),
                  expected, way.name);
}

// A point and a rectangle, whose particles cover the same paths.
TEST(PlaneMirror, ShowsARectangleToParticlesManyTimesBehindAPane) {
  const Vec3 label{0.1, 0.05, 1}, unit{0, 0, 1.04};
  Stack stack(1.05);
  stack.stage.label(label, label_size);
  stack.stage.unit(unit);
  std::vector<std::array<double, 2>> expected(1);
  const auto image_at = [&](const Vec3& p, double further, const auto& share) {
    const Vec3 way{p.x - unit.x, p.y - unit.y, p.z + unit.z + further};
    const double cosine = way.z / length(way);
    return cosine / pi * cosine / length_squared(way) * share(cosine);
  };
  for (int trips = 0; trips < 2; ++trips)
    expected[0][static_cast<std::size_t>(trips)] = over_label(label, [&](const Vec3& p) {
      return image_at(p, 2 * trips * Stack::pane_height,
                      [&](double cosine) { return stack.share(cosine, trips); });
    });
  expected[0][0] += over_label(label, [&](const Vec3& p) {
    return image_at(p, -2 * Stack::pane_height,
                    [&](double cosine) { return pane_shares(stack.pane, cosine).reflected; });
  });
  expect_images(
      test::particle.simulate(stack.stage.bare.scene, 2000000, 1, {.max_bounces = 3, .by_bounce = true}),
      expected, "particle");
}

}  // namespace
}  // namespace shelfbeam::physics::plane_mirror
