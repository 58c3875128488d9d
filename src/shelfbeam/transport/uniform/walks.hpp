#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/transport/world/path_rules.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Sums of contributions by number of bounces (the last level includes all larger numbers) and by index: of a
/// source for walks from a label, of a label for particles. With length steps, the same contributions are
/// also summed by path length.
class Tally {
 public:
  Tally(std::size_t width, std::size_t levels, const LengthSteps& lengths = {})
      : width_(width), levels_(levels), lengths_(lengths), sums_(width * (levels + lengths.count)) {}

  void add(std::size_t bounces, std::size_t k, double value, double length = 0) {
    sums_[std::min(bounces, levels_ - 1) * width_ + k] += value;
    if (lengths_.count == 0) return;
    const auto step = static_cast<std::size_t>(std::min(length / lengths_.step, lengths_.count - 1.0));
    sums_[(levels_ + step) * width_ + k] += value;
  }

  double sum(std::size_t level, std::size_t k) const { return sums_[level * width_ + k]; }
  double sum_of_length(std::size_t step, std::size_t k) const { return sum(levels_ + step, k); }

  std::uint64_t rays = 0;  ///< total rays traced
  ShadowRays shadow_rays;  ///< of walks from labels

 private:
  std::size_t width_, levels_;
  LengthSteps lengths_;
  std::vector<double> sums_;
};

/// One random walk from label i (2.7, started at the sensor, with the errata), for the strategies walk, nee
/// and mis. The label's responsivity is sampled for the first direction, the materials for the others; each
/// connection goes to one of n sources, chosen uniformly, so p_e = 1/n; Russian roulette uses the throughput
/// (2.18).
///
/// Adds its contributions to `tally` (n wide).
void walk_from_label(const World& world, std::size_t i, const PathKey& key, const PathRules& rules,
                     Tally& tally);

/// One particle from source j, which carries flux from surface to surface. Each surface and the source are
/// connected to every label; after a mirror or a refraction, the particle also meets labels with an area. An
/// implementation of the same integral as `walk_from_label` that shares materials and devices with it, but no
/// estimator.
///
/// Adds its contributions to `tally` (m wide).
void follow_particle(const World& world, std::size_t j, const PathKey& key, const PathRules& rules,
                     Tally& tally);

}  // namespace shelfbeam
