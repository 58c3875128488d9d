// A smooth coat on a curved mesh: the light that it reflects first reaches points, too.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/run/simulate.hpp"
#include "shelfbeam/transport/world/world.hpp"

#include "physics/bare_scene.hpp"
#include "physics/comparison.hpp"

namespace shelfbeam::physics::coated_sphere {
namespace {

struct Flux {
  double mean = 0, error = 0;  ///< of all light that meets the sphere, W
};

// A sphere of triangles too small for plane mirrors, with a label in the middle of each.
test::BareScene sphere() {
  test::BareScene room;
  room.sphere(room.material(make_plastic(1.5, 0.8)), 0.9, 3);
  room.unit({0.25, 0.15, -0.2}, normalized({1, 2, -1}), GeneralizedLambertian{1, 2});
  const TriangleMesh& mesh = room.scene.mesh;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 middle = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
    room.label(middle * (1 - 1e-5), -normalized(middle));
  }
  return room;
}

double area_of(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return length(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
}

// Photons from the unit that are scattered by the material itself, with its smooth coat; without those that
// the coat reflects first if `loses` is true.
Flux by_photons(const test::BareScene& room, std::uint32_t photons, bool loses) {
  const World world(room.scene);
  const Material& material = room.scene.materials[0].material;
  const double power = shelfbeam::power(room.scene.transceiver_types[0].emission);
  double sum = 0, squares = 0;
  for (std::uint32_t p = 0; p < photons; ++p) {
    RandomStream random(7, p, 0, 0);
    const auto emitted =
        world.emitters.emit(0, {random.uniform(), random.uniform(), random.uniform(), random.uniform()});
    if (!emitted) continue;
    SurfacePoint from{emitted->from.position, emitted->from.normal};
    Vec3 direction = emitted->direction;
    double weight = power, met = 0;
    for (int bounce = 0;; ++bounce) {
      const auto hit = world.rays.intersect(from, direction);
      if (!hit) break;
      met += weight;
      Vec3 normal = hit->point.normal;
      if (dot(normal, direction) > 0) normal = -normal;
      const Frame frame = Frame::about(normal);
      const auto next =
          sample(material, frame.to_local(-direction), random.uniform(), random.uniform(), random.uniform());
      if (!next || (loses && bounce == 0 && next->specular)) break;
      const double survival = std::min(1.0, next->weight);
      if (random.uniform() >= survival) break;
      weight *= next->weight / survival;
      from = {hit->point.position, normal, hit->point.triangle};
      direction = frame.to_world(next->direction);
    }
    sum += met;
    squares += met * met;
  }
  const double mean = sum / photons;
  return {mean, std::sqrt((squares / photons - mean * mean) / photons)};
}

double by_signals(const test::BareScene& room, const SignalMatrix& matrix) {
  double flux = 0;
  for (std::size_t t = 0; t < matrix.rows(); ++t)
    flux += area_of(room.scene.mesh, t) * static_cast<double>(matrix.mean[t]);
  return flux;
}

// Within 0.5 %, or four standard errors of the photons. The control lacks the light that the coat reflects
// first.
TEST(CoatedSphereSlow, PointsHaveAllTheLight) {
  const test::BareScene room = sphere();
  const double found = by_signals(room, test::path_reuse.simulate(room.scene, 2096));
  const Flux all = by_photons(room, 500000, false), less = by_photons(room, 500000, true);
  EXPECT_LT(4 * all.error, 0.005 * all.mean);
  EXPECT_NEAR(found / all.mean, 1, 0.005);
  EXPECT_GT(found / less.mean, 1.02);
}

}  // namespace
}  // namespace shelfbeam::physics::coated_sphere
