#pragma once

#include <cstddef>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"

namespace shelfbeam {

/// The smallest margin of a selection in one scenario.
struct ScenarioMargin {
  std::size_t scenario = 0;    ///< index into SignalTable::scenarios
  double smallest_margin = 0;  ///< min_i S_i / (gamma_i tau_i); infinite without labels
  LabelId label;               ///< row with that margin, the first of several
};

/// One entry per scenario of the table; empty without a selection.
std::vector<ScenarioMargin> scenario_margins(const SignalTable& table, const Placement& placement);

/// The labels that depend on one chosen unit.
struct Critical {
  ColumnId unit;
  std::vector<LabelId> labels;  ///< reached, but missed without the unit; ascending
};

/// For every unit of a selection, in its order: the labels that its failure alone would leave missed
/// (non-cooperative: the labels that only this unit reaches). A selection that survives any failure has none.
std::vector<Critical> critical_units(const SignalTable& table, const PlacementProblem& problem,
                                     const Selection& selected);

}  // namespace shelfbeam
