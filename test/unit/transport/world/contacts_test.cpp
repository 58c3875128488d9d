// Compares surfaces in contact with the same surfaces 1 mm apart, ray by ray.

#include "shelfbeam/transport/world/contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/world/world.hpp"

#include "physics/bare_scene.hpp"
#include "support/processor_time.hpp"

namespace shelfbeam {
namespace {

enum class Thing { pane, sheet, glass, box };
constexpr std::array all_things{Thing::pane, Thing::sheet, Thing::glass, Thing::box};
constexpr std::array names{"pane", "sheet", "solid glass", "box"};

constexpr bool is_sheet(Thing thing) {
  return thing == Thing::pane || thing == Thing::sheet;
}
constexpr bool is_glass(Thing thing) {
  return thing == Thing::pane || thing == Thing::glass;
}

/// Two things whose planes of contact are at local heights 0 and `gap`.
struct Arrangement {
  Thing lower, upper;
  Vec3 up{0, 0, 1};
  Vec3 place;
  double gap = 0;
  bool reverses_box = false;  ///< winds the triangles of opaque boxes inside out
  bool is_in_hall = false;    ///< in a scene that extends from its place to the origin
  double size = 1;            ///< of everything but the gap

  Frame frame() const { return Frame::about(normalized(up)); }
  Vec3 at(const Vec3& local) const { return place + frame().to_world(local * size); }

