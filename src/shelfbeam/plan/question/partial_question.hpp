#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// A question that does not require all labels; at most one of its values is given.
struct PartialQuestion {
  std::optional<std::size_t> at_most = {};  ///< number of units that reach as many labels as possible
  std::optional<double> share = {};         ///< of the labels, to be reached with as few units as possible
  /// Columns of the selection to be examined, ascending.
  std::optional<Selection> given = {};

  bool is_asked() const { return at_most || share || given; }
};

/// Throws InputError, with the setting, for an objective or prices, which play no part in the choice.
void check_question(const PartialQuestion& question, const PlacementProblem& problem);

/// The selection that answers the question (maximise_coverage, fewest_units). Its `partial` is set; there is
/// no bound on its costs. Throws as these functions.
Placement place_partially(const SignalTable& table, const PlacementProblem& problem,
                          const PartialQuestion& question, const PlaceOptions& options,
                          const RunControl& control = {});

}  // namespace shelfbeam
