#pragma once

#include <string>

#include "shelfbeam/report/data/report_data.hpp"

namespace shelfbeam {

/// The weakest label has this many times its requirement in a plan that needs no further reserve.
inline constexpr double ample_margin = 1.25;
/// One unit more must raise the weakest label by this factor to be recommended.
inline constexpr double worthwhile_gain = 1.1;

/// The plan to choose, this one or that with one unit more, and the reason. Empty for a plan that misses
/// labels, for a part of the labels, and for a shop that changes, whose goal includes its reserve.
std::string recommendation(const ReportData& data);

}  // namespace shelfbeam
