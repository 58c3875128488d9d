#pragma once

#include <string>
#include <string_view>

#include "shelfbeam/placement/answer/coverage_curve.hpp"
#include "shelfbeam/placement/coverage/fewest_units.hpp"
#include "shelfbeam/placement/coverage/max_coverage.hpp"

namespace shelfbeam {

// Results of max coverage in a few lines for a terminal.

std::string describe(const MaxCoverage& reach, const SignalTable& table);
std::string describe(const FewestUnits& fewest, const SignalTable& table);
/// Empty without points.
std::string describe(const CoverageCurve& curve, const SignalTable& table);

/// Printed instead of a curve.
inline constexpr std::string_view no_curve = "no curve without a placement";

}  // namespace shelfbeam
