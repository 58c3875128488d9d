#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace shelfbeam {

/// Running mean and variance (Welford 1962), with merging (Chan, Golub, LeVeque 1979). The order of `add` and
/// `merge` affects only the last bits of the result.
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

  /// Unbiased sample variance; infinite for fewer than two values.
  double variance() const {
    return count_ < 2 ? std::numeric_limits<double>::infinity() : squares_ / static_cast<double>(count_ - 1);
  }
  /// Standard error of the mean, for independent values.
  double standard_error() const {
    return std::sqrt(variance() / static_cast<double>(count_ < 2 ? 1 : count_));
  }

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0;
  double squares_ = 0;  ///< sum of squared differences from the mean
};

/// Whether the standard error of a mean rests on too few of the n values to be reliable: g^2 > n / 4 + 2 with
/// the skewness g. A single value that contributes the share s of the spread gives g^2 = s^3 n, so the test
/// detects a value with about two thirds of the spread or more. The 2 allows for the skewness that a small
/// sample of a well-behaved distribution shows by chance.
inline bool is_skewed(double skewness, double n) {
  return skewness * skewness > n / 4 + 2;
}

/// Power sums of n independent values, their skewness, and the standard error of their mean.
struct PowerSums {
  double n = 0, sum = 0, squares = 0, cubes = 0;

  void add(double value) {
    n += 1;
    sum += value;
    squares += value * value;
    cubes += value * value * value;
  }

  double mean() const { return sum / n; }

  /// Standard error of the mean, from the spread of the values. A spread within the rounding error is 0.
  double standard_error() const { return std::sqrt(spread() / (n * (n - 1))); }

  /// Third central moment over the cube of the standard deviation; 0 without spread.
  double skewness() const {
    const double m2 = spread();
    if (m2 == 0) return 0;
    const double m3 = cubes - 3 * mean() * squares + 2 * mean() * mean() * sum;
    const double rounding = 16 * epsilon * (std::abs(cubes) + std::abs(mean()) * squares);
    return std::abs(m3) <= rounding ? 0 : std::sqrt(n) * m3 / (m2 * std::sqrt(m2));
  }

  bool is_skewed() const { return shelfbeam::is_skewed(skewness(), n); }

 private:
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

  /// Sum of squared differences from the mean.
  double spread() const {
    const double found = squares - sum * sum / n;
    return found <= n * squares * epsilon ? 0 : found;
  }
};

/// Moments up to the third (Terriberry 2007), for confidence limits of the means of skewed values.
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
  /// Third central moment over the cube of the standard deviation; 0 if all values are equal.
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
