#pragma once

#include <cstddef>
#include <optional>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/coverage/partial_answer.hpp"

namespace shelfbeam {

/// The result of `maximise_coverage`: never infeasible, since the installed units are a selection.
struct MaxCoverage : PartialAnswer {
  std::size_t at_most = 0;  ///< units, installed ones included
  /// Proven: at most this many labels can be reached; with weights, the labels reachable one by one. Its
  /// proof is that of the bound on the weight or, without weights, on the labels; trivial: labels reachable
  /// one by one.
  std::size_t upper_bound = 0;
  std::optional<CoverageWeight> weight = {};  ///< if the table has weights

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
