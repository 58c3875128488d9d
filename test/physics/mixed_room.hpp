#pragma once

#include "physics/bare_scene.hpp"

namespace shelfbeam::test {

/// A position and direction of a label or unit.
struct Mount {
  Vec3 position, direction;
};

/// A room with two shelves, one of brushed metal and one of coated plastic, and a partition of which one half
/// is a mirror and the other a pane. Both halves lie in one plane, so no path meets two mirrors in a row, and
/// the paths between points are complete from either end.
inline BareScene mixed_room() {
  BareScene room;
  const MaterialId paper = room.material(Lambertian{0.6}), floor = room.material(Lambertian{0.3}),
                   metal =
                       room.material(Conductor{0.4, 4, make_microfacets(FacetDistribution::ggx, 0.25, 0.4)}),
                   plastic = room.material(
                       make_plastic(1.5, 0.5, make_microfacets(FacetDistribution::beckmann, 0.3, 0.3))),
                   mirror = room.material(Conductor{0.2, 6.5, {}}),
                   pane = room.material(ThinDielectric{1.5, 0.006, 5});
  room.box({floor, paper, paper}, {0, 0, 0}, {6, 5, 3});
  room.box(metal, {0.8, 0.8, 0}, {2.8, 1.4, 1.6});
  room.box(plastic, {3.2, 3.6, 0}, {5.4, 4.2, 1.8});
  room.quad(mirror, {1, 2.6, 0.3}, {1.6, 0, 0}, {0, 0, 1.9});
  room.quad(pane, {2.6, 2.6, 0.3}, {2.2, 0, 0}, {0, 0, 1.9});
  return room;
}

}  // namespace shelfbeam::test
