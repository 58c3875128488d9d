#pragma once

#include <string>

#include "shelfbeam/placement/budget.hpp"
#include "shelfbeam/placement/curve.hpp"
#include "shelfbeam/placement/placement.hpp"

namespace shelfbeam::app {

// Answers in a few lines for a terminal.

std::string describe(const Placement& placement, const SignalTable& table);
std::string describe(const Reach& reach, const SignalTable& table);
/// Empty without points.
std::string describe(const ReachCurve& curve, const SignalTable& table);

}  // namespace shelfbeam::app
