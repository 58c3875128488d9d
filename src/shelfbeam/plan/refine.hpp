#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/plan/verification.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// Fresh batches of one label: means and standard errors by column.
struct FreshRow {
  std::vector<double> mean, standard_error;
  std::uint32_t batches = 0;
  std::uint64_t samples = 0;  ///< first rays
};

/// Joins them to the label's row: means and errors become those of all batches together, by samples. Parts by
/// bounce are dropped, and direct parts stay.
void join(const FreshRow& fresh, std::size_t label, SignalMatrix& matrix);

/// Samples some rows of a matrix afresh, for all columns, and joins them. Throws as `sample_batches`.
void refine(const Scene& scene, const std::vector<std::uint32_t>& rows, const VerificationEffort& effort,
            SignalMatrix& matrix, const RunControl& control = {});

}  // namespace shelfbeam
