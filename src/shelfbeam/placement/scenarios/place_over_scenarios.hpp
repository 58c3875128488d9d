#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/scenarios/scenario_table.hpp"

namespace shelfbeam {

/// A selection that misses labels no more often than allowed, and a bound on all of these.
struct ScenarioPlacement {
  Selection selected;     ///< ascending; with every installed unit
  ScenarioMisses misses;  ///< by misses_of
  /// Count or new spend; infinite if no selection was found.
  double value = std::numeric_limits<double>::infinity();
  double lower_bound = 0;  ///< proven for these scenarios; infinite if no selection exists
  /// Labels that are missed too often even with all candidates, and all options of all mounting points; if
  /// none alone is, the labels that are then missed.
  std::vector<LabelId> unreachable;
  std::size_t calls = 0, cuts = 0;  ///< placements on cuts, and cuts
  std::vector<SearchStep> steps;

  bool has_selection() const { return value < std::numeric_limits<double>::infinity(); }
  bool is_proven() const { return value <= lower_bound * (1 + 1e-9); }
};

/// Finds the selection of the fewest units, or of the smallest new spend, which keeps to the allowed misses,
/// both communication models, with all constraints.
///
/// The bound comes from cuts, which every such selection satisfies. Let k be the number of cases, a label in
/// a scenario each, of which a rule allows misses: of one label, or one case per scenario, or any. In any set
/// of t > k cases, at least t - k have sum_j min(1, M_ijs / requirement_i) x_j >= 1. The mean over these
/// gives sum_j a_j x_j >= 1, a_j the mean of the t - k largest shares of unit j. If a rule is broken even
/// with all units of a set W, another unit is required: sum over j not in W of x_j >= 1. Linear programs over
/// the cuts bound the count first, then `place` solves the cuts exactly; solutions that break a rule violate
/// new cuts. If the bound K stays open, windows of the cuts for at most K units (window_mips.hpp) may exceed
/// it. With unit failure, the inequality of a case holds without any one unit, so each case of a cut leaves
/// out the unit that is strongest there.
///
/// The search starts from `options.start`, or from a greedy selection for the first cuts, and adds units;
/// annealing (scenario_annealing.hpp) then seeks fewer. Throws InputError for an objective other than the
/// count or the spend, and as `place`. Precondition: there is a scenario.
ScenarioPlacement place_over_scenarios(const ScenarioTable& scenarios, const PlacementProblem& problem,
                                       const MissAllowance& allowance, const PlaceOptions& options,
                                       const RunControl& control = {});

/// The lower bound alone, until it is at least `enough`.
double bound_over_scenarios(const ScenarioTable& scenarios, const PlacementProblem& problem,
                            const MissAllowance& allowance, double enough, const PlaceOptions& options,
                            const RunControl& control = {});

}  // namespace shelfbeam
