#pragma once

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::detail {

/// Of the greedy method. With a step limit, which replaces the time, it runs to its end.
Effort greedy_effort(const PlaceOptions& options, double seconds);

/// Minimises the sum of prices that puts the new spend first and the count second (SpendOrder). If most
/// prices are equal and a gap remains, the count is minimised, too: its search and bounds are stronger than
/// those of sums.
Placement place_by_spend(const SignalTable& table, const PlacementProblem& problem,
                         const PlaceOptions& options, const RunControl& control);

}  // namespace shelfbeam::detail
