#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
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
void expect_numbers(const Scene& scene, const Estimator::Block& block, const BatchValues& values);

}  // namespace shelfbeam
