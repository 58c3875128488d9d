#pragma once

#include <cstddef>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/coverage/partial_answer.hpp"

namespace shelfbeam {

/// The result of `fewest_units`.
struct FewestUnits : PartialAnswer {
  double share = 1;            ///< of the weight of all labels, to be reached
  double target = 0;           ///< the same as a weight; whole if the weights are
  bool has_selection = false;  ///< `selected` reaches the target
  /// Without weights, a label weighs 1. The upper bound holds for selections of any number of units.
  CoverageWeight weight;
  /// Proven: fewer units do not reach the target. If no units do, it is 0, and `bound_proof` is the proof.
  std::size_t count_lower_bound = 0;
};

/// Minimises the number of transceivers, installed ones included, that reach at least `share` (0 to 1) of the
/// weight of all labels, up to a part in 1e9. Rules and methods are those of `maximise_coverage`: k units are
/// too few if an upper bound on the weight that they reach is below that share, or if the enumeration finds
/// no selection; the MIP minimises the count. Throws InputError as `place` does.
FewestUnits fewest_units(const SignalTable& table, const PlacementProblem& problem, double share,
                         const PlaceOptions& options, const RunControl& control = {});

}  // namespace shelfbeam
