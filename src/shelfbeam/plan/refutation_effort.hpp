#pragma once

#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/plan/refutation.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// The linear relaxation of the question whether a selection of the budget reaches all labels.
struct RelaxedCover {
  bool is_refuted = false;      ///< no fractional selection does
  std::vector<LabelId> labels;  ///< ascending; labels that prove it
};

RelaxedCover relaxed_cover(const SignalTable& table, const SelectionBudget& limit, const Deadline& deadline,
                           const RunControl& control);

/// The samples per label that a test of a refutation is expected to need at this level, from the standard
/// errors of the matrix; errors of different labels count as independent. Infinite if a leaf is not refuted
/// by the means.
double needed_samples(const Refutation& refutation, const SignalTable& table, const SignalMatrix& matrix,
                      double level);

}  // namespace shelfbeam
