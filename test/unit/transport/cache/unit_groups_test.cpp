#include "shelfbeam/transport/cache/unit_groups.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"

#include "physics/bare_scene.hpp"
#include "unit/device/profiles.hpp"

namespace shelfbeam {
namespace {

Vec3 any_direction(std::uint32_t k, std::uint32_t stream) {
  const auto u = philox({k, stream, 0, 0}, 21);
  const double z = 2 * to_uniform(u[0]) - 1, phi = 2 * pi * to_uniform(u[1]), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}
Vec3 any_place(std::uint32_t k, std::uint32_t stream) {
  const auto u = philox({k, stream, 1, 0}, 21);
  return {30 * to_uniform(u[0]), 20 * to_uniform(u[1]), 4 * to_uniform(u[2])};
}

// `count` units of one type throughout a hall, with axes throughout the sphere.
test::BareScene hall(const Emission& emission, std::uint32_t count) {
  test::BareScene hall;
  hall.box(hall.material(Lambertian{0.5}), {0, 0, 0}, {30, 20, 4});
  hall.label({1, 1, 1}, {0, 0, 1});
  for (std::uint32_t k = 0; k < count; ++k) {
    hall.unit(any_place(k, 1), any_direction(k, 1), emission);
    hall.scene.transceivers.back().type = TransceiverTypeId{0};
  }
  hall.scene.transceiver_types.resize(1);
  return hall;
}

struct Deviation {
  double largest = 0;   // of the irradiance, relative to the maximum intensity over the squared distance
  double relative = 0;  // root mean square, relative to that of the irradiance
  bool is_bounded = true;
};

// Compares with double precision; measured profiles are compared with their mean over phi. `scale` is an
// error for the control.
Deviation deviation(const Emission& emission, double scale = 1) {
  const test::BareScene scene = hall(emission, 40);
  const World world(scene.scene);
  const UnitGroups groups(world);
  double peak = 0, squares = 0, error_squares = 0;
  for (int k = 0; k <= 1800; ++k) peak = std::max(peak, mean_intensity(emission, k * pi / 1800));
  Deviation result;
  for (std::uint32_t p = 0; p < 500; ++p) {
    const SurfacePoint at{any_place(p, 2), any_direction(p, 2)};
    for (std::size_t g = 0; g < groups.size(); ++g) {
      LaneValues found;
      groups.irradiance(g, LanePoint(at), found);
      Vec3 centre;
      for (std::size_t k = 0; k < groups.count(g); ++k)
        centre = centre + scene.scene.transceivers[groups.column(g, k)].position /
                              static_cast<double>(groups.count(g));
      double radius = 0;
      for (std::size_t k = 0; k < groups.count(g); ++k)
        radius = std::max(radius, length(scene.scene.transceivers[groups.column(g, k)].position - centre));
      const bool is_outside = length(at.position - centre) > 1.5 * radius + 0.5;
      for (std::size_t k = 0; k < lanes; ++k) {
        if (k >= groups.count(g)) {
          EXPECT_EQ(found[k], 0);
          continue;
        }
        const Transceiver& unit = scene.scene.transceivers[groups.column(g, k)];
        const Vec3 way = at.position - unit.position;
        const double squared = length_squared(way), distance = std::sqrt(squared);
        const double theta = std::acos(std::clamp(dot(unit.axis, way) / distance, -1.0, 1.0));
        const double expected =
            mean_intensity(emission, theta) * std::max(0.0, -dot(at.normal, way)) / (distance * squared);
        const double error = scale * static_cast<double>(found[k]) - expected;
        result.largest = std::max(result.largest, std::abs(error) * squared / peak);
        squares += expected * expected;
        error_squares += error * error;
        if (is_outside && found[k] > 1.0001F * groups.bound(g, LanePoint(at))) result.is_bounded = false;
      }
    }
  }
  result.relative = std::sqrt(error_squares / squares);
  return result;
}

// Closed forms to 1e-5, and 3e-5 of the peak everywhere. Tables and powers of the cosine to 3 %, the accuracy
// of 512 steps for sharp edges. The controls are scales off by 1e-4 and by 5 %.
TEST(UnitGroups, IrradianceIsThatOfTheEmission) {
  for (const auto& [name, emission] : test::profiles()) {
    const auto* lambertian = std::get_if<GeneralizedLambertian>(&emission);
    const bool is_closed = std::holds_alternative<SinTwoTheta>(emission) ||
                           std::holds_alternative<IsotropicHemisphere>(emission) ||
                           (lambertian != nullptr && lambertian->order == 1);
    const Deviation found = deviation(emission);
    const double most = is_closed ? 1e-5 : 0.03;
    if (is_closed) {
      EXPECT_LT(found.largest, 3e-5) << name;
    }
    EXPECT_LT(found.relative, most) << name;
    EXPECT_GT(deviation(emission, is_closed ? 1.0001 : 1.05).relative, most) << name;
    EXPECT_TRUE(found.is_bounded) << name;
  }
}

// Units of three types, some with a size, and emitting surfaces.
TEST(UnitGroups, EveryColumnHasOneLane) {
  for (const std::uint32_t count : {1U, 16U, 17U, 100U}) {
    test::BareScene scene = hall(SinTwoTheta{1}, count);
    scene.scene.transceiver_types.push_back({"disc", IsotropicHemisphere{1}, 0.2, 1});
    scene.scene.transceiver_types.push_back({"table", EmissionTable{test::lopsided_table()}, 0, 1});
    for (std::uint32_t k = 0; k < count; ++k) scene.scene.transceivers[k].type = TransceiverTypeId{k % 3};
    const MaterialId lamp = scene.material(Lambertian{0.5});
    scene.quad(lamp, {2, 2, 2}, {1, 0, 0}, {0, 1, 0});
    scene.shines(lamp, 1);
    const World world(scene.scene);
    const UnitGroups groups(world);
    std::vector<int> seen(world.emitters.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
      ASSERT_LE(groups.count(g), lanes);
      for (std::size_t k = 0; k < groups.count(g); ++k) {
        const std::uint32_t j = groups.column(g, k);
        ++seen[j];
        EXPECT_EQ(groups.lane_index(j), g * lanes + k);
        const bool is_approximate = j < count && j % 3 != 0;
        EXPECT_EQ(groups.is_approximate(g), is_approximate);
      }
    }
    EXPECT_EQ(seen, std::vector<int>(count + 1, 1));
    EXPECT_EQ(groups.any_approximate(), count > 1);

    const std::size_t lamp_group = groups.lane_index(count) / lanes;
    LaneValues given;
    groups.irradiance(lamp_group, LanePoint(SurfacePoint{{2.5, 2.5, 1}, {0, 0, 1}}), given);
    EXPECT_EQ(given, LaneValues{});
  }
}

}  // namespace
}  // namespace shelfbeam
