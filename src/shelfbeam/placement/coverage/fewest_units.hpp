#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/coverage/max_coverage.hpp"

namespace shelfbeam {

/// The result of `fewest_units`.
struct FewestUnits {
  PlacementProblem problem;
  double share = 1;                   ///< of the weight of all labels, to be reached
  double target = 0;                  ///< the same as a weight; whole if the weights are
  bool has_selection = false;         ///< `selected` reaches the target
  Selection selected;                 ///< ascending; contains every installed unit
  std::vector<std::uint32_t> missed;  ///< labels that the selection misses, ascending
  std::size_t reached = 0;            ///< labels that the selection reaches
  /// Without weights, a label weighs 1. The upper bound holds for selections of any number of units.
  CoverageWeight weight;
  std::size_t count_lower_bound = 0;             ///< proven: fewer units do not reach the target
  BoundProof bound_proof = BoundProof::trivial;  ///< of that bound, or that no selection reaches the target
  /// optimal: as many units as the bound. infeasible: proven, no selection reaches the target. feasible: not
  /// proven, but all methods have finished. stopped: the time limit, an interruption or a solver failure came
  /// first.
  Status status = Status::stopped;
  bool too_large = false;              ///< the problem is too large for the MIP, which did not run
  SolvedBy solver = {};                ///< as in MaxCoverage
  std::vector<SearchStep> steps = {};  ///< not part of the placement file
  double seconds = 0;                  ///< wall time
};

/// Minimises the number of transceivers, installed ones included, that reach at least `share` (0 to 1) of the
/// weight of all labels, up to a part in 1e9. Rules and methods are those of `maximise_coverage`: k units are
/// too few if an upper bound on the weight that they reach is below that share, or if the enumeration finds
/// no selection; the MIP minimises the count. Throws InputError as `place` does.
FewestUnits fewest_units(const SignalTable& table, const PlacementProblem& problem, double share,
                         const PlaceOptions& options, const RunControl& control = {});

}  // namespace shelfbeam
