#pragma once

#include <string>

#include "shelfbeam/report/data/report_data.hpp"

namespace shelfbeam {

/// A label that no longer receives enough after losing this share of its signal has little reserve. A plan
/// without such labels needs no further unit.
inline constexpr double close_share = 0.25;
/// One unit more must raise the weakest label by this factor to be recommended.
inline constexpr double worthwhile_gain = 1.1;

/// The plan to choose, this one or that with one unit more, and the reason. Empty for a plan that misses
/// labels or whose certificate leaves any open, and for a part of the labels. For a shop that changes, whose
/// goal includes its reserve: this plan instead of that for the shop as the file gives it
/// (states_recommendation).
std::string recommendation(const ReportData& data);

}  // namespace shelfbeam
