#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/refine.hpp"
#include "shelfbeam/plan/verification.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

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

/// The same question about some labels: the rows of a table, ascending.
SignalTable table_of_rows(const SignalTable& table, const std::vector<std::uint32_t>& rows);

struct DecisiveRows {
  std::vector<std::uint32_t> rows;  ///< ascending
  bool suffice = false;             ///< these labels alone need `count` units
};

/// A few labels that need so many units by themselves, found by adding what the best placement for those so
/// far leaves unmet. A bound that is to be proven on fresh samples needs these alone to be simulated. Where
/// they do not suffice, some selection of fewer units meets all labels, or time was short: the limits of
/// `options` are of time for all placements together, and of steps for each.
DecisiveRows decisive_rows(const SignalTable& table, const Question& question, std::size_t count,
                           const PlaceOptions& options, const RunControl& control);

}  // namespace shelfbeam
