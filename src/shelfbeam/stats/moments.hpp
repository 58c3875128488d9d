#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace shelfbeam {

/// Running mean and variance of values (Welford 1962), and of their union (Chan, Golub, LeVeque 1979). The
/// result depends on the order of `add` and `merge` in its last bits, and on nothing else.
class Moments {
 public:
  void add(double value) {
    ++count_;
    const double difference = value - mean_;
    mean_ += difference / static_cast<double>(count_);
    squares_ += difference * (value - mean_);
  }

  void merge(const Moments& other) {
    if (other.count_ == 0) return;
    const auto mine = static_cast<double>(count_), theirs = static_cast<double>(other.count_);
    const double difference = other.mean_ - mean_;
    count_ += other.count_;
    mean_ += difference * (theirs / (mine + theirs));
    squares_ += other.squares_ + difference * difference * (mine * theirs / (mine + theirs));
  }

  std::uint64_t count() const { return count_; }
  double mean() const { return mean_; }  ///< 0 without values

  /// Unbiased sample variance; infinite for fewer than two values, which tell nothing of it.
  double variance() const {
    return count_ < 2 ? std::numeric_limits<double>::infinity() : squares_ / static_cast<double>(count_ - 1);
  }
  /// Of the mean, for independent values.
  double standard_error() const {
    return std::sqrt(variance() / static_cast<double>(count_ < 2 ? 1 : count_));
  }

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0;
  double squares_ = 0;  ///< sum of squared differences from the mean
};

}  // namespace shelfbeam
