#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/plan/validation_estimates.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// The signals on which units are placed: a matrix, which rounds refine, and its table with all constraints.
struct PlannedSignals {
  std::shared_ptr<SignalMatrix> matrix;
  SignalTable table;
};

/// Independent batches of one label: means, standard errors and flags (SignalMatrix::flags) by column.
struct ValidationRow {
  LabelId label;
  std::vector<double> mean, standard_error;
  std::vector<std::uint8_t> flags;
  std::uint32_t batches = 0;
  std::uint64_t samples = 0;
};

/// The batches of a label whose sums k, k + 1, ... start with the signals of the columns in `order`.
ValidationRow validation_row(const ValidationEstimates& fresh, std::size_t k, LabelId label,
                             std::span<const std::uint32_t> order);

/// Simulates some labels with independent samples, for all sources. Throws as `sample_batches`.
std::vector<ValidationRow> validation_rows(const PreparedScene& prepared, const BatchRequest& request,
                                           const RunControl& control = {});

/// Merges new batches into their label's row. Means and errors become those of all batches, weighted by
/// samples. An entry is flagged if a flagged part has at least half of the samples or of the error. Layers by
/// bounce and by path length are dropped, those of direct light stay.
void join(const ValidationRow& fresh, SignalMatrix& matrix);

}  // namespace shelfbeam
