#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace shelfbeam {

/// Counts of values in equal bins over [low, high]; the last bin holds `high` itself.
class Histogram {
 public:
  /// Throws std::invalid_argument unless low < high, both finite, and there is a bin.
  Histogram(double low, double high, std::size_t bins) : low_(low), high_(high), counts_(bins) {
    if (!(low < high) || !std::isfinite(high - low) || bins == 0)
      throw std::invalid_argument("Histogram: needs low < high and a bin");
  }

  void add(double value) {
    if (value < low_)
      ++below_;
    else if (value <= high_)
      ++counts_[bin(value)];
    else
      ++above_;  // NaN, too
  }

  const std::vector<std::uint64_t>& counts() const { return counts_; }
  std::uint64_t below() const { return below_; }
  std::uint64_t above() const { return above_; }
  /// Where bin k begins; k = number of bins gives `high`.
  double edge(std::size_t k) const {
    return low_ + (high_ - low_) * (static_cast<double>(k) / static_cast<double>(counts_.size()));
  }

 private:
  std::size_t bin(double value) const {
    const double bins = static_cast<double>(counts_.size());
    const auto k = static_cast<std::size_t>((value - low_) / (high_ - low_) * bins);
    return k < counts_.size() ? k : counts_.size() - 1;
  }

  double low_, high_;
  std::vector<std::uint64_t> counts_;
  std::uint64_t below_ = 0, above_ = 0;
};

}  // namespace shelfbeam
