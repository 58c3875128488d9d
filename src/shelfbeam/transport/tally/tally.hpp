#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/transport/world/path_rules.hpp"

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

}  // namespace shelfbeam
