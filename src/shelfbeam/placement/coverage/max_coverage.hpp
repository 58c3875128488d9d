#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
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

/// The result of `maximise_coverage`.
struct MaxCoverage {
  PlacementProblem problem;
  std::size_t at_most = 0;            ///< units, installed ones included
  Selection selected;                 ///< ascending; contains every installed unit
  std::vector<std::uint32_t> missed;  ///< labels that the selection misses, ascending
  std::size_t reached = 0;            ///< labels that the selection reaches
  /// Proven: at most this many labels can be reached; with weights, the labels reachable one by one.
  std::size_t upper_bound = 0;
  std::optional<CoverageWeight> weight = {};  ///< if the table has weights
  /// Proof of the bound on the weight or, without weights, on the labels; trivial: labels reachable one by
  /// one.
  BoundProof bound_proof = BoundProof::trivial;
  /// optimal: the selection reaches its upper bound. feasible: not proven, but all methods have finished.
  /// stopped: the time limit, an interruption or a solver failure came first.
  Status status = Status::stopped;
  bool too_large = false;  ///< the problem is too large for the MIP, which did not run
  SolvedBy solver = {};    ///< search if enumeration or annealing gave it; the last MIP back end that ran
  std::vector<SearchStep> steps = {};  ///< not part of the placement file
  double seconds = 0;                  ///< wall time

  /// (upper_bound - reached) / upper_bound, of weights if there are any; 0 when proven.
  double gap() const {
    const double bound = weight ? weight->upper_bound : static_cast<double>(upper_bound);
    const double value = weight ? weight->reached : static_cast<double>(reached);
    return status == Status::optimal || bound <= value ? 0 : (bound - value) / bound;
  }
};

/// Maximises the weight of the labels that at most `units` transceivers reach, then minimises their number
/// (not part of the proof). A label counts if the problem's rule is met; objective and prices play no part.
/// Methods: greedy with exchanges; enumeration for few units (SolverChoice automatic and search); and, unless
/// that finished, annealing until the time is up (the same) and a MIP back end if the table is small enough
/// (automatic and mip). The bound is the best one of CoverageBound, enumeration and MIP. `units` may exceed
/// the number of candidates. Throws InputError as `place` does, and if more than `units` are installed.
MaxCoverage maximise_coverage(const SignalTable& table, const PlacementProblem& problem, std::size_t units,
                              const PlaceOptions& options, const RunControl& control = {});

}  // namespace shelfbeam
