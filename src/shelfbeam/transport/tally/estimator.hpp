#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

/// What one batch of one item gives: means over its samples, of the entries that are not zero.
struct BatchValues {
  struct Value {
    std::uint32_t entry = 0;  ///< within the item's block; each entry at most once
    double total = 0;         ///< the signal
    double direct = 0;        ///< the part of it without any reflection
  };
  struct LayerValue {
    std::uint32_t layer = 0;  ///< as SignalRows::fill_layer counts them
    std::uint32_t entry = 0;
    double value = 0;
  };

  void clear() {
    values.clear();
    layers.clear();
  }

  std::vector<Value> values;
  std::vector<LayerValue> layers;  ///< only of estimators that tell paths apart
  std::uint64_t rays = 0;          ///< traced in all; not cleared
  ShadowRays shadow_rays;          ///< of walks from labels; not cleared
};

/// One way to estimate the signal matrix. The work is dealt out in items (labels, clusters of labels or light
/// sources), each with its own block of the matrix: some rows times some columns. No entry is in two blocks.
///
/// A batch of an item is a pure function of (seed, item, batch): batches are independent of each other, each
/// gives every entry of the block without bias, and they may be computed in any order by any number of
/// threads.
class Estimator {
 public:
  /// The rows and columns of the matrix that an item fills, ascending; entry r * columns.size() + c of its
  /// block is the signal of label rows[r] from source columns[c].
  struct Block {
    std::vector<std::uint32_t> rows, columns;
  };

  virtual ~Estimator() = default;

  virtual std::size_t items() const = 0;
  virtual const Block& block(std::size_t item) const = 0;

  /// First rays a label (particles a source) in a batch.
  virtual std::uint64_t samples_per_batch() const = 0;

  /// Whether batches hold the light between point labels and point sources that comes without a walk;
  /// otherwise it is known in closed form (direct.hpp) and not part of them.
  virtual bool samples_direct() const = 0;

  /// The name and settings that a signal file carries.
  virtual std::string name() const = 0;

  /// Memory for its own tables, in bytes.
  virtual std::size_t bytes() const { return 0; }

  /// Fills `values` (cleared before) with the batch's mean of every entry of the block that is not zero.
  /// False: cancelled on the way; the batch does not count.
  virtual bool sample(std::size_t item, std::uint32_t batch, const CancelToken* cancel,
                      BatchValues& values) const = 0;
};

/// Throws std::runtime_error if a signal of a batch is not a finite number, naming label and source: a defect
/// that no file and no plan may carry on.
inline void expect_numbers(const Scene& scene, const Estimator::Block& block, const BatchValues& values) {
  for (const BatchValues::Value& value : values.values) {
    if (std::isfinite(value.total) && std::isfinite(value.direct)) continue;
    const std::uint32_t row = block.rows[value.entry / block.columns.size()];
    const std::uint32_t column = block.columns[value.entry % block.columns.size()];
    throw std::runtime_error(fmt::format(
        "the signal of label '{}' from {} came out as {}; please report this with the store",
        scene.labels[row].id,
        column < scene.transceivers.size() ? fmt::format("transceiver '{}'", scene.transceivers[column].id)
                                           : std::string("an emitting surface"),
        std::isfinite(value.total) ? value.direct : value.total));
  }
}

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

}  // namespace shelfbeam