  Scene scene() const {
    test::BareScene bare;
    const auto add = [&](Thing thing, double low, double high, double contact) {
      const MaterialId pane = bare.material(make_thin_dielectric(1.5, 0.004, 0)),
                       glass = bare.material(make_dielectric(1.5)), paint = bare.material(Lambertian{0.5});
      test::BareScene local;
      if (thing == Thing::pane || thing == Thing::sheet)
        local.quad(thing == Thing::pane ? pane : paint, {-0.5, -0.5, contact}, {1, 0, 0}, {0, 1, 0});
      else
        local.box(thing == Thing::glass ? glass : paint, {-0.5, -0.5, low}, {0.5, 0.5, high});
      for (std::size_t t = 0; t < local.scene.mesh.triangles.size(); ++t) {
        auto [a, b, c] = local.scene.mesh.triangles[t];
        if (reverses_box && thing == Thing::box) std::swap(b, c);
        const auto& p = local.scene.mesh.vertices;
        bare.triangle(local.scene.mesh.materials[t], {at(p[a]), at(p[b]), at(p[c])});
      }
    };
    add(lower, -0.4, 0, 0);
    add(upper, gap / size, 0.4, gap / size);
    bare.label(at({3, 0, 1}), {0, 0, 1});
    if (is_in_hall) bare.triangle(MaterialId{0}, {Vec3{0, 0, -5}, Vec3{0.1, 0, -5}, Vec3{0, 0.1, -5}});
    return bare.scene;
  }
};

/// The surfaces that a ray meets, with the side on which it arrives, and what it sees from opaque surfaces.
/// At each surface a hash decides between reflection and transmission.
struct Trail {
  std::vector<std::string> met;
  std::vector<double> seen;
};

Trail trail(const World& world, const Arrangement& things, SurfacePoint from, Vec3 direction,
            std::uint32_t ray, bool forgets) {
  Trail trail;
  const Vec3 above = things.at({0.1, 0.2, 1.5}), below = things.at({-0.1, 0.15, -1.5});
  for (std::uint32_t step = 0; step < 8; ++step) {
    const auto hit = world.rays.intersect(from, direction);
    if (!hit) break;
    const bool arrives_behind = dot(hit->point.normal, direction) > 0;
    const Material& material = world.material(*hit);
    trail.met.push_back(std::to_string(hit->material.value) + (arrives_behind ? "-" : "+"));
    from = hit->point;
    if (forgets) from.triangle = no_triangle;
    const Vec3 facing = arrives_behind ? -hit->point.normal : hit->point.normal;
    const Vec3 mirrored = direction - facing * (2 * dot(direction, facing));
    const bool wants_through = philox({ray, step, 0, 0}, 9)[0] % 4 != 0;
    if (is_opaque(material)) {
      for (const Vec3& eye : {above, below}) {
        if (dot(eye - from.position, facing) <= 0) continue;
        trail.seen.push_back(world.rays.transmittance(from, eye).share);
        trail.seen.push_back(world.rays.transmittance({eye, {0, 0, 1}}, from).share);
      }
      direction = mirrored;
    } else if (const auto* solid = std::get_if<Dielectric>(&material)) {
      const double eta = arrives_behind ? solid->ior : 1 / solid->ior, cosine = -dot(direction, facing);
      const double squared = 1 - eta * eta * (1 - cosine * cosine);
      direction = wants_through && squared > 0
                      ? normalized(direction * eta + facing * (eta * cosine - std::sqrt(squared)))
                      : mirrored;
    } else if (!wants_through) {
      direction = mirrored;
    }
  }
  return trail;
}

/// The share of rays whose trails differ between two arrangements.
double difference(const Arrangement& a, const Arrangement& b, bool forgets = false) {
  const Scene scene_a = a.scene(), scene_b = b.scene();
  const World world_a(scene_a), world_b(scene_b);
  constexpr std::uint32_t count = 200;
  double different = 0, compared = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto u = philox({k, 0, 0, 0}, 5);
    const bool down = k % 2 == 0;
    // Nobody looks out of an opaque box.
    if ((down ? a.upper : a.lower) == Thing::box) continue;
    const Vec3 target{0.4 * to_uniform(u[0]) - 0.2, 0.4 * to_uniform(u[1]) - 0.2, 0};
    const double phi = 2 * pi * to_uniform(u[2]), slope = 1.2 * to_uniform(u[3]);
    const Vec3 way = normalized({slope * std::cos(phi), slope * std::sin(phi), down ? -1.0 : 1.0});
    const Vec3 start = target - way * 2;
    const auto follow = [&](const World& world, const Arrangement& things) {
      const Vec3 direction = things.frame().to_world(way);
      return trail(world, things, {things.at(start), direction}, direction, k, forgets);
    };
    const Trail trail_a = follow(world_a, a), trail_b = follow(world_b, b);
    bool differs = trail_a.met != trail_b.met || trail_a.seen.size() != trail_b.seen.size();
    for (std::size_t s = 0; !differs && s < trail_a.seen.size(); ++s)
      differs = std::abs(trail_a.seen[s] - trail_b.seen[s]) > 0.01;
    different += differs ? 1 : 0;
    compared += 1;
  }
  return compared > 0 ? different / compared : 0;
}

const std::array<Vec3, 5> directions{Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{0, -1, 0},
                                     Vec3{0.4, -0.7, 0.3}};

template <class Use>
void each_arrangement(const Use& use) {
  for (const Thing lower : all_things)
    for (const Thing upper : all_things)
      if (is_glass(lower) || is_glass(upper))
        for (const Vec3& up : directions) use(Arrangement{lower, upper, up, {0.37, 0.21, 0.83}});
}

std::string describe(const Arrangement& a) {
  return std::string(names[static_cast<std::size_t>(a.upper)]) + " on " +
         names[static_cast<std::size_t>(a.lower)] + ", up " + std::to_string(a.up.x) + " " +
         std::to_string(a.up.z) + ", at " + std::to_string(a.place.x) + ", gap " +
         std::to_string(1e6 * a.gap);
}

// Sheets have no inside, so two sheets that overlap lie in the other order, and in one place in either.
double best_difference(const Arrangement& touching, bool forgets = false) {
  Arrangement apart = touching;
  apart.place = {0.37, 0.21, 0.83};
  apart.is_in_hall = false;
  const bool are_sheets = is_sheet(touching.lower) && is_sheet(touching.upper);
  apart.gap = are_sheets && touching.gap < 0 ? -1e-3 : 1e-3;
  double found = difference(touching, apart, forgets);
  if (are_sheets && touching.gap == 0) {
    apart.gap = -1e-3;
    found = std::min(found, difference(touching, apart, forgets));
  }
  return found;
}

// Near an edge the millimetre matters, for less than 2 % of the rays.
TEST(Contacts, CountLikeSurfacesApart) {
  int arrangements = 0, controls = 0;
  each_arrangement([&](Arrangement touching) {
    ++arrangements;
    bool control_differs = true;
    for (const double distance : {0.0, 50.0, 900.0})
      for (const double overlap : {0.0, 1e-6, 4e-6, 1e-5}) {
        touching.place = Vec3{0.37, 0.21, 0.83} + Vec3{distance, 0.6 * distance, 0};
        touching.gap = -overlap;
        EXPECT_LE(best_difference(touching), 0.02) << describe(touching);
        touching.reverses_box = true;
        EXPECT_LE(best_difference(touching), 0.02) << describe(touching) << ", inside out";
        touching.reverses_box = false;
        touching.is_in_hall = true;
        EXPECT_LE(best_difference(touching), 0.02) << describe(touching) << ", in a hall";
        touching.is_in_hall = false;
        // Rays that forget which surface they leave jump over the next one.
        if (overlap < 2e-6) control_differs = control_differs && best_difference(touching, true) > 0.1;
      }
    controls += control_differs ? 1 : 0;
  });
  EXPECT_EQ(arrangements, 60);
  EXPECT_EQ(controls, arrangements);
}

// Scenes below 1 m are enlarged; the overlaps that count as contact are not.
TEST(Contacts, CountInSmallScenes) {
  each_arrangement([&](Arrangement touching) {
    touching.size = 0.1;
    touching.gap = -1e-5;
    EXPECT_LE(best_difference(touching), 0.02) << describe(touching);
  });
}

// Paint, pane and paint in one plane: each side shows its own paint, whichever of the three a ray meets
// first.
TEST(Contacts, KeepThreeLayersInOrder) {
  for (const double distance : {0.0, 50.0}) {
    test::BareScene bare;
    const MaterialId back = bare.material(Lambertian{0.2}),
                     pane = bare.material(make_thin_dielectric(1.5, 0, 0)),
                     front = bare.material(Lambertian{0.8});
    const Vec3 corner{distance, 0.3, 0.77};
    for (const MaterialId layer : {back, pane, front}) bare.quad(layer, corner, {1, 0, 0}, {0, 1, 0});
    bare.label(corner + Vec3{0, 0, 2}, {0, 0, 1});
    const RayScene rays(bare.scene);
    std::array<MaterialId, 2> seen{};
    for (std::uint32_t k = 0; k < 200; ++k) {
      const auto u = philox({k, 0, 0, 0}, 6);
      const Vec3 middle = corner + Vec3{0.1 + 0.8 * to_uniform(u[0]), 0.1 + 0.8 * to_uniform(u[1]), 0};
      for (const std::size_t side : {0U, 1U}) {
        const Vec3 way = normalized({to_uniform(u[2]) - 0.5, to_uniform(u[3]) - 0.5, side == 0 ? -1.0 : 1.0});
        const auto hit = rays.intersect({middle - way, way}, way);
        ASSERT_TRUE(hit);
        if (k == 0) seen[side] = hit->material;
        EXPECT_EQ(hit->material, seen[side]);
        EXPECT_NE(hit->material, pane);
      }
    }
    EXPECT_NE(seen[0], seen[1]);
  }
}

// In a hall of 900 m, two panes 8 mm apart are in contact; light between them still meets other things.
TEST(Contacts, HideNothingBetweenThem) {
  test::BareScene bare;
  const MaterialId pane = bare.material(make_thin_dielectric(1.5, 0, 0)),
                   paint = bare.material(Lambertian{0.5});
  const Vec3 corner{900, 500, 1};
  bare.quad(pane, corner, {1, 0, 0}, {0, 1, 0});
  bare.quad(pane, corner + Vec3{0, 0, 0.008}, {1, 0, 0}, {0, 1, 0});
  bare.quad(paint, corner + Vec3{0.49, 0, 0.001}, {0.02, 0, 0.006}, {0, 1, 0});
  bare.triangle(paint, {Vec3{0, 0, -5}, Vec3{0.1, 0, -5}, Vec3{0, 0.1, -5}});
  const RayScene rays(bare.scene);
  for (const double x : {0.3, 0.495, 0.5, 0.505}) {
    const Vec3 above = corner + Vec3{x, 0.4, 1}, down{0, 0, -1};
    const auto first = rays.intersect({above, down}, down);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->material, pane);
    const auto second = rays.intersect(first->point, down);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->material, x == 0.3 ? pane : paint) << x;
  }
}

