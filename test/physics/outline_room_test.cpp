// A room with a concave outline, zones of different and sloped ceilings, and inner walls with a door and a
// window: its surface has no gaps, and it neither loses nor gains light.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/run/simulate.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"

#include "physics/comparison.hpp"
#include "support/l_shaped_room.hpp"

namespace shelfbeam::physics::outline_room {
namespace {

constexpr double rho = 0.9, phi = 4 * pi / 3;  // W, for a sin 2 theta unit of 1 W/sr

Scene l_shaped_room() {
  return make_scene(parse_store(R"({
    "materials": { "white": { "type": "lambertian", "reflectance": 0.9 } },
    "label_types": { "point": { "threshold": 1 } },
    "transceiver_types": { "unit": { "emission": { "type": "sin2theta", "peak": 1 } } },
    "room": )" + test::l_shaped_room("white", "") +
                                    R"(,
    "labels": [ { "id": "L", "position": [1, 1, 1], "normal": [1, 0, 0], "type": "point" } ],
    "transceivers": { "list": [ { "id": "T", "position": [10, 4, 3], "type": "unit" } ] }
  })",
                                "store.json", {}));
}

double random(std::uint32_t index, std::uint32_t dimension) {
  return to_uniform(philox({index, dimension, 0, 0}, 11)[0]);
}

// The rays that meet no surface, among diffuse reflections and rays aimed at the edges of triangles, where
// gaps would be.
std::uint64_t escapes(const Scene& scene, std::uint32_t count) {
  const RayScene rays(scene);
  std::atomic<std::uint64_t> escaped = 0;
  const auto& vertices = scene.mesh.vertices;
  const auto& triangles = scene.mesh.triangles;
  for_each_task(count / 1000, [&](std::size_t block) {
    for (std::uint32_t k = 0; k < 1000; ++k) {
      const auto index = static_cast<std::uint32_t>(1000 * block) + k;
      const Vec3 from{10 + 0.5 * random(index, 0), 3 + random(index, 1), 0.2 + 2 * random(index, 2)};
      const auto& triangle =
          triangles[static_cast<std::size_t>(random(index, 3) * static_cast<double>(triangles.size()))];
      const double share = random(index, 4);
      Vec3 to = vertices[triangle[0]] * share + vertices[triangle[1]] * (1 - share);
      if (index % 2 == 0)
        to = from + Vec3{random(index, 5) - 0.5, random(index, 6) - 0.5, random(index, 7) - 0.5};
      const Vec3 direction = normalized(to - from);
      if (!rays.intersect({from, direction}, direction)) ++escaped;
    }
  });
  return escaped;
}

TEST(OutlineRoom, LetsNoRayEscape) {
  Scene scene = l_shaped_room();
  EXPECT_EQ(escapes(scene, 1'000'000), 0U);
  auto& [vertices, triangles, materials] = scene.mesh;
  const auto area = [&at = vertices](const auto& t) {
    return length(cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]));
  };
  triangles.erase(std::ranges::max_element(triangles, {}, area));
  materials.pop_back();
  EXPECT_GT(escapes(scene, 10'000), 0U) << "the control: the largest triangle is missing";
}

TEST(OutlineRoomSlow, LetsNoRayOfTwentyMillionEscape) {
  EXPECT_EQ(escapes(l_shaped_room(), 20'000'000), 0U);
}

// Probes at random points of the surface, each on both sides; that outside the room is dark. All incident
// flux is phi / (1 - rho). z-test at 0.1 %; the statistical error is about 2 %, from the places of the
// probes. The control is an albedo that is off by 1 %.
TEST(OutlineRoomSlow, BalancesTheFlux) {
  Scene scene = l_shaped_room();
  scene.store_hash.clear();
  scene.labels.clear();
  const auto& [vertices, triangles, materials] = scene.mesh;
  std::vector<double> area;
  area.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles)
    area.push_back(length(cross(vertices[b] - vertices[a], vertices[c] - vertices[a])) / 2);
  std::vector<double> until(area.size());
  std::partial_sum(area.begin(), area.end(), until.begin());
  constexpr std::uint32_t probes = 1500;
  for (std::uint32_t k = 0; k < probes; ++k) {
    const double at = until.back() * (k + random(k, 0)) / probes;  // stratified by area
    const auto t = static_cast<std::size_t>(std::upper_bound(until.begin(), until.end(), at) - until.begin());
    const auto& [a, b, c] = triangles[std::min(t, triangles.size() - 1)];
    const double root = std::sqrt(random(k, 1)), share = random(k, 2);
    const Vec3 p =
        vertices[a] * (1 - root) + vertices[b] * (root * (1 - share)) + vertices[c] * (root * share);
    const Vec3 normal = normalized(cross(vertices[b] - vertices[a], vertices[c] - vertices[a]));
    for (const double side : {1.0, -1.0})
      scene.labels.push_back(
          {"L" + std::to_string(scene.labels.size()), p + normal * (side * 1e-4), normal * side, {}});
  }
  SimulationOptions options;
  options.samples = 256;
  const auto matrix = simulate(scene, options).matrix;
  Moments incident;
  for (std::uint32_t k = 0; k < probes; ++k)
    incident.add(until.back() *
                 static_cast<double>(matrix.mean[std::size_t{2} * k] + matrix.mean[std::size_t{2} * k + 1]));
  const double all = phi / (1 - rho);
  test::Comparison flux;
  flux.add(incident.mean(), all, incident.standard_error());
  test::expect_agreement(flux, 0.028, (1 - rho) / (1 - 1.01 * rho), "probes");
}

}  // namespace
}  // namespace shelfbeam::physics::outline_room
