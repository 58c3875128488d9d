#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// Why a certificate, or the search over states, ended before all was decided.
enum class EndCause {
  interrupted,
  time_limit,
  budget,        ///< of the certificate: spent
  labels_near,   ///< labels are too close to their requirements
  signals_near,  ///< signals are too close to requirements for a proof
  labels_cost,   ///< deciding the remaining labels takes more than the budget
  proof_cost,    ///< proving the bound takes more than the budget
  weak_bound,    ///< the search proved no larger bound on the simulated signals
  conflicts,     ///< each label can be reached alone, but conflicts prevent a selection that reaches all
  no_placement,  ///< none was found in time after independent samples had changed the matrix
  cheaper,       ///< it is undecided whether a cheaper selection reaches all labels
  no_unit,       ///< no other transceiver helps in the states
  plans_failed,  ///< too many plans failed in fresh states
  other          ///< as an earlier version of the program worded it
};

template <>
inline constexpr auto names_of<EndCause> =
    std::to_array<Named<EndCause>>({{"interrupted", EndCause::interrupted},
                                    {"time_limit", EndCause::time_limit},
                                    {"budget", EndCause::budget},
                                    {"labels_near", EndCause::labels_near},
                                    {"signals_near", EndCause::signals_near},
                                    {"labels_cost", EndCause::labels_cost},
                                    {"proof_cost", EndCause::proof_cost},
                                    {"weak_bound", EndCause::weak_bound},
                                    {"conflicts", EndCause::conflicts},
                                    {"no_placement", EndCause::no_placement},
                                    {"cheaper", EndCause::cheaper},
                                    {"no_unit", EndCause::no_unit},
                                    {"plans_failed", EndCause::plans_failed},
                                    {"other", EndCause::other}});

struct EndReason {
  EndCause cause = EndCause::interrupted;
  std::size_t labels = 0;       ///< labels_cost: undecided labels that more samples would decide
  double bound = 0;             ///< proof_cost: the count or cost to prove
  bool bounds_cost = false;     ///< proof_cost: `bound` is a cost
  bool leaves_cheaper = false;  ///< `cheaper` is a further reason
  std::string text = {};        ///< other
  /// labels_cost, proof_cost: the expected effort; 0 if the budget is in samples. It depends on the speed of
  /// the machine, so it is not part of placement.json.
  double seconds = 0;

  bool operator==(const EndReason&) const = default;
};

}  // namespace shelfbeam
