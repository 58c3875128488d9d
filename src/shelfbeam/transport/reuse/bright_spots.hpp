#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/transport/cache/spot_light.hpp"
#include "shelfbeam/transport/cells/ray_targets.hpp"
#include "shelfbeam/transport/reuse/path_vertex.hpp"
#include "shelfbeam/transport/world/next_event.hpp"

namespace shelfbeam {

/// Divides the light of a unit on the surfaces beside it between two techniques: rays of the receivers
/// (labels and path vertices) take min(e, C) of its irradiance e, rays from the unit take the excess e - C,
/// with
///
///     C = cap max(1, pi near^2 p),    p = R(theta) cos(theta_y) / (W r^2),
///
/// where p is the density per area with which one ray of the receiver samples the point. A ray from the unit
/// thus adds at most its power times f (W / pi) e / (cap near^2) to a receiver, however close the receiver is
/// to the surface.
struct SpotRule {
  /// The cap is the irradiance that the unit's largest intensity gives at a distance, m: `max_cap_distance`
  /// with up to 16 units within 5 m, `min_cap_distance` with 64 or more, and max_cap sqrt(16 / k) with k
  /// units in between, because rays of all of them would cost more than they gain. With 2 m or more, the
  /// floors of ordinary rooms would be spots.
  double min_cap_distance = 0.5, max_cap_distance = 1;
  double near_distance = 1;  ///< m; 0: the cap is the same for all receivers, and 1/r^2 is not bounded
  bool for_vertices = true;  ///< whether path vertices are receivers, too
};

/// A receiver of a spot's light, in one direction.
struct SpotReceiver {
  double response = 0;  ///< to radiance: R, or f cos
  double density = 0;   ///< of its own rays per solid angle, R / W
};

/// The light of bright spots: on a wall or shelf beside a unit, the irradiance is so high that the few rays
/// of receivers that meet the spot would carry most of its light.
class BrightSpots {
 public:
  /// Finds the units with such spots and the strata of their rays that meet them, and sets the caps. A unit
  /// for which no spot is found gets no cap: rays of receivers take all of its light.
  BrightSpots(const World& world, UnitGroups& units, std::uint64_t seed, const SpotRule& rule = {});

  std::size_t size() const { return spots_.size(); }
  /// Whether a spot is so bright that it lights the corners around it like a second unit: 2 % of some unit's
  /// rays meet a surface where its irradiance is 16 times its cap, within a quarter of the cap's distance.
  bool any_steep() const { return any_steep_; }
  /// The openings of the shop, and the units with steep spots.
  RayTargets targets() const;
  /// Sampled lights whose expected sum is the excess of the units with steep spots, adjacent by unit.
  std::vector<SpotLight> steep_lights(std::uint64_t seed) const;
  const SpotRule& rule() const { return rule_; }

  /// Number of rays from a unit whose excess gives the points x times `relevant` W/m^2 on average: x^2 rays,
  /// up to `most`; for x < 1 a single ray with probability x, at least 0.02.
  struct Effort {
    double relevant;
    std::uint32_t most;
  };

  /// Identifies a sample of lights.
  struct Key {
    std::uint64_t stream = 0;
    std::uint32_t batch = 0;
  };

  /// Workspace of one thread.
  struct Scratch {
    std::vector<SpotLight> lights;
    std::vector<std::uint32_t> receivers;
    std::vector<RayEnd> targets;
    std::vector<double> values;
    std::vector<Transmittance> transmittances;
  };

  /// Samples lights for the receivers at some points. For any points, the expectation of their power is the
  /// whole flux above the caps.
  void draw(std::span<const RayEnd> points, const Effort& effort, const Key& key,
            std::vector<SpotLight>& lights, std::uint64_t& rays) const;

  /// The share of the light that rays from the unit bring to a receiver, 1 - C / e; p as in SpotRule.
  double excess(const SpotLight& light, double p) const {
    return std::max(0.0,
                    1 - light.capped * std::max(1.0, rule_.near_distance * rule_.near_distance * pi * p));
  }

  /// Calls use(k, lane index of the unit, value) for the receivers k at some points that rays from units
  /// reach. `receive(k, direction)` returns the SpotReceiver for light from a unit-length direction.
  template <class Receive, class Use>
  void add_light(std::span<const RayEnd> points, const Effort& effort, const Key& key, Scratch& scratch,
                 std::uint64_t& rays, const Receive& receive, const Use& use) const {
    if (spots_.empty() || points.empty()) return;
    draw(points, effort, key, scratch.lights, rays);
    for (const SpotLight& light : scratch.lights) {
      scratch.receivers.clear();
      scratch.targets.clear();
      scratch.values.clear();
      for (std::uint32_t k = 0; k < points.size(); ++k) {
        const auto seen = sight(points[k].position, light.point);
        if (!seen) continue;  // a receiver that touches the surface from behind takes this light itself
        const SpotReceiver receiver = receive(k, seen->direction);
        if (!(receiver.response > 0)) continue;
        const double share = excess(light, seen->area_density(receiver.density));
        if (!(share > 0)) continue;
        const double value = light.intensity(world_.scene, -seen->direction) * share * receiver.response /
                             seen->distance_squared;
        if (!(value > 0)) continue;
        scratch.receivers.push_back(k);
        scratch.targets.push_back(points[k]);
        scratch.values.push_back(value);
      }
      scratch.transmittances.resize(scratch.targets.size());
      world_.rays.transmittances(light.point, scratch.targets, scratch.transmittances);
      rays += scratch.targets.size();
      for (std::size_t t = 0; t < scratch.targets.size(); ++t)
        if (scratch.transmittances[t].share > 0)
          use(scratch.receivers[t], light.lane_index, scratch.values[t] * scratch.transmittances[t].share);
    }
  }

  /// The light between cap and C that a receiver's own ray takes from a vertex that it met straight: adds
  /// `weight` times its radiance to the row.
  void add_near(const PathVertex& vertex, double p, double weight, RandomStream& random, LaneRow& row,
                std::uint64_t& rays) const;

 private:
  struct Spot {
    std::uint32_t unit;
    bool is_steep;
    double flux;                  ///< estimated flux of the excess, W
    std::vector<double> chances;  ///< cumulative probabilities of the strata of its rays
  };
  void shine(const Spot& spot, std::uint64_t stream, std::uint32_t batch, std::uint32_t count, double chance,
             std::vector<SpotLight>& lights, std::uint64_t& rays) const;

  const World& world_;
  const UnitGroups& units_;
  SpotRule rule_;
  bool any_steep_ = false;
  std::vector<Spot> spots_;
  std::vector<std::uint16_t> groups_;  ///< groups of units (UnitGroups) with spots
};

}  // namespace shelfbeam
