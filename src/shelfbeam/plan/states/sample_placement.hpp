#pragma once

#include <functional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/placement/scenarios/place_over_scenarios.hpp"
#include "shelfbeam/plan/states/deciding_labels.hpp"

namespace shelfbeam {

/// Units for the sampled states.
struct SamplePlacement {
  std::vector<ColumnId> selected;     ///< empty: none was found
  ScenarioMisses misses;              ///< of all labels
  double value = 0, lower_bound = 0;  ///< as of ScenarioPlacement, proven for all labels
  std::vector<LabelId> unreachable;   ///< labels that all candidates together miss too often
};

/// The allowed misses of some labels.
using AllowanceOf = std::function<MissAllowance(std::span<const LabelId> labels)>;

/// Places units over the states of a sample, for the labels that decide, which grow by those that a placement
/// misses until it keeps to the misses that all labels are allowed. Each placement has a part of the time.
/// Throws Interrupted, and as its parts.
SamplePlacement place_on_sample(DecidingLabels& deciding, const PlacementProblem& problem,
                                const AllowanceOf& allowance, const PlaceOptions& options,
                                const Deadline& deadline, const RunControl& control);

}  // namespace shelfbeam