// Gaps below and above the offset of rays.
TEST(Contacts, NarrowGapsCount) {
  each_arrangement([&](Arrangement touching) {
    for (const double gap : {2e-6, 1e-5, 3e-5, 1e-4}) {
      touching.gap = gap;
      EXPECT_LE(best_difference(touching), 0.02) << describe(touching);
    }
  });
}

// Only their edges from the last corner to the first part the triangles.
TEST(Contacts, TrianglesBesideEachOtherAreNone) {
  for (const bool overlap : {false, true}) {
    const double tip = overlap ? 0.45 : 0.55;
    test::BareScene bare;
    const MaterialId pane = bare.material(make_thin_dielectric(1.5, 0, 0));
    bare.triangle(pane, {Vec3{1, 0, 1}, Vec3{0, 0, 1}, Vec3{0, 1, 1}});
    bare.triangle(pane, {Vec3{-1, 4, 1}, Vec3{tip, tip, 1}, Vec3{4, -0.5, 1}});
    const Contacts contacts(bare.scene, {1e-5, 1e-6});
    EXPECT_EQ(contacts.are_partners(0, 1), overlap);
  }
}

// A detailed mesh on a pane: 80,000 triangles, of which each would ask on which side its solid lies.
TEST(Contacts, OfDetailedMeshesTakeLimitedTime) {
  test::BareScene bare;
  const MaterialId pane = bare.material(make_thin_dielectric(1.5, 0, 0)),
                   paint = bare.material(Lambertian{0.5});
  bare.quad(pane, {0, 0, 1}, {4, 0, 0}, {0, 4, 0});
  constexpr int side = 200;
  constexpr double size = 4.0 / side;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y) bare.quad(paint, {x * size, y * size, 1}, {size, 0, 0}, {0, size, 0});
  const test::ProcessorTime time;
  const RayScene rays(bare.scene);
  EXPECT_LT(time.seconds(), 20);  // 0.7 s; 60 s without a limit
  for (const double z : {0.0, 2.0}) {
    const Vec3 from{1.23, 2.34, z}, way{0, 0, z > 1 ? -1.0 : 1.0};
    const auto first = rays.intersect({from, way}, way);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->material, z > 1 ? paint : pane) << "the order of the scene, seen from below";
  }
}

}  // namespace
}  // namespace shelfbeam
