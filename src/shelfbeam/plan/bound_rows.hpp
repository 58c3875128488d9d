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
/// from independent batches. For `signals` entries per row that do not depend on the batches, no true signal
/// is larger, with probability 1 - level. A bound that these rows prove is wrong only if one selection S*
/// contradicts it, and only if the limit of one of its signals is too low: `signals` is the number of units
/// of S*, or 1 where one unit alone must reach a label (2 if a unit may fail).
///
/// An entry's limit is Student's. An entry that was hit in few batches takes the limit of a sum that contains
/// it: the sum of all signals of the row that are no larger on `planned`, extended by larger ones until the
/// sum is hit often enough; if even the sum of the whole row is hit rarely, ValidationEstimate::rare_upper.
/// `planned` alone fixes the possible sums, and all limits that could be used for these entries share the
/// level (Bonferroni).
/// Throws as `sample_batches`.
UpperConfidenceRows upper_confidence_rows(const PreparedScene& prepared, const SignalTable& planned,
                                          const BatchRequest& request, double level, std::size_t signals,
                                          const RunControl& control = {});

/// Prediction of `upper_confidence_rows` with this number of rows for all labels, from the standard errors of
/// a matrix.
SignalTable predicted_upper_rows(const SignalTable& planned, const SignalMatrix& matrix, std::size_t rows,
                                 double level, std::size_t signals, std::uint32_t batches);

/// The table with every signal raised by some standard errors, those that this number of batches would have.
SignalTable raised_table(const SignalTable& planned, const SignalMatrix& matrix, double errors,
                         std::uint32_t batches);

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
