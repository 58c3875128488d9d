#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

struct World;

/// The result of one batch of one item: means over its samples, for the entries that are not zero.
struct BatchValues {
  struct Value {
    std::uint32_t entry = 0;  ///< within the item's block; each entry at most once
    double total = 0;         ///< the signal
    double direct = 0;        ///< the part of the signal without a bounce
  };
  struct LayerValue {
    std::uint32_t layer = 0;  ///< index as in SignalRows::Source
    std::uint32_t entry = 0;
    double value = 0;
  };

  void clear() {
    values.clear();
    layers.clear();
  }

  std::vector<Value> values;
  std::vector<LayerValue> layers;  ///< only with layers by bounce or path length
  std::uint64_t rays = 0;          ///< total rays traced; not cleared
  ShadowRays shadow_rays;          ///< of walks from labels; not cleared
};

/// A method to estimate the signal matrix. The work is divided into items (labels, clusters of labels or
/// light sources), each with its own block of the matrix: some rows times some columns. No entry is in two
/// blocks.
///
/// A batch of an item is a pure function of (seed, item, batch). Batches are independent of each other, each
/// estimates every entry of the block without bias, and any number of threads may compute them in any order.
class Estimator {
 public:
  /// The rows and columns of the matrix that an item fills, ascending; entry r * columns.size() + c of its
  /// block is the signal of label rows[r] from source columns[c].
  struct Block {
    std::vector<LabelId> rows;
    std::vector<std::uint32_t> columns;
  };

  virtual ~Estimator() = default;

  virtual std::size_t items() const = 0;
  virtual const Block& block(std::size_t item) const = 0;

  /// First rays per label (for particles, per source) in a batch.
  virtual std::uint64_t samples_per_batch() const = 0;

  /// Whether batches include the direct light between point labels and point sources; otherwise
  /// AnalyticDirect computes it.
  virtual bool samples_direct() const = 0;

  /// The name and settings, for the signal file.
  virtual std::string name() const = 0;

  /// The same estimator for some labels only (ascending), with the random numbers of another seed and at
  /// least `min_samples` samples per batch where their number is free. It shares the tables of this estimator
  /// and outlives it. Its batches are independent of this one's, and unbiased for any tables. Throws
  /// InputError for particles, whose batches have no rows.
  virtual std::unique_ptr<Estimator> part(std::span<const LabelId> labels, std::uint64_t seed,
                                          std::uint64_t min_samples) const = 0;

  /// The same estimator for a changed scene with the same labels, candidates and materials, with few samples
  /// per batch. It may share tables of this estimator and outlives it; batches are unbiased for any tables.
  /// `changed` must outlive the result.
  virtual std::unique_ptr<Estimator> for_state(const World& changed, std::uint64_t seed) const = 0;

  /// Memory for the estimator's own tables, in bytes.
  virtual std::size_t bytes() const { return 0; }

  /// Fills `values` (cleared before) with the batch's mean of every entry of the block that is not zero.
  /// Returns false if cancelled; the batch then does not count.
  virtual bool sample(std::size_t item, std::uint32_t batch, const CancelToken* cancel,
                      BatchValues& values) const = 0;
};

/// The labels whose signals an estimator estimates, ascending.
inline std::vector<LabelId> rows_of(const Estimator& estimator) {
  std::vector<LabelId> rows;
  for (std::size_t item = 0; item < estimator.items(); ++item) {
    const auto& of_item = estimator.block(item).rows;
    rows.insert(rows.end(), of_item.begin(), of_item.end());
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

/// Throws std::runtime_error that names label and source if a signal of a batch is not a finite number. Such
/// a defect must not reach a file or a plan.
inline void expect_numbers(const Scene& scene, const Estimator::Block& block, const BatchValues& values) {
  for (const BatchValues::Value& value : values.values) {
    if (std::isfinite(value.total) && std::isfinite(value.direct)) continue;
    const std::uint32_t row = block.rows[value.entry / block.columns.size()];
    const std::uint32_t column = block.columns[value.entry % block.columns.size()];
    throw std::runtime_error(fmt::format(
        "the signal of label '{}' from {} is {}; please report this with the store", scene.labels[row].id,
        column < scene.transceivers.size() ? fmt::format("transceiver '{}'", scene.transceivers[column].id)
                                           : std::string("an emitting surface"),
        std::isfinite(value.total) ? value.direct : value.total));
  }
}

/// Sums over the batches of one item, for every entry of its block. Batches are added in their order, so the
/// sums do not depend on threads. All state is in `values` and `batches`: a simulation that continues from
/// both gives the same result bit by bit.
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
  /// Without the sum of cubes.
  PowerSums layer_entry(std::size_t k, std::size_t entry) const {
    const double* const at = values.data() + layer(k, entry);
    return {static_cast<double>(batches), at[0], at[1]};
  }

  /// Sum, sum of squares and sum of cubes of every entry, then the sums of direct parts, then sum and sum of
  /// squares of every layer entry.
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
