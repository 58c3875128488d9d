#pragma once

#include <string>
#include <string_view>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/answer/reach_curve.hpp"
#include "shelfbeam/placement/coverage/budget.hpp"

namespace shelfbeam::app {

// Answers in a few lines for a terminal.

std::string describe(const Placement& placement, const SignalTable& table);
std::string describe(const Reach& reach, const SignalTable& table);
/// Empty without points.
std::string describe(const ReachCurve& curve, const SignalTable& table);

/// What is said instead of one.
inline constexpr std::string_view no_curve = "no curve without a placement";

}  // namespace shelfbeam::app
