#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/plan/bound_goal.hpp"
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

/// The number of limits that have to hold together for a statement: of entries, and of sums of entries.
struct LimitCounts {
  std::size_t entries = 1, sums = 1;
};

/// The rows of some labels (ascending) of `planned`, with every signal replaced by an upper confidence limit
/// from independent batches. If `counts` limits that do not depend on the batches must hold together, they
/// do with probability 1 - level (bound_rounds.hpp states which limits a bound needs).
///
/// An entry's limit is Student's. An entry that was hit in few batches takes the limit of a sum that contains
/// it: the sum of all signals of the row that are no larger on `planned`, extended by larger ones until the
/// sum is hit often enough; if even the sum of the whole row is hit rarely, ValidationEstimate::rare_upper.
/// `planned` alone fixes the possible sums. Entries share 0.8 of the level, sums 0.1 and rarely hit rows 0.1
/// (Bonferroni).
/// Throws as `sample_batches`.
UpperConfidenceRows upper_confidence_rows(const PreparedScene& prepared, const SignalTable& planned,
                                          const BatchRequest& request, double level, LimitCounts counts,
                                          const RunControl& control = {});

/// The standard errors by which `upper_confidence_rows` is expected to raise an entry.
double expected_errors(double level, LimitCounts counts, std::uint32_t batches);

/// The table with every signal raised by some standard errors, those that this number of samples per label
/// would have, and by some standard errors of the matrix (negative: lowered, to 0 at the least).
SignalTable raised_table(const SignalTable& planned, const SignalMatrix& matrix, double errors,
                         double samples, double planned_errors = 0);

/// The rows of some labels (ascending) of a table.
SignalTable table_of_rows(const SignalTable& table, const std::vector<LabelId>& rows);

struct CoreRows {
  std::vector<LabelId> rows;  ///< ascending
  bool suffice = false;       ///< these labels alone require the cost
  /// Otherwise, a cheaper selection that reaches all labels, if the search met one.
  Selection counterexample;
};

/// Finds core rows: a few labels that by themselves require a selection to cost at least `cost`. Repeatedly
/// adds the labels that the best placement for the present rows misses. A certified bound then needs new
/// samples of these labels only. They do not suffice if a cheaper selection reaches all labels or a limit
/// comes first. The time limit of `options` is for all placements together, the step limit for each.
CoreRows core_rows(const SignalTable& table, const BoundGoal& goal, double cost, const PlaceOptions& options,
                   const RunControl& control);

}  // namespace shelfbeam
