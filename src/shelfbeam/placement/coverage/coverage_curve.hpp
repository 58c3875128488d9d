#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/coverage_curve.hpp"
#include "shelfbeam/placement/answer/placement.hpp"

namespace shelfbeam {

/// A point for every number of units from the installed ones (at least 1) to the size of `selected`, which
/// reaches every label. Lower bounds come from the greedy method forwards, from the selection backwards and
/// from annealing, upper bounds from CoverageBound and enumeration. Large tables get fewer steps: 20 million
/// entries take about a minute. At `until` it ends early, with wider bounds.
CoverageCurve coverage_curve(
    const SignalTable& table, const PlacementProblem& problem, const Selection& selected,
    const RunControl& control = {},
    std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max());

/// Makes a placement and its curve consistent: takes over a smaller feasible selection (lexicographic
/// problems, unless `selection_stays`) and a higher count bound, and lowers `at_most` for counts below that
/// bound, which miss a label.
void reconcile_bounds(Placement& placement, CoverageCurve& curve, const SignalTable& table,
                      bool selection_stays = false);

/// The curve of a placement with a selection, within the remainder of the time limit, at least a tenth of it.
/// Placement and curve are consistent afterwards, and the placement's `seconds` include the curve.
CoverageCurve add_curve(Placement& placement, const SignalTable& table, double time_limit_s,
                        const RunControl& control = {}, bool selection_stays = false);

}  // namespace shelfbeam
