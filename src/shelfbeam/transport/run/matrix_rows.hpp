#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/hdf5/write_signal_file.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/tally/analytic_direct.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"

namespace shelfbeam::detail {

/// The rows of the signal matrix, from the items' sums and the analytic direct light.
class MatrixRows {
 public:
  MatrixRows(const Estimator& estimator, const std::vector<ItemSums>& sums,
             const AnalyticDirect& analytic_direct, std::size_t rows, std::size_t bounce_layers,
             std::size_t length_layers);

  /// The rows of some labels. The object and the labels must outlive them.
  SignalRows of(std::span<const LabelId> labels) const;
  /// Number of batches of a row: the minimum over the items with entries in the row.
  std::uint32_t batches(std::size_t row) const;

 private:
  struct Part {
    std::uint32_t item, row;  ///< item, and row within its block
  };

  // Calls use(item, row within its block) for the items of a row.
  template <class Use>
  void each_item(std::size_t row, Use use) const {
    for (const std::uint32_t item : tall_) use(item, row);
    for (std::size_t p = starts_[row]; p < starts_[row + 1]; ++p) use(parts_[p].item, parts_[p].row);
  }

  void fill(SignalRows::Quantity quantity, std::size_t row, std::span<float> values) const;
  void fill_layer(std::size_t layer, SignalRows::Quantity quantity, std::size_t row,
                  std::span<float> values) const;
  void fill_flags(std::size_t row, std::span<std::uint8_t> flags) const;
  template <class Known, class Sampled>
  void fill_with(std::size_t row, std::span<float> values, const Known& known, const Sampled& sampled) const;

  const Estimator& estimator_;
  const std::vector<ItemSums>& sums_;
  const AnalyticDirect& analytic_direct_;
  std::size_t bounce_layers_, length_layers_;
  std::vector<std::uint32_t> tall_;  ///< items with all rows
  std::vector<std::size_t> starts_;  ///< index of each row in `parts_`
  std::vector<Part> parts_;          ///< by row, of the other items
};

/// Sets the keys of light of a matrix with the labels and transceivers of the scene (light_keys).
void set_light(SignalMatrix& matrix, const Scene& scene);

/// A matrix without entries: its labels, sources and provenance.
SignalMatrix matrix_head(const Scene& scene, const std::string& hash, std::uint64_t seed,
                         const std::string& estimator);

/// The same matrix with its entries.
SignalMatrix filled(SignalMatrix head, const SignalRows& rows);

}  // namespace shelfbeam::detail
