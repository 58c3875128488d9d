#pragma once

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/alternatives.hpp"

namespace shelfbeam {

/// Compares a placement with one unit fewer, one unit more, and one that survives a failure. The work is
/// counted, so that the result is the same on every machine and for any number of threads; an interruption
/// leaves the rest out. Empty without a selection.
Alternatives alternatives_to(const Placement& placement, const SignalTable& table,
                             const RunControl& control = {});

/// The figures of one selection.
Alternative evaluate(const SignalTable& table, const PlacementProblem& problem, Selection selected);

}  // namespace shelfbeam
