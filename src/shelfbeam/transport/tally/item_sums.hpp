#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"

namespace shelfbeam::detail {

/// Sums over the batches of one item, for every entry of its block. A batch adds to the entries that it
/// names; batches are added in their order, so the sums do not depend on threads. All state is in `values`
/// and `batches`: both together continue a simulation to the bit.
class ItemSums {
 public:
  ItemSums(std::size_t entries, bool with_direct, std::size_t layers)
      : values(size(entries, with_direct, layers)),
        entries_(entries),
        direct_(with_direct ? powers * entries : none),
        layers_((with_direct ? powers + 1 : powers) * entries) {}

  static constexpr std::size_t size(std::size_t entries, bool with_direct, std::size_t layers) {
    return entries * (powers + (with_direct ? 1 : 0) + layer_powers * layers);
  }

  void add(const BatchValues& batch) {
    for (const BatchValues::Value& value : batch.values) {
      double* const at = values.data() + powers * std::size_t{value.entry};
      at[0] += value.total;
      at[1] += value.total * value.total;
      at[2] += value.total * value.total * value.total;
      if (direct_ != none) values[direct_ + value.entry] += value.direct;
    }
    for (const BatchValues::LayerValue& value : batch.layers) {
      double* const at = values.data() + layer(value.layer, value.entry);
      at[0] += value.value;
      at[1] += value.value * value.value;
    }
    ++batches;
  }

  PowerSums entry(std::size_t entry) const {
    const double* const at = values.data() + powers * entry;
    return {static_cast<double>(batches), at[0], at[1], at[2]};
  }
  double direct(std::size_t entry) const { return direct_ == none ? 0 : values[direct_ + entry] / batches; }
  /// Without cubes.
  PowerSums layer_entry(std::size_t k, std::size_t entry) const {
    const double* const at = values.data() + layer(k, entry);
    return {static_cast<double>(batches), at[0], at[1]};
  }

  /// Sum, sum of squares and of cubes of every entry, then direct parts, then sum and sum of squares of
  /// layers.
  std::vector<double> values;
  std::uint32_t batches = 0;

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  static constexpr std::size_t powers = 3, layer_powers = 2;

  std::size_t layer(std::size_t k, std::size_t entry) const {
    return layers_ + layer_powers * (k * entries_ + entry);
  }

  std::size_t entries_, direct_, layers_;
};

}  // namespace shelfbeam::detail
