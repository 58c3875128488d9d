// Path reuse against what is known without any simulation, or from others'.

#include <cmath>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "physics/bare_scene.hpp"
#include "physics/comparison.hpp"
#include "physics/reuse_matrix.hpp"

namespace shelfbeam {
namespace {

// In a closed room of uniform albedo all reflected light is incident again: rho Phi / (1 - rho) in all. Over
// 10 x 10 cells a wall by the midpoint rule, without the direct light, which labels 0.1 mm from the wall see
// in the place of a mean over their cells. Errors of 0.15 % at most and of the midpoint rule, 0.1 %. The
// control is an albedo 1 % off.
TEST(ReuseClosedForms, EverythingThatEntersTheRoomIsAbsorbed) {
  constexpr double rho = 0.7;
  constexpr int cells = 10;
  const Vec3 size{5, 4, 3};
  test::BareScene room;
  room.box(room.material(Lambertian{rho}), {0, 0, 0}, size);
  room.unit({2.2, 1.7, 2.1}, {0, 0, -1}, SinTwoTheta{1});
  std::vector<double> areas;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      for (int i = 0; i < cells; ++i)
        for (int k = 0; k < cells; ++k) {
          std::array<double, 3> p{}, n{};
          const auto at = [&](int d) { return static_cast<std::size_t>(d); };
          p[at(axis)] = far ? size[axis] - 1e-4 : 1e-4;
          p[at(a)] = (i + 0.5) * size[a] / cells;
          p[at(b)] = (k + 0.5) * size[b] / cells;
          n[at(axis)] = far ? -1 : 1;
          room.label({p[0], p[1], p[2]}, {n[0], n[1], n[2]});
          areas.push_back(size[a] * size[b] / (cells * cells));
        }
    }
  const World world(room.scene);
  const ReuseEstimator estimator(world, 4);
  Moments flux;
  for (std::uint32_t b = 0; b < 2 * batch_count; ++b) {
    const std::vector<double> batch = test::batch_of(estimator, areas.size(), 1, b);
    double sum = 0;
    for (std::size_t i = 0; i < areas.size(); ++i) sum += areas[i] * batch[i];
    flux.add(sum);
  }
  const auto expected = [](double albedo) { return 4 * pi / 3 * albedo / (1 - albedo); };
  test::Comparison right, wrong;
  const double error = std::hypot(flux.standard_error(), 1e-3 * expected(rho));
  EXPECT_LT(flux.standard_error() / flux.mean(), 1.5e-3);
  right.add(flux.mean(), expected(rho), error);
  wrong.add(flux.mean(), expected(1.01 * rho), error);
  EXPECT_TRUE(right.agrees(0.001));
  EXPECT_FALSE(wrong.agrees(0.001));
}

// A sphere of uniform albedo is uniformly lit by what it reflects: rho / (1 - rho) Phi / A, wherever the
// units are, which the labels in the middle of wall triangles do not see here.
void check_sphere(std::uint32_t factor, double largest_error) {
  constexpr double rho = 0.7;
  const auto uniform = [](double albedo, double flux, double area) {
    return albedo / (1 - albedo) * flux / area;
  };
  test::BareScene room;
  room.sphere(room.material(Lambertian{rho}), 2, 5);
  room.unit({0.5, 0.3, -0.4}, normalized({1, 2, -1}), IsotropicHemisphere{0.25});
  room.unit({-0.7, 0.2, 0.6}, {0, 0, -1}, GeneralizedLambertian{1, 2});
  const TriangleMesh& mesh = room.scene.mesh;
  for (std::size_t part = 1; part < 20; part += 2) {
    const auto& [a, b, c] = mesh.triangles[part * mesh.triangles.size() / 20];
    const Vec3 middle = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
    room.label(middle * (1 - 1e-5), -normalized(middle));
  }
  const World world(room.scene);
  const std::vector<double> known = test::known_light(world);
  const SignalMatrix matrix = test::reuse(room.scene, factor);
  test::Comparison right, wrong;
  for (std::size_t i = 0; i < matrix.rows(); ++i)
    for (std::size_t j = 0; j < matrix.columns(); ++j) {
      const std::size_t e = matrix.at(i, j);
      const double flux = power(room.scene.transceiver_types[j].emission), area = room.mesh_area();
      right.add(matrix.mean[e] - known[e], uniform(rho, flux, area), matrix.standard_error[e]);
      wrong.add(matrix.mean[e] - known[e], uniform(1.02 * rho, flux, area), matrix.standard_error[e]);
    }
  EXPECT_TRUE(right.agrees(0.001));
  EXPECT_LT(right.precision(), largest_error);
  EXPECT_FALSE(wrong.agrees(0.001));
}

// Inside a sphere that shines with L all over, pi L / (1 - a) everywhere; so, too, with glass, a pane and a
// mirror in it that lose nothing.
void check_furnace(std::uint32_t factor, double largest_error) {
  constexpr double albedo = 0.6, radiance = 1.5;
  const auto reading = [](double a) { return pi * radiance / (1 - a); };
  for (const bool clear_things : {false, true}) {
    test::BareScene room;
    const MaterialId wall = room.material(Lambertian{albedo});
    room.sphere(wall, 1.5, 4);
    room.shines(wall, radiance);
    room.label({0.4, -0.5, 0.3}, {0, 0, 1});
    room.label({-0.6, 0.2, -0.5}, normalized({1, -2, 0.5}));
    room.label({0.75, 0.6, 0.1}, {-1, 0, 0}, CosineResponse{}, {0.2, 0.1});
    if (clear_things) {
      room.box(room.material(Dielectric{1.5, {}}), {-0.2, 0.35, -0.3}, {0.5, 0.7, 0.5});
      room.quad(room.material(ThinDielectric{1.5, 0.006, 0}), {-0.1, -0.7, -0.6}, {0.5, 0.3, 0}, {0, 0.2, 1});
      room.quad(room.material(Conductor{0, 1, {}}), {0.5, -0.3, -0.6}, {0.1, 0.6, 0}, {0, 0, 0.9});
    }
    test::Comparison readings;
    readings.add_column(test::reuse(room.scene, factor), 0, reading(albedo));
    EXPECT_TRUE(readings.agrees(0.001));
    EXPECT_LT(readings.precision(), largest_error);
    EXPECT_FALSE(readings.with_references_times(reading(1.02 * albedo) / reading(albedo)).agrees(0.001));
  }
}

// Twelve totals of two independent simulators in an empty room of 10 x 8 x 4 m (test/data/room_s1).
void check_room_s1(std::uint32_t factor, double largest_error) {
  const std::filesystem::path folder = std::filesystem::path(SHELFBEAM_SOURCE_DIR) / "test/data/room_s1";
  const JsonCursor json = JsonCursor::parse_file(folder / "reference.json");
  const auto compare = [&](const JsonCursor& reference, double albedo_factor) {
    Store store = read_store(folder / "store.json");
    std::get<Lambertian>(store.materials[0].material).reflectance *= albedo_factor;
    const SignalMatrix matrix = test::reuse(make_scene(store), factor);
    const std::vector<double> total = reference["E_total"].numbers(), error = reference["stderr"].numbers();
    test::Comparison result;
    for (std::size_t i = 0; i < matrix.rows(); ++i)
      result.add(matrix.mean[i], total[i], std::hypot(matrix.standard_error[i], error[i]));
    return result;
  };
  for (const JsonCursor& reference : {json, json["radiance"]}) {
    const test::Comparison found = compare(reference, 1);
    EXPECT_TRUE(found.agrees(0.001));
    EXPECT_LT(found.precision(), largest_error);
    EXPECT_FALSE(compare(reference, 1.02).agrees(0.001));
  }
}

// The classic infrared room of infrared_room_test.cpp: its figure for up to 12 bounces, and what walks find
// from there on (0.5 %, itself known to a few per cent of that).
void check_infrared_room(std::uint32_t factor, double largest_error) {
  constexpr double up_to_12_bounces = 2.949, its_error = 1e-3, microwatt = 1e6 * 1e-4;
  const auto total = [&](double albedo_factor, double cutoff_deg) {
    test::BareScene room;
    const MaterialId bright = room.material(Lambertian{0.8 * albedo_factor}),
                     floor = room.material(Lambertian{0.3 * albedo_factor});
    room.box({floor, bright, bright}, {0, 0, 0}, {5, 5, 3});
    room.unit({2.5, 2.5, 3}, {0, 0, -1}, GeneralizedLambertian{1, 1});
    room.label({0.5, 1, 0}, {0, 0, 1}, CosinePowerResponse{1, cutoff_deg * pi / 180});
    return room;
  };
  const SignalMatrix layers =
      test::nee.simulate(total(1, 85).scene, 100000, 1, {.max_bounces = 40, .by_bounce = true});
  double rest = 0;
  for (std::size_t k = 13; k <= 40; ++k) rest += static_cast<double>(layers.by_bounce[k].mean[0]) * microwatt;
  const auto compare = [&](double albedo_factor, double cutoff_deg) {
    const SignalMatrix matrix = test::reuse(total(albedo_factor, cutoff_deg).scene, factor);
    test::Comparison result;
    result.add(static_cast<double>(matrix.mean[0]) * microwatt, up_to_12_bounces + rest,
               std::hypot(static_cast<double>(matrix.standard_error[0]) * microwatt, its_error, 0.05 * rest));
    return result;
  };
  const test::Comparison found = compare(1, 85);
  EXPECT_TRUE(found.agrees(0.001));
  EXPECT_LT(found.precision(), largest_error);
  EXPECT_FALSE(compare(1.02, 85).agrees(0.001));
}

TEST(ReuseClosedForms, SphereIsUniform) {
  check_sphere(16, 0.02);
}
TEST(ReuseClosedForms, FurnaceIsUniform) {
  check_furnace(64, 0.01);
}
TEST(ReuseClosedForms, RoomS1) {
  check_room_s1(16, 0.01);
}
TEST(ReuseClosedForms, InfraredRoom) {
  check_infrared_room(128, 0.005);
}

TEST(ReuseClosedFormsSlow, SphereIsUniform) {
  check_sphere(200, 0.005);
}
TEST(ReuseClosedFormsSlow, FurnaceIsUniform) {
  check_furnace(1000, 0.0025);
}
TEST(ReuseClosedFormsSlow, RoomS1) {
  check_room_s1(200, 0.005);
}
TEST(ReuseClosedFormsSlow, InfraredRoom) {
  check_infrared_room(2000, 0.002);
}

}  // namespace
}  // namespace shelfbeam
