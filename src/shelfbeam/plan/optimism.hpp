#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/plan/refine.hpp"
#include "shelfbeam/plan/verification.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// Upper limits of some labels' signals, and the batches that they are made of, row by row.
struct OptimisticRows {
  SignalTable table;
  std::vector<FreshRow> fresh;
};

/// Some labels' rows of `planned` with an upper confidence limit in the place of every signal, from fresh
/// batches: with a chance of 1 - level no true signal is larger, so what the true rows need, these need or
/// more. `rows` ascending.
///
/// An entry's limit is Student's. Entries that were hit in few batches take the limit of a sum instead, which
/// they are part of: of all signals of the row that are no larger than the planned one, or more of them until
/// the sum was hit often enough. Which sums there are follows from `planned` alone, and the level is shared
/// by all limits that could be used (Bonferroni). Where even the sum of the whole row was hit rarely it is
/// FreshSum::rare_upper. Throws as `sample_batches`.
OptimisticRows optimistic_rows(const Scene& scene, const SignalTable& planned,
                               const std::vector<std::uint32_t>& rows, double level,
                               const VerificationEffort& effort, const RunControl& control = {});

/// What `optimistic_rows` of all labels may be expected to be, from the errors of a matrix.
SignalTable expected_optimism(const SignalTable& planned, const SignalMatrix& matrix, std::size_t rows,
                              double level, std::uint32_t batches);

}  // namespace shelfbeam
