#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/transport/world/path_rules.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Sums of contributions by number of bounces (the last level takes all from there on) and by index: of a
/// transceiver for walks from a label, of a label for particles. The same
/// contributions are also summed by the length of their paths, if there are steps of it.
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

  std::uint64_t rays = 0;  ///< traced in all
  ShadowRays shadow_rays;  ///< of walks from labels

 private:
  std::size_t width_, levels_;
  LengthSteps lengths_;
  std::vector<double> sums_;
};

/// One random walk from label i (2.7, started at the sensor, with the errata), for the strategies walk, nee
/// and mis: the first direction by the label's responsivity, the others by the materials; connections to one
/// source chosen uniformly among n, so p_e = 1/n; Russian roulette on the throughput (2.18).
///
/// Adds its contributions to `tally` (n wide).
void walk_from_label(const World& world, std::size_t i, const PathKey& key, const PathRules& rules,
                     Tally& tally);

/// One particle from source j: a share of its flux is followed from surface to surface, at each of which (and
/// at the source) it is connected to every label; labels of some size are also met by it after mirrors and
/// refraction. An implementation of the same integral as `walk_from_label` that shares with it the materials
/// and devices, but no estimator.
///
/// Adds its contributions to `tally` (m wide).
void follow_particle(const World& world, std::size_t j, const PathKey& key, const PathRules& rules,
                     Tally& tally);

}  // namespace shelfbeam
