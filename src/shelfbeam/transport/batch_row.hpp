#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/transport/tally.hpp"

namespace shelfbeam {

/// Running mean and squares (Welford 1962) of many values over the same batches, one array a quantity, so
/// that the many values that a batch leaves at zero cost little (Moments would repeat the count for each).
class BatchMeans {
 public:
  explicit BatchMeans(std::size_t n) : mean_(n), squares_(n) {}

  /// The value of entry k in batch number `batches`, counted from 1.
  void add(std::size_t k, double value, std::uint32_t batches) {
    const double difference = value - mean_[k];
    mean_[k] += difference / batches;
    squares_[k] += difference * (value - mean_[k]);
  }
  double mean(std::size_t k) const { return mean_[k]; }
  double standard_error(std::size_t k, std::uint32_t batches) const {
    return std::sqrt(squares_[k] / (static_cast<double>(batches) * (batches - 1)));
  }

 private:
  std::vector<double> mean_, squares_;
};

/// What the batches of one label (or, for particles, of one transceiver) have given so far. Only the task
/// that has it touches it, batch after batch, so the order of additions never depends on the threads.
struct BatchRow {
  BatchRow(std::size_t n, std::size_t layers_kept)
      : total(n), direct(n), layers(layers_kept, BatchMeans(n)) {}

  /// A whole batch: sums of this many samples.
  void add(const Tally& tally, double samples) {
    ++batches;
    for (std::size_t k = 0; k < tally.width(); ++k) {
      double sum = 0;
      for (std::size_t level = 0; level < tally.levels(); ++level) {
        const double value = tally.sum(level, k) / samples;
        sum += value;
        if (!layers.empty()) layers[level].add(k, value, batches);
      }
      total.add(k, sum, batches);
      direct[k] += (tally.sum(0, k) / samples - direct[k]) / batches;
    }
  }

  BatchMeans total;
  std::vector<double> direct;      ///< mean of level 0
  std::vector<BatchMeans> layers;  ///< by level; empty unless asked for
  std::uint32_t batches = 0;
};

}  // namespace shelfbeam
