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

/// Upper confidence limits of some labels' signals, and the batches behind them, row by row.
struct UpperConfidenceRows {
  SignalTable table;
  std::vector<ValidationRow> fresh;
};

/// The rows of some labels (ascending) of `planned`, with every signal replaced by an upper confidence limit
/// from independent batches. With probability 1 - level no true signal is larger, so these rows require at
/// most as many units as the true ones.
///
/// An entry's limit is Student's. An entry that was hit in few batches takes the limit of a sum that contains
/// it: the sum of all signals of the row that are no larger on `planned`, extended by larger ones until the
/// sum is hit often enough; if even the sum of the whole row is hit rarely, ValidationEstimate::rare_upper.
/// `planned` alone fixes the possible sums, and all limits that could be used share the level (Bonferroni).
/// Throws as `sample_batches`.
UpperConfidenceRows upper_confidence_rows(const Scene& scene, const SignalTable& planned,
                                          const std::vector<std::uint32_t>& rows, double level,
                                          const VerificationEffort& effort, const RunControl& control = {});

/// Prediction of `upper_confidence_rows` for all labels from the standard errors of a matrix.
SignalTable predicted_upper_rows(const SignalTable& planned, const SignalMatrix& matrix, std::size_t rows,
                                 double level, std::uint32_t batches);

/// The rows of some labels (ascending) of a table.
SignalTable table_of_rows(const SignalTable& table, const std::vector<std::uint32_t>& rows);

struct CoreRows {
  std::vector<std::uint32_t> rows;  ///< ascending
  bool suffice = false;             ///< these labels alone require `count` units
};

/// Finds core rows: a few labels that by themselves require `count` units. Repeatedly adds the labels that
/// the best placement for the present rows misses. A certified bound then needs new samples of these labels
/// only. They do not suffice if fewer units reach all labels or a limit comes first. The time limit of
/// `options` is for all placements together, the step limit for each.
CoreRows core_rows(const SignalTable& table, const PlacementProblem& problem, std::size_t count,
                   const PlaceOptions& options, const RunControl& control);

}  // namespace shelfbeam
