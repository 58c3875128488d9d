#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/transport/batch_values.hpp"

namespace shelfbeam::detail {

/// Sums over the batches of one item, for every entry of its block. A batch adds to the entries that it
/// names; batches are added in their order, so the sums do not depend on threads. All state is in `values`
/// and `batches`: both together continue a simulation to the bit.
class ItemSums {
 public:
  ItemSums(std::size_t entries, bool with_direct, std::size_t layers)
      : values(size(entries, with_direct, layers)),
        entries_(entries),
        direct_(with_direct ? 2 * entries : none),
        layers_((with_direct ? 3 : 2) * entries) {}

  static constexpr std::size_t size(std::size_t entries, bool with_direct, std::size_t layers) {
    return entries * (2 + (with_direct ? 1 : 0) + 2 * layers);
  }

  void add(const BatchValues& batch) {
    for (const BatchValues::Value& value : batch.values) {
      add_to(2 * std::size_t{value.entry}, value.total);
      if (direct_ != none) values[direct_ + value.entry] += value.direct;
    }
    for (const BatchValues::LayerValue& value : batch.layers)
      add_to(layer(value.layer, value.entry), value.value);
    ++batches;
  }

  double mean(std::size_t entry) const { return values[2 * entry] / batches; }
  double standard_error(std::size_t entry) const { return error_of(2 * entry); }
  double direct(std::size_t entry) const { return direct_ == none ? 0 : values[direct_ + entry] / batches; }
  double layer_mean(std::size_t k, std::size_t entry) const { return values[layer(k, entry)] / batches; }
  double layer_standard_error(std::size_t k, std::size_t entry) const { return error_of(layer(k, entry)); }

  std::vector<double> values;  ///< sum and sum of squares of every entry, then direct parts, then layers
  std::uint32_t batches = 0;

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  std::size_t layer(std::size_t k, std::size_t entry) const { return layers_ + 2 * (k * entries_ + entry); }

  void add_to(std::size_t at, double value) {
    values[at] += value;
    values[at + 1] += value * value;
  }

  // Of the mean, from the spread of the batches. What rounding of the sums alone can explain is 0.
  double error_of(std::size_t at) const {
    const double n = batches, sum = values[at], squares = values[at + 1];
    const double spread = squares - sum * sum / n;
    if (spread <= n * squares * std::numeric_limits<double>::epsilon()) return 0;
    return std::sqrt(spread / (n * (n - 1)));
  }

  std::size_t entries_, direct_, layers_;
};

}  // namespace shelfbeam::detail
