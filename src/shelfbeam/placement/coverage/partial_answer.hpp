#pragma once

#include <cstddef>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"

namespace shelfbeam {

/// The weight of labels, in the unit of SignalTable::Label::weight.
struct CoverageWeight {
  double reached = 0;  ///< by the selection
  double total = 0;    ///< of all labels
  /// Proven: no selection reaches more, apart from 1e-9 of the total. If a MIP solver proves it and weights
  /// have more than six decimals, apart from 2e-6.
  double upper_bound = 0;
};

/// The result of a question that may leave labels missed.
struct PartialAnswer {
  PlacementProblem problem;
  Selection selected;           ///< ascending; contains every installed unit
  std::vector<LabelId> missed;  ///< labels that the selection misses, ascending
  std::size_t reached = 0;      ///< labels that the selection reaches
  BoundProof bound_proof = BoundProof::trivial;
  /// optimal: the value is proven. infeasible: proven, no selection answers the question. feasible: not
  /// proven, but all methods have finished. stopped: the time limit, an interruption or a solver failure came
  /// first.
  Status status = Status::stopped;
  bool too_large = false;  ///< the problem is too large for the MIP, which did not run
  SolvedBy solver = {};    ///< search if enumeration or annealing gave it; the last MIP back end that ran
  std::vector<SearchStep> steps = {};  ///< not part of the placement file
  double seconds = 0;                  ///< wall time
};

}  // namespace shelfbeam
