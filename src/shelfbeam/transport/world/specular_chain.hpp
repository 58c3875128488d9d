#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "shelfbeam/transport/world/path_rules.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// The first surface that scatters, which a ray meets after any number of mirrors, panes and smooth glass.
struct ChainEnd {
  SurfacePoint point;  ///< with the normal on the side from which the ray came
  Vec3 outside;        ///< normal by the triangle's winding, as materials need it
  Vec3 outgoing;       ///< unit length, back along the ray
  MaterialId material;
  bool is_imaged = false;                    ///< on a mirror of PlaneMirrors
  Departure arrived = Departure::scattered;  ///< of the last segment
  double throughput = 1;
  bool is_straight = true;  ///< whether the ray went straight, through nothing but panes
  double probability = 1;   ///< that it went straight through these panes (Transmittance::probability)
};

/// Follows a ray from `from`. Calls use(j, throughput x radiance) for the sources that it meets and that no
/// connection could have found (Departure). Straight passage through panes does not change this, because
/// connections pass panes, too.
template <class Use>
std::optional<ChainEnd> follow_chain(const World& world, SurfacePoint from, Vec3 direction,
                                     Departure departure, RandomStream& random, std::uint64_t& rays,
                                     const Use& use) {
  Vec3 vertex = from.position;  // the last vertex; a pane passed straight through is not a vertex
  double passed = 0;            // distance from this vertex to the origin of the ray
  ChainEnd end;
  for (int step = 0;; ++step) {
    const auto hit = world.rays.intersect(from, direction);
    ++rays;
    if (departure != Departure::scattered) {
      const double farthest =
          hit ? hit->distance(vertex, direction) : std::numeric_limits<double>::infinity();
      if (departure == Departure::specular)
        world.emitters.each_disc(
            world.rays, vertex, direction, passed, farthest,
            [&](std::size_t j, const LightPoint&, double radiance) { use(j, end.throughput * radiance); });
      if (hit)
        if (const auto j = world.emitters.surface_of(hit->material))
          use(*j, end.throughput * world.emitters.radiance(*j));
    }
    if (!hit) return std::nullopt;
    const Material& material = world.material(*hit);
    if (!has_only_specular(material)) {
      end.point = hit->point;
      end.outside = hit->point.normal;
      if (dot(end.point.normal, direction) > 0) end.point.normal = -end.point.normal;
      end.outgoing = -direction;
      end.material = hit->material;
      end.is_imaged = world.mirrors.contains(hit->point.triangle);
      end.arrived = departure;
      return end;
    }
    const Frame frame = Frame::of_surface(hit->point.normal);
    const Vec3 outgoing = frame.to_local(-direction);
    const double u_lobe = random.uniform(), u1 = random.uniform(), u2 = random.uniform();
    const auto next = sample(material, outgoing, u_lobe, u1, u2);
    if (!next) return std::nullopt;
    end.throughput *= next->weight;
    from = hit->point;
    if (is_pane(material) && next->direction.z * outgoing.z < 0) {
      passed = hit->distance(vertex, direction);
      end.probability *= next->pdf;
    } else {
      end.is_straight = false;
      vertex = hit->point.position;
      passed = 0;
      direction = frame.to_world(next->direction);
      departure = after_specular(
          departure, next->direction.z * outgoing.z > 0 && world.mirrors.contains(hit->point.triangle));
    }
    // Russian roulette on the throughput, because between two mirrors a ray would never end.
    if (step >= 8 && !end.is_straight) {
      const double survival = std::clamp(end.throughput, 0.05, 0.95);
      if (random.uniform() >= survival) return std::nullopt;
      end.throughput /= survival;
    }
  }
}

}  // namespace shelfbeam
