#include "comparison.hpp"

#include <algorithm>
#include <cmath>

namespace shelfbeam::bench {

EfficiencyRatio efficiency_ratio(const Scene& scene, const Selection& selection, const Entrant& one,
                                 const Entrant& other, double above, std::uint32_t min_contributions) {
  const std::size_t width = one.sums.by_column.size();
  EfficiencyRatio found;
  double sum = 0;
  for (std::size_t e = 0; e < one.sums.entries.size(); ++e) {
    const BatchMean &a = one.sums.entries[e], &b = other.sums.entries[e];
    const double requirement = scene.type_of(scene.labels[selection.labels[e / width]]).requirement();
    if (a.mean <= above * requirement) continue;
    if (std::min(one.sums.contributions[e], other.sums.contributions[e]) < min_contributions ||
        !(a.variance() > 0)) {
      ++found.omitted;
      continue;
    }
    ++found.entries;
    sum += std::log(b.variance() / a.variance());
  }
  if (found.entries == 0) return found;
  const double variances = std::exp(sum / static_cast<double>(found.entries));
  const double seconds = one.seconds + one.known_seconds;
  const double other_seconds = other.seconds + other.known_seconds + other.cache_seconds;
  found.ratio = variances * other_seconds / (seconds + one.cache_seconds);
  found.without_cache = variances * other_seconds / seconds;
  return found;
}

namespace {

class Differences {
 public:
  void add(const BatchMean& a, const BatchMean& b) {
    const double variance = a.variance() + b.variance();
    if (!(variance > 0)) return;
    const double difference = a.mean - b.mean, z = std::abs(difference) / std::sqrt(variance);
    ++found_.values;
    if (a.mean > 0) {
      found_squares_ += difference * difference / (a.mean * a.mean);
      expected_squares_ += variance / (a.mean * a.mean);
    }
    squares_ += z * z;
    beyond_ += z > 3 ? 1 : 0;
    found_.largest = std::max(found_.largest, z);
  }
  Agreement result() const {
    Agreement found = found_;
    if (found.values == 0) return found;
    found.pooled = std::sqrt(found_squares_ / expected_squares_);
    found.rms = std::sqrt(squares_ / static_cast<double>(found.values));
    found.beyond_3 = beyond_ / static_cast<double>(found.values);
    return found;
  }

 private:
  Agreement found_;
  double squares_ = 0, beyond_ = 0, found_squares_ = 0, expected_squares_ = 0;
};

}  // namespace

Agreement agreement(const std::vector<BatchMean>& one, const std::vector<BatchMean>& other) {
  Differences differences;
  for (std::size_t k = 0; k < one.size(); ++k) differences.add(one[k], other[k]);
  return differences.result();
}

Agreement agreement(const BatchSums& one, const BatchSums& other, std::uint32_t min_contributions) {
  Differences differences;
  for (std::size_t e = 0; e < one.entries.size(); ++e)
    if (std::min(one.contributions[e], other.contributions[e]) >= min_contributions)
      differences.add(one.entries[e], other.entries[e]);
  return differences.result();
}

}  // namespace shelfbeam::bench
