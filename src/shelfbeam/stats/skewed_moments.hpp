#pragma once

#include <cmath>
#include <cstdint>

#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/stats/power_sums.hpp"

namespace shelfbeam {

/// Moments with the third one (Terriberry 2007), for limits of means of skewed values.
class SkewedMoments {
 public:
  void add(double value) {
    const auto n = static_cast<double>(moments_.count() + 1);
    const double part = (value - moments_.mean()) / n;
    const double squares = part * part * n * (n - 1);
    cubes_ += squares * part * (n - 2) - 3 * part * squares_;
    squares_ += squares;
    moments_.add(value);
  }

  std::uint64_t count() const { return moments_.count(); }
  double mean() const { return moments_.mean(); }
  double variance() const { return moments_.variance(); }
  double standard_error() const { return moments_.standard_error(); }
  /// Third central moment over the cube of the standard deviation; 0 where all values are equal.
  double skewness() const {
    return squares_ > 0
               ? std::sqrt(static_cast<double>(moments_.count())) * cubes_ / (squares_ * std::sqrt(squares_))
               : 0;
  }
  bool is_skewed() const { return shelfbeam::is_skewed(skewness(), static_cast<double>(count())); }

 private:
  Moments moments_;
  double squares_ = 0, cubes_ = 0;  ///< sums of powers of differences from the mean
};

}  // namespace shelfbeam
