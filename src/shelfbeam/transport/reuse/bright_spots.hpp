#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/reuse/path_vertex.hpp"
#include "shelfbeam/transport/world/next_event.hpp"

namespace shelfbeam {

/// How the light of a unit on the surfaces beside it is divided between two techniques: rays of the receivers
/// (labels, vertices of paths) take min(e, C) of its irradiance e, rays from the unit the excess e - C, with
///
///     C = cap max(1, pi near^2 p),    p = R(theta) cos(theta_y) / (W r^2),
///
/// where p is the density, per area, with which one ray of the receiver meets the point. So a ray from the
/// unit adds no more to a receiver than its power times f (W / pi) e / (cap near^2), however close the
/// receiver is to the surface.
struct SpotRule {
  /// The cap is the irradiance that the unit's largest intensity gives at a distance, m: at the larger one
  /// where up to 16 units are within 5 m, at the smaller one where 64 are, in between with the square root of
  /// their number. Rays of all of them would cost more than they bring; and with 2 m or more the floors of
  /// ordinary rooms would be spots.
  double cap_at = 0.5, cap_at_most = 1;
  double near = 1;           ///< m; 0: the cap is the same for all receivers, and r not limited from below
  bool for_vertices = true;  ///< whether vertices of paths are receivers, too
};

/// Light of a unit on a surface, as a source of its own.
struct SpotLight {
  std::uint32_t place = 0;  ///< of the unit, UnitGroups::place
  SurfacePoint point;       ///< its normal on the side of the unit
  Frame frame;              ///< of the surface as its material has it
  Vec3 incoming;            ///< unit, to the unit, in `frame`
  MaterialId material;
  double power = 0;   ///< of a ray from the unit, W, over the chance of being drawn
  double capped = 0;  ///< cap / e, below 1

  /// W/sr towards a unit direction, cosine included.
  double intensity(const Scene& scene, const Vec3& direction) const;
};

/// A receiver of a spot's light, in one direction: what it makes of radiance from there, and the density of
/// its own rays.
struct SpotReceiver {
  double response = 0;  ///< R, or f cos
  double density = 0;   ///< R / W per solid angle
};

/// The light of bright spots: on a wall or shelf beside a unit the irradiance is so high that few rays from
/// elsewhere find most of its light.
class BrightSpots {
 public:
  /// Finds the units that have such spots, and where their rays meet them, and sets their caps. A spot of a
  /// unit that seems to have none is left to the rays from elsewhere altogether.
  BrightSpots(const World& world, UnitGroups& units, std::uint64_t seed, const SpotRule& rule = {});

  std::size_t size() const { return spots_.size(); }
  const SpotRule& rule() const { return rule_; }

  /// Which units are asked for how many rays: those of which the mean of these points gets this irradiance,
  /// W/m^2, with one; with more the square of that, up to `most`; with less with a chance in proportion.
  struct Effort {
    double relevant;
    std::uint32_t most;
  };

  /// Identifies a draw.
  struct Key {
    std::uint64_t stream = 0;
    std::uint32_t batch = 0;
  };

  /// Memory that one thread works in.
  struct Scratch {
    std::vector<SpotLight> lights;
    std::vector<std::uint32_t> receivers;
    std::vector<Vec3> targets;
    std::vector<double> values;
    std::vector<Passage> passages;
  };

  /// Draws lights for all that stands at some points; whatever the points, the expectation of their power
  /// is the whole flux above the caps.
  void draw(std::span<const Vec3> points, const Effort& effort, const Key& key,
            std::vector<SpotLight>& lights, std::uint64_t& rays) const;

  /// The share that rays from the unit bring to a receiver, 1 - C / e.
  double excess(const SpotLight& light, double p) const {
    return std::max(0.0, 1 - light.capped * std::max(1.0, rule_.near * rule_.near * pi * p));
  }

  /// Calls use(k, place, value) for the receivers at some points, with what rays from units bring them.
  /// `receive(k, direction)` gives the SpotReceiver for light from a unit direction.
  template <class Receive, class Use>
  void light_up(std::span<const Vec3> points, const Effort& effort, const Key& key, Scratch& scratch,
                std::uint64_t& rays, const Receive& receive, const Use& use) const {
    if (spots_.empty() || points.empty()) return;
    draw(points, effort, key, scratch.lights, rays);
    for (const SpotLight& light : scratch.lights) {
      scratch.receivers.clear();
      scratch.targets.clear();
      scratch.values.clear();
      for (std::uint32_t k = 0; k < points.size(); ++k) {
        const auto seen = sight(points[k], light.point);
        if (!seen) continue;  // what touches a surface from behind takes its light itself
        const SpotReceiver receiver = receive(k, seen->direction);
        if (!(receiver.response > 0)) continue;
        const double share = excess(light, seen->area_density(receiver.density));
        if (!(share > 0)) continue;
        const double value =
            light.intensity(world_.scene, -seen->direction) * share * receiver.response / seen->squared;
        if (!(value > 0)) continue;
        scratch.receivers.push_back(k);
        scratch.targets.push_back(points[k]);
        scratch.values.push_back(value);
      }
      scratch.passages.resize(scratch.targets.size());
      world_.rays.passages(light.point, scratch.targets, scratch.passages);
      rays += scratch.targets.size();
      for (std::size_t t = 0; t < scratch.targets.size(); ++t)
        if (scratch.passages[t].share > 0)
          use(scratch.receivers[t], light.place, scratch.values[t] * scratch.passages[t].share);
    }
  }

  /// What a receiver's own ray takes between the cap and C of a vertex that it has met straight on: adds
  /// `weight` times the radiance to the row.
  void add_near(const PathVertex& vertex, double p, double weight, RandomStream& random, LaneRow& row,
                std::uint64_t& rays) const;

 private:
  struct Spot {
    std::uint32_t unit;
    double flux;                  ///< in the excess, roughly, W
    std::vector<double> chances;  ///< of the strata of its rays, running sums
  };
  const World& world_;
  const UnitGroups& units_;
  SpotRule rule_;
  std::vector<Spot> spots_;
  std::vector<std::uint16_t> groups_;  ///< that have units with spots
};

}  // namespace shelfbeam
