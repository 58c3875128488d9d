#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/alternatives.hpp"
#include "shelfbeam/plan/answer/availability.hpp"

namespace shelfbeam {

// Results in a few lines for a terminal.

std::string describe(const Placement& placement, const SignalTable& table);
/// "cooperative, even if any one unit fails"
std::string model_of(const PlacementProblem& problem);
/// "  chosen: ids"; empty without any.
std::string chosen(const Selection& selected, const SignalTable& table);
/// The answer for a shop that changes, one sentence.
std::string availability_answer(const Availability& availability, const Placement& placement,
                                const SignalTable& table);
/// The remarks on it, one per line.
std::string availability_details(const Availability& availability, const Placement& placement,
                                 const SignalTable& table);
/// One line per alternative; empty without any. `has_reserve`: thresholds are known well enough to state
/// multiples of them.
std::string describe(const Alternatives& alternatives, const Placement& placement, const SignalTable& table,
                     bool has_reserve);
}  // namespace shelfbeam
