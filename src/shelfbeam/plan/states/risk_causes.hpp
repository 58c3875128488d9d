#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/signal/checkpoint/result_log.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

/// The causes of the spread of some labels' signals from mounted units, from states in which one cause
/// changes and all else is as in the file, with reflectances at their low ends. The variance by sampling is
/// subtracted. For signals to which causes contribute independently, the shares are those of a variance
/// decomposition (Sobol 1993). Reflectances do not change with time; their part is that of signals between
/// those at the low and at the high ends of all ranges, all equally likely.
///
/// `units`: the scene of `states` with the mounted units only; `labels`: the first of these are examined.
inline constexpr std::size_t max_labels_at_risk = 12;
std::vector<LabelAtRisk> risk_causes(const StoreStates& states, const Scene& units,
                                     std::span<const LabelId> labels, const PlacementProblem& problem,
                                     const SimulationOptions& options, ResultLog& log,
                                     const RunControl& control);

}  // namespace shelfbeam
