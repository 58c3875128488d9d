#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"

namespace shelfbeam {

/// What a limited number of units can do.
struct Reach {
  Question question;
  std::size_t at_most = 0;              ///< units, installed ones included
  std::vector<std::uint32_t> selected;  ///< ascending; holds every installed unit
  std::vector<std::uint32_t> missed;    ///< labels that it does not meet, ascending
  std::size_t reached = 0;              ///< labels that it meets
  std::size_t upper_bound = 0;          ///< proven: no selection of at most so many units meets more labels
  BoundProof bound_proof = BoundProof::trivial;  ///< of upper_bound; trivial: what single labels could get
  /// optimal: both are equal. feasible: they are not, and that is all that was to be tried. stopped: the time
  /// limit, an interruption or a failed solver came first.
  Status status = Status::stopped;
  bool too_large = false;  ///< for the MIP, which was not asked therefore
  std::string solver;      ///< "greedy", or name and version of the MIP back end that was asked last
  double seconds = 0;      ///< wall time

  /// (upper_bound - reached) / upper_bound; 0 when proven.
  double gap() const {
    if (upper_bound <= reached) return 0;
    return static_cast<double>(upper_bound - reached) / static_cast<double>(upper_bound);
  }
};

/// The most labels that at most `units` transceivers reach, and with how few of them. A label counts when it
/// is met as the question says; its objective and prices play no part. The selection is found by the greedy
/// method and exchanges, and by a MIP back end where the table is small enough for one (SolverChoice
/// automatic and mip); the bound is the better one of ReachBound and the MIP. Fewer units come second, and
/// are not part of the proof. Any number of units may be given, more than there are candidates, too. Throws
/// InputError as `place` does, and where more units are installed.
Reach reach_most(const SignalTable& table, const Question& question, std::size_t units,
                 const PlaceOptions& options, const RunControl& control = {});

}  // namespace shelfbeam
