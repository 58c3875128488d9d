#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"

namespace shelfbeam {

/// The result of `maximise_coverage`.
struct MaxCoverage {
  PlacementProblem problem;
  std::size_t at_most = 0;                       ///< units, installed ones included
  std::vector<std::uint32_t> selected;           ///< ascending; contains every installed unit
  std::vector<std::uint32_t> missed;             ///< labels that the selection misses, ascending
  std::size_t reached = 0;                       ///< labels that the selection reaches
  std::size_t upper_bound = 0;                   ///< proven: at most this many labels can be reached
  BoundProof bound_proof = BoundProof::trivial;  ///< of upper_bound; trivial: labels reachable one by one
  /// optimal: reached = upper_bound. feasible: not proven, but all methods have finished. stopped: the time
  /// limit, an interruption or a solver failure came first.
  Status status = Status::stopped;
  bool too_large = false;  ///< the problem is too large for the MIP, which did not run
  std::string solver;      ///< "greedy", or name and version of the last MIP back end that ran
  double seconds = 0;      ///< wall time

  /// (upper_bound - reached) / upper_bound; 0 when proven.
  double gap() const {
    if (upper_bound <= reached) return 0;
    return static_cast<double>(upper_bound - reached) / static_cast<double>(upper_bound);
  }
};

/// Maximises the number of labels that at most `units` transceivers reach, then minimises their number (not
/// part of the proof). A label counts if the problem's rule is met; objective and prices play no part.
/// Methods: greedy with exchanges, and a MIP back end if the table is small enough (SolverChoice automatic
/// and mip). The bound is the better one of CoverageBound and the MIP. `units` may exceed the number of
/// candidates. Throws InputError as `place` does, and if more than `units` are installed.
MaxCoverage maximise_coverage(const SignalTable& table, const PlacementProblem& problem, std::size_t units,
                              const PlaceOptions& options, const RunControl& control = {});

}  // namespace shelfbeam
