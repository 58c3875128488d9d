#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace shelfbeam {

/// A histogram of relative errors with bins of equal ratio. It gives quantiles of any number of values in
/// little memory, accurate to 1 %. Counts are integers, so the order of `add` and `merge` does not matter.
class LogHistogram {
 public:
  static constexpr double smallest = 1e-6;  ///< smaller values count as 0
  static constexpr double ratio = 1.01;

  void add(double value) {
    ++counts_[bin(value)];
    ++total_;
  }

  void merge(const LogHistogram& other) {
    for (std::size_t b = 0; b < counts_.size(); ++b) counts_[b] += other.counts_[b];
    total_ += other.total_;
  }

  std::uint64_t count() const { return total_; }

  /// The upper end of the bin that contains the p-quantile: at least the share p of all values is at most
  /// this. 0 without values.
  double quantile(double p) const {
    const double target = p * static_cast<double>(total_);
    double passed = 0;
    std::size_t b = 0;
    for (; b + 1 < counts_.size(); ++b)
      if ((passed += static_cast<double>(counts_[b])) >= target) break;
    return b == 0 ? 0 : smallest * std::pow(ratio, static_cast<double>(b));
  }

 private:
  static std::size_t bin(double value) {
    if (!(value > smallest)) return 0;
    const double b = std::ceil(std::log(value / smallest) / std::log(ratio));
    return static_cast<std::size_t>(std::clamp(b, 1.0, static_cast<double>(bins - 1)));
  }

  static constexpr std::size_t bins = 2084;  // the last bin ends at about 1000
  std::array<std::uint64_t, bins> counts_{};
  std::uint64_t total_ = 0;
};

}  // namespace shelfbeam
