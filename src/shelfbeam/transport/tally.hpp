#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/transport/shadow_rays.hpp"

namespace shelfbeam {

/// Sums of contributions by number of bounces (the last level takes all from there on) and by index: of a
/// transceiver for walks from a label, of a label for particles.
class Tally {
 public:
  Tally(std::size_t width, std::size_t levels) : width_(width), levels_(levels), sums_(width * levels) {}

  void add(std::size_t bounces, std::size_t k, double value) {
    sums_[std::min(bounces, levels_ - 1) * width_ + k] += value;
  }
  void clear() { std::fill(sums_.begin(), sums_.end(), 0.0); }

  std::size_t width() const { return width_; }
  std::size_t levels() const { return levels_; }
  double sum(std::size_t level, std::size_t k) const { return sums_[level * width_ + k]; }

  std::uint64_t rays = 0;  ///< traced in all; not cleared
  ShadowRays shadow_rays;  ///< of walks from labels; not cleared

 private:
  std::size_t width_, levels_;
  std::vector<double> sums_;
};

}  // namespace shelfbeam
