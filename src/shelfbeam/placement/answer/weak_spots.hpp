#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"

namespace shelfbeam {

/// How near a selection comes to missing a label of one scenario.
struct ScenarioMargin {
  std::size_t scenario = 0;    ///< index into SignalTable::scenarios
  double smallest_margin = 0;  ///< least received_signal / (gamma tau); infinite without labels
  std::uint32_t label = 0;     ///< the row where it is, the first of several
};

/// One for every scenario of the table; none without a selection.
std::vector<ScenarioMargin> scenario_margins(const SignalTable& table, const Placement& placement);

/// What hangs on one chosen unit.
struct Critical {
  std::uint32_t unit = 0;
  std::vector<std::uint32_t> labels;  ///< met, and not without it: ascending
};

/// For every unit of a selection, in its order, the labels that would be missed were it to fail alone. Where
/// units do not cooperate these are the labels that only it reaches; an answer that survives any failure has
/// none.
std::vector<Critical> critical_units(const SignalTable& table, const Question& question,
                                     const std::vector<std::uint32_t>& selected);

}  // namespace shelfbeam
